"""What commands make of a painting: layers by name, the active one, textures, and what is refused."""

import numpy as np
import pytest
from PIL import Image

from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.evaluate import evaluate_sparse
from engine.files.fault import FileError
from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.session.apply import STEPS, Around, Painting, Refusal, apply

FRAME = Rect.at(0, 0, 64, 64)


def told(*commands, painting=None, around=None):
    painting = painting or Painting(FRAME, 7)
    for command in commands:
        painting = apply(painting, parse(command), around or Around())
    return painting


def layer(**members):
    return {"do": "layer", **members}


def stroke(**members):
    return {"do": "stroke", "points": [[8, 8], [50, 40]], "brush": {"radius": 6, "colour": "#ff0000"}, **members}


def names(painting):
    return [node.name for node in layers.walk(painting.root)]


def picture(painting, level=0, rect=FRAME):
    def read(sheet, level, rect):
        found = evaluate_sparse(sheet.pyramid, level, rect, None)
        return None if found is None else found.rgba

    return composite(painting.root, level, rect, read)


def test_the_first_stroke_makes_the_first_layer():
    painting = told(stroke())
    assert names(painting) == ["Layer 1"]
    assert painting.active == "Layer 1"
    assert picture(painting)[3].max() == 1.0


ACTIVE = [
    ([layer(add="a")], ["a"], "a"),
    ([layer(add="a"), layer(add="b")], ["a", "b"], "b"),
    ([layer(add="a"), layer(add="b"), layer(select="a"), layer(add="c")], ["a", "c", "b"], "c"),
    ([layer(add="a"), layer(add="b", to=0)], ["b", "a"], "b"),
    ([layer(add="a"), layer(add="g", kind="group")], ["a", "g"], "a"),
    ([layer(add="a"), layer(add="g", kind="group"), layer(add="b", group="g")], ["a", "g", "b"], "b"),
    ([layer(add="g", kind="group"), layer(add="b", group="g"), layer(add="c", group=None)], ["g", "b", "c"], "c"),
    ([layer(add="g", kind="group"), layer(add="b", group="g"), layer(add="c")], ["g", "b", "c"], "c"),
    ([layer(add="a"), layer(add="b"), layer(remove="b")], ["a"], "a"),
    ([layer(add="a"), layer(add="b"), layer(select="a"), layer(remove="a")], ["b"], "b"),
    ([layer(add="a"), layer(remove="a")], [], None),
    ([layer(add="a"), layer(rename="a", to="z")], ["z"], "z"),
    ([layer(add="a"), layer(duplicate="a", to="z")], ["a", "z"], "z"),
    ([layer(add="a"), layer(add="b"), layer(add="c"), layer(move="c", to=0)], ["c", "a", "b"], "c"),
    ([layer(add="g", kind="group"), layer(add="a"), layer(move="a", to=0, group="g")], ["g", "a"], "a"),
    ([layer(add="g", kind="group"), layer(add="a", group="g"), layer(move="a", to=0, group=None)], ["a", "g"], "a"),
]


@pytest.mark.parametrize(("commands", "expected", "active"), ACTIVE)
def test_layers_and_the_active_one(commands, expected, active):
    painting = told(*commands)
    assert names(painting) == expected
    assert painting.active == active


def test_properties_are_set_and_what_is_not_named_stays():
    painting = told(layer(add="a"), layer(set="a", opacity=0.5, blend="svg:multiply"), layer(set="a", visible=False))
    node = layers.find(painting.root, "a")
    assert (node.opacity, node.blend, node.visible, node.locked) == (0.5, "multiply", False, False)


def test_strokes_go_to_the_layer_named_also_a_hidden_one():
    painting = told(layer(add="a"), layer(add="b"), layer(set="a", visible=False), stroke(layer="a"))
    assert layers.find(painting.root, "a").pyramid.nbytes > 0
    assert layers.find(painting.root, "b").pyramid.nbytes == 0


REFUSED = {
    "unknown layer": ([stroke(layer="x")], "found 'x'"),
    "locked": ([layer(add="a"), layer(set="a", locked=True), stroke()], "found layer 'a' locked"),
    "locked by its group": (
        [layer(add="g", kind="group"), layer(add="a", group="g"), layer(set="g", locked=True), stroke()],
        "found layer 'a' locked",
    ),
    "a group": ([layer(add="g", kind="group"), stroke(layer="g")], "which is a group, expected a layer"),
    "name taken": ([layer(add="a"), layer(add="a")], "found 'a' twice"),
    "rename to a taken one": ([layer(add="a"), layer(add="b"), layer(rename="a", to="b")], "found 'b' twice"),
    "remove unknown": ([layer(remove="a")], "there are no layers"),
    "move too high": ([layer(add="a"), layer(move="a", to=3)], "position: found 3"),
    "group into itself": ([layer(add="g", kind="group"), layer(move="g", to=0, group="g")], "found itself"),
    "blend": ([layer(add="a"), layer(set="a", blend="burn")], "blend: found 'burn'"),
    "alpha lock of a group": ([layer(add="g", kind="group"), layer(set="g", alpha_locked=True)], "alpha_locked"),
    "no example": ([stroke(brush={"mode": "example"})], "brush.example"),
    "clone of no layer": (
        [stroke(brush={"mode": "raster", "op": {"name": "clone", "layer": "x"}})],
        "brush.op.layer: found 'x', none of that name",
    ),
    "clone of a group": (
        [
            layer(add="a"),
            layer(add="g", kind="group"),
            stroke(brush={"mode": "raster", "op": {"name": "clone", "layer": "g"}}),
        ],
        "brush.op.layer: found 'g', a group",
    ),
    "unknown texture": ([stroke(brush={"ink": [{"texture": "moss"}]})], "brush.ink[0].texture"),
    "texture's parameter": ([stroke(brush={"ink": [{"texture": "rock", "period": 0}]})], "brush.ink[0].period"),
    "a huge stroke": ([stroke(points=[[0, 0], [1e7, 1e7]], brush={"radius": 4000})], "tiles"),
    "example of nothing": ([{"do": "texture", "name": "t", "maker": "example"}], "path: found nothing"),
    "unknown maker": ([{"do": "texture", "name": "t", "maker": "moss"}], "maker: found 'moss', expected one of"),
    "maker's parameter": ([{"do": "texture", "name": "t", "maker": "rock", "period": "x"}], "period: found"),
    "image without path": ([{"do": "texture", "name": "t", "maker": "image"}], "path: found nothing"),
    "canvas without rect": ([{"do": "texture", "name": "t", "maker": "canvas"}], "rect: found nothing"),
    "canvas too large": (
        [{"do": "texture", "name": "t", "maker": "canvas", "rect": [0, 0, 0, 99999, 99999]}],
        "rect: found",
    ),
    "canvas of an unknown layer": (
        [{"do": "texture", "name": "t", "maker": "canvas", "rect": [0, 0, 0, 8, 8], "layer": "x"}],
        "found 'x'",
    ),
}


@pytest.mark.parametrize(("commands", "message"), REFUSED.values(), ids=REFUSED)
def test_refused_in_one_line_and_nothing_changes(commands, message):
    before = told(*commands[:-1])
    with pytest.raises(Refusal) as caught:
        told(commands[-1], painting=before)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_what_is_no_step():
    changes = {"select", "texture", "view", "undo"}
    kinds = {
        "select": layer(select="a"),
        "texture": {"do": "texture", "name": "t", "maker": "rock"},
        "view": {"do": "view"},
        "undo": {"do": "undo"},
        "stroke": stroke(),
        "add": layer(add="a"),
    }
    assert {name for name, command in kinds.items() if type(parse(command)) not in STEPS} == changes


def test_a_defined_texture_paints_with_its_own_parameters():
    define = {"do": "texture", "name": "wood", "maker": "stripes", "period": 8}
    ink = [{"texture": "wood", "colour": "#ffffff"}]
    own = picture(told(define, stroke(brush={"radius": 12, "ink": ink})))
    same = picture(told(stroke(brush={"radius": 12, "ink": [{**ink[0], "texture": "stripes", "period": 8}]})))
    other = picture(told(define, stroke(brush={"radius": 12, "ink": [{**ink[0], "period": 16}]})))
    assert np.array_equal(own, same)
    assert not np.array_equal(own, other)


def test_an_image_is_found_beside_the_recording_and_again_by_its_sha(tmp_path):
    pixels = np.zeros((8, 8, 4), np.uint8)
    pixels[:4, :, 0] = 255
    pixels[..., 3] = 255
    Image.fromarray(pixels).save(tmp_path / "flag.png")
    define = {"do": "texture", "name": "flag", "maker": "image", "path": "flag.png"}
    paint = stroke(brush={"radius": 12, "hardness": 1, "colour": "#0000ff", "ink": [{"texture": "flag"}]})
    painting = told(define, paint, around=Around(folder=tmp_path))
    seen = picture(painting)
    assert seen[0, 14, 14] < 0.1 < 0.9 < seen[0, 9, 9]
    source = painting.textures["flag"].source
    again = told({**define, "sha": source.sha}, paint, around=Around(pictures={source.sha: source}))
    assert np.array_equal(picture(again), seen)
    with pytest.raises(FileError, match="not those that were there"):
        told({**define, "sha": "0" * 64}, around=Around(folder=tmp_path))


@pytest.mark.parametrize("path", ["none.png", "/dev/zero", "..", "note.txt", "a" * 300])
def test_a_picture_that_is_none(tmp_path, path):
    (tmp_path / "note.txt").write_text("no picture")
    with pytest.raises(FileError) as caught:
        told({"do": "texture", "name": "t", "maker": "image", "path": path}, around=Around(folder=tmp_path))
    assert "expected a PNG" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_rectangle_of_the_canvas_with_its_finer_detail():
    paint = stroke(brush={"radius": 20, "hardness": 1, "ink": [{"texture": "rock", "colour": "#ffffff"}]})
    capture = {
        "do": "texture",
        "name": "bit",
        "maker": "canvas",
        "rect": [0, 16, 16, 8, 8],
        "layer": "Layer 1",
        "detail": 2,
    }
    painting = told(paint, capture)
    texture = painting.textures["bit"]
    assert texture.source.data.shape == (4, 32, 32)
    assert np.array_equal(texture.source.data, picture(painting, 2, Rect.at(64, 64, 32, 32)))
    made = texture.instance({}, 0, 0)
    tile = made.appearance(0, Rect.at(0, 0, 8, 8))
    assert np.abs(tile[:3] - picture(painting, 0, Rect.at(16, 16, 8, 8))[:3]).max() < 0.2
    assert np.array_equal(made.appearance(2, Rect.at(0, 0, 32, 32)), texture.source.data)
