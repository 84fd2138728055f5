"""Textures with learnt detail by command: recorded, kept in files, and refused; all others stay as they are."""

import json

import numpy as np
import pytest
from PIL import Image

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.canvas.reading import layer_planes
from engine.makers import definitions
from engine.numeric.address import Rect
from engine.numeric.arithmetic import EVERYWHERE
from engine.painting import recording as r
from engine.painting.commands import parse, to_json
from engine.painting.grown import settled
from engine.session.apply import Around, Painting, Refusal, apply
from engine.session.replay import replay
from engine.texture.learnt.inks import LearntImage, LearntMatched

PLACES = tuple((level, Rect.at(12 << level, 10 << level, 24, 20)) for level in range(5))
DEFINITIONS = {
    "learn": {"maker": "learn", "path": "a.png", "strength": 0.5, "octaves": 1},
    "image": {"maker": "image", "path": "a.png"},
    "clear image": {"maker": "image", "path": "clear.png"},
    "canvas": {"maker": "learn", "rect": [0, 4, 4, 40, 32], "detail": 0},
    "match": {"maker": "match", "path": "a.png", "size": [32, 32]},
    "mix": {"maker": "mix", "path": "a.png", "pattern": "b.png", "how": "average", "stages": 3, "size": [16, 16]},
    "example": {"maker": "example", "path": "clear.png"},
}
STROKE = {
    "do": "stroke",
    "points": [[4, 6], [44, 36]],
    "brush": {"radius": 12, "ink": [{"texture": "t", "amount": 0.9, "colour": "#ffffff"}]},
}
ROCK = {"do": "stroke", "points": [[0, 20], [48, 20]]}
ROCK["brush"] = {"radius": 60, "hardness": 1, "dynamics": {}, "ink": [{"texture": "rock", "colour": "#ffffff"}]}


@pytest.fixture
def folder(tmp_path):
    random = np.random.default_rng(3)
    rough = np.repeat(np.repeat(random.integers(0, 256, (12, 12, 4)), 4, axis=0), 4, axis=1)
    pixels = np.clip(rough + random.integers(-20, 20, rough.shape), 0, 255).astype(np.uint8)
    Image.fromarray(pixels).save(tmp_path / "clear.png")
    Image.fromarray(np.ascontiguousarray(pixels[..., :3])).save(tmp_path / "a.png")
    Image.fromarray(np.ascontiguousarray(pixels[::-1, ..., 0])).save(tmp_path / "b.png")
    return tmp_path


def texture(**members):
    return {"do": "texture", "name": "t", "detail": "learnt", **members}


def replayed(folder, *commands, version=2):
    path = folder / "a.jsonl"
    header = {"inkfall": version, "frame": [0, 0, 48, 40]}
    path.write_text("\n".join(map(json.dumps, [header, *commands])))
    return replay(r.read(path))


def shown(painting):
    (layer,) = layers(painting.root)
    return [evaluate(layer.pyramid, level, rect).data for level, rect in PLACES]


def assert_same(one, other):
    assert all(np.array_equal(a, b) for a, b in zip(shown(one), shown(other), strict=True))


@pytest.mark.parametrize("name", DEFINITIONS)
def test_it_replays_and_reopens_without_its_pictures(folder, name):
    session = replayed(folder, ROCK, texture(**DEFINITIONS[name]), STROKE)
    once = session.painting
    maps = once.textures["t"].maps
    assert maps is not None
    recorded = next(command for command in session.recording().commands if to_json(command)["do"] == "texture")
    assert to_json(recorded)["maps_sha"] == maps.sha
    assert r.version_of(recorded) == 2
    save(folder / "a.ora", Snapshot(once, session.recording()))
    for path in folder.glob("*.png"):
        path.unlink()
    found = open_painting(folder / "a.ora")
    assert not found.notes
    assert_same(once, found.painting)
    assert found.painting.textures["t"].maps.sha == maps.sha
    around = Around(pictures=found.pictures, arithmetic=once.arithmetic)
    painting = apply(Painting(once.frame, arithmetic=once.arithmetic), parse(ROCK), around)
    again = apply(apply(painting, recorded, around), parse(STROKE), around)
    assert again.textures["t"].maps.sha == maps.sha
    assert_same(once, again)


def test_detail_goes_on_below_the_pictures_own_pixels(folder):
    sizes = {}
    for detail in ({}, {"detail": "learnt"}):
        members = {"do": "texture", "name": "t", "maker": "image", "path": "a.png", **detail}
        found = replayed(folder, members, STROKE).painting
        (layer,) = layers(found.root)
        ink = layer.pyramid.all_records().__iter__().__next__()[1].inks[0]
        sizes[bool(detail)] = [ink.bandpass(level, Rect.at(0, 0, 64, 64)) for level in (1, 2, 3)]
        assert isinstance(ink, LearntImage) == bool(detail)
    assert sizes[False] == [None, None, None]
    assert [one is not None for one in sizes[True]] == [True, True, False]


@pytest.mark.parametrize(("path", "more"), [("clear.png", {}), ("a.png", {"strength": 0.6, "octaves": 1})])
def test_strokes_that_grow_go_on_below_their_examples_pixels(folder, path, more):
    """Replayed, saved and opened without the picture and its texture they look the same; with other detail they are
    another plot."""
    brush = {"radius": 14, "hardness": 1, "mode": "example", "example": "t"}
    grow = {"do": "stroke", "points": [[4, 6], [44, 36]], "brush": brush}
    gone = {"do": "texture", "name": "t", "maker": "rock"}
    session = replayed(folder, texture(maker="example", path=path, **more), grow, gone)
    once, plain = settled(session.painting), replayed(folder, {**texture(maker="example", path=path), "detail": None})
    assert "maps_sha" not in plain.recording().commands[0].arguments
    plain = settled(apply(plain.painting, parse(grow)))
    own, other = (layers_of(one)[0].growth[0] for one in (once, plain))
    assert own.key != other.key
    assert (own.finest, other.finest) == (more.get("octaves", 2), 0)
    seen = [layer_planes(layers_of(one)[0], 0, Rect(0, 0, 48, 40)) for one in (once, plain)]
    assert np.array_equal(*seen)
    save(folder / "a.ora", Snapshot(once, session.recording()))
    (folder / path).unlink()
    found = open_painting(folder / "a.ora")
    assert not found.notes
    again = settled(found.painting)
    for level, rect in PLACES[:4]:
        near, opened = (layer_planes(layers_of(one)[0], level, rect) for one in (once, again))
        assert np.array_equal(near, opened)
    assert layers_of(again)[0].growth[0].region.exemplar.learning == own.region.exemplar.learning


def test_two_ways_to_say_it(folder):
    learnt = {"do": "texture", "name": "t", "maker": "learn", "path": "a.png"}
    assert_same(
        replayed(folder, learnt, STROKE).painting,
        replayed(folder, texture(maker="image", path="a.png"), STROKE).painting,
    )


def test_definitions_of_brushes(folder):
    """One that travels with a brush is known again, and told from the same picture without detail."""
    found = replayed(folder, texture(**DEFINITIONS["match"])).painting.textures["t"]
    assert isinstance(found.instance({}, 0, 0), LearntMatched)
    absolute = found.parameters.set("path", str(folder / "a.png"))
    told = definitions.portable("t", found.kind, absolute)
    assert told.arguments["detail"] == "learnt"
    assert "maps_sha" not in told.arguments
    assert definitions.defined_by(told, found.kind, absolute)
    assert not definitions.defined_by(told, found.kind, absolute.delete("detail"))
    plain = definitions.portable("t", found.kind, absolute.delete("detail"))
    assert not definitions.defined_by(plain, found.kind, absolute)


REFUSED = {
    "detail": ({"maker": "image", "path": "a.png", "detail": "fine"}, 'detail: found "fine"'),
    "strength": ({"maker": "learn", "path": "a.png", "strength": 2}, "strength: found 2"),
    "octaves": ({"maker": "match", "path": "a.png", "octaves": 3}, "octaves: found 3"),
    "nothing": ({"maker": "learn"}, "rect: found nothing"),
}


@pytest.mark.parametrize(("definition", "message"), REFUSED.values(), ids=REFUSED)
def test_refused_in_one_line(folder, definition, message):
    with pytest.raises(Refusal) as caught:
        apply(Painting(), parse(texture(**definition)), Around(folder=folder, arithmetic=EVERYWHERE))
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("path", ["a.png", "clear.png"])
@pytest.mark.parametrize(("level", "at"), [(0, (3, -2)), (2, (-40, 17))])
def test_a_layer_goes_on_below_its_pictures_own_pixels(folder, path, level, at):
    """Its pixels are those that it has without; the ones below are the texture's, moved there; undo takes all away."""
    add = {"do": "layer", "add": "Photo", "kind": "picture", "texture": "t", "level": level, "at": list(at)}
    plain = replayed(folder, {"do": "texture", "name": "t", "maker": "image", "path": path}, add).painting
    session = replayed(folder, texture(maker="image", path=path, strength=0.7), add)
    found, texture_made = session.painting, session.painting.textures["t"]
    one, other = (layers_of(painting)[-1].pyramid for painting in (plain, found))
    own = Rect.at(*at, 48, 48)
    assert np.array_equal(evaluate(one, level, own).data, evaluate(other, level, own).data[:4])
    inner = Rect.at(2 * at[0] + 16, 2 * at[1] + 16, 64, 64)
    added = evaluate(other, level + 1, inner).data[:3] - evaluate(one, level + 1, inner).data[:3]
    ink = texture_made.instance({"period": 48}, level, 0)
    wanted = ink.bandpass(level + 1, Rect.at(16, 16, 64, 64))
    seen = np.abs(added - wanted) < 1e-4  # where nothing is cut off at alpha, or at nothing
    assert seen.mean() > (0.99 if path == "a.png" else 0.9)
    save(folder / "a.ora", Snapshot(found, session.recording()))
    again = layers_of(open_painting(folder / "a.ora").painting)[-1].pyramid
    assert np.array_equal(evaluate(again, level + 2, inner).data, evaluate(other, level + 2, inner).data)
    session.do(parse({"do": "undo"}))
    assert len(layers_of(session.painting)) == 1


def layers_of(painting):
    return tuple(layers(painting.root))
