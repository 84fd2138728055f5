"""The makers `match` and `mix`: replay, paintings reopened without the examples, what changes and what is refused;
ink whose weight goes with the pressure."""

import json

import numpy as np
import pytest
from immutables import Map
from PIL import Image

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.brush.checks import BrushError
from engine.brush.ink import resolve
from engine.brush.mixture import mixture
from engine.brush.parts import Component
from engine.brush.settings import Brush, from_json, to_json
from engine.brush.sway import Hat
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.files.fault import FileError
from engine.files.strict_json import Fields
from engine.makers import definitions, heeger_bergen
from engine.makers.lewis import flattened
from engine.makers.makers import MAKERS
from engine.numeric.address import Rect
from engine.numeric.grid import Q
from engine.painting import recording as r
from engine.painting.capture import PictureSource
from engine.painting.commands import parse
from engine.session.apply import Around, Painting, Refusal, apply
from engine.session.replay import replay
from engine.session.session import Session
from engine.texture.adjusting import Band, adjusted
from engine.texture.image import ImageSource
from engine.texture.matching import Shape, analysed, matched_colours, noise
from engine.texture.matching import matched as matched_planes

FRAME = Rect.at(0, 0, 48, 40)
PLACES = ((-2, Rect.at(0, 0, 12, 10)), (0, FRAME), (3, Rect.at(100, 90, 64, 64)))
SMALL = {"size": [32, 24], "levels": 2}


@pytest.fixture
def folder(tmp_path):
    rng = np.random.default_rng(3)
    Image.fromarray(rng.integers(0, 256, (40, 36), np.uint8)).save(tmp_path / "grey.png")
    smooth = Image.fromarray(rng.integers(0, 256, (10, 12, 3), np.uint8)).resize((48, 40))
    smooth.save(tmp_path / "colour.png")
    Image.fromarray(rng.integers(0, 256, (36, 40, 4), np.uint8)).save(tmp_path / "alpha.png")
    return tmp_path


def texture(maker, **members):
    return {"do": "texture", "name": "t", "maker": maker, **members}


def stroke(**component):
    ink = [{"texture": "t", "amount": 0.9, "colour": "#ffffff", **component}]
    return {"do": "stroke", "points": [[4, 6, 0.1], [44, 36, 1]], "brush": {"radius": 12, "ink": ink}}


DEFINITIONS = {
    "match": texture("match", path="colour.png", **SMALL),
    "grey": texture("match", path="grey.png", pyramid="laplacian", iterations=2, **SMALL),
    "with a start": texture("match", path="alpha.png", start="colour.png", **SMALL),
    "changed": texture(
        "match",
        path="colour.png",
        bands=[{"level": 0, "orientation": 1, "gain": 2}, {"level": 1, "shaping": "power"}],
        axes=[1, 0.2],
        **SMALL,
    ),
    "palette": texture("mix", path="colour.png", pattern="grey.png", **SMALL),
    "bands": texture("mix", path="colour.png", pattern={"path": "grey.png"}, how="bands", split=1, **SMALL),
    "average": texture("mix", path="colour.png", pattern="alpha.png", how="average", weight=0.3, **SMALL),
    "series": texture("mix", path="colour.png", pattern="grey.png", how="average", stages=3, **SMALL),
    "objects": texture("match", path="colour.png", structure="objects", size=[40, 32]),
    "statistics with alpha": texture("match", path="alpha.png", structure="statistics", size=[33, 24], seed=2),
    "series of statistics": texture(
        "mix", path="colour.png", pattern="grey.png", how="average", stages=2, structure="statistics", size=[24, 24]
    ),
    "series with alpha": texture("mix", path="colour.png", pattern="alpha.png", how="average", stages=3, **SMALL),
}


def lines(*commands, folder):
    path = folder / "a.jsonl"
    path.write_text("\n".join(map(json.dumps, [{"inkfall": 1, "frame": [0, 0, 48, 40]}, *commands])))
    return r.read(path)


def shown(painting):
    return [evaluate(layer.pyramid, level, rect).data for layer in layers(painting.root) for level, rect in PLACES]


def assert_same(one, other):
    assert len(shown(one)) == len(shown(other)) > 0
    for a, b in zip(shown(one), shown(other), strict=True):
        assert np.array_equal(a, b)


PAINTED = [(name, None) for name in DEFINITIONS]
PAINTED += [
    (name, weight)
    for name in ("match", "series", "series with alpha")
    for weight in (0.4, "pressure", [[0, 0.2], [1, 0.9]])
]


@pytest.mark.parametrize(("name", "weight"), PAINTED)
def test_it_replays_and_reopens_without_its_examples(folder, name, weight):
    definition = DEFINITIONS[name]
    painted = stroke(period=24) if weight is None else stroke(period=24, weight=weight)
    session = replay(lines(definition, painted, folder=folder))
    once = session.painting
    assert_same(once, replay(session.recording()).painting)
    assert once.textures["t"].kind == ("series" if "stages" in definition else "matched")
    save(folder / "a.ora", Snapshot(once, session.recording()))
    for path in folder.glob("*.png"):
        path.unlink()
    found = open_painting(folder / "a.ora")
    assert not found.notes
    assert_same(once, found.painting)
    again = Session(found.painting, log=found.recording.commands, folder=folder)
    further = parse({**painted, "points": [[40, 6, 0.8], [6, 36, 0.1]]})
    again.do(further)
    session.do(further)
    assert_same(session.painting, again.painting)


def test_it_is_the_texture_that_the_engine_makes(folder):
    made = replay(lines(DEFINITIONS["match"], folder=folder)).painting.textures["t"]
    example = PictureSource(folder, None).picture(Fields({"path": "colour.png"}, ""))[:3]
    pattern = analysed(example, Shape("steerable", 2, 4))
    planes = matched_planes(pattern, noise(pattern.colours.count, (24, 32), 0))
    assert np.array_equal(made.source.data[:3], matched_colours(pattern, planes))
    assert made.instance({}, 0, 0).roughness == made.parameters["roughness"]


def test_a_rectangle_of_the_canvas_is_an_example(folder):
    rock = {"radius": 60, "hardness": 1, "dynamics": {}, "ink": [{"texture": "rock", "period": 8, "colour": "#ffffff"}]}
    ground = {"do": "stroke", "points": [[0, 20], [48, 20]], "brush": rock}
    definition = texture("mix", rect=[0, 4, 4, 40, 32], pattern={"rect": [1, 0, 0, 40, 40]}, **SMALL)
    session = replay(lines(ground, definition, stroke(), folder=folder))
    assert session.painting.textures["t"].source.data[0].std() > 0.05
    assert_same(session.painting, replay(session.recording()).painting)


def test_another_example_under_the_same_path_is_told(folder):
    session = replay(lines(DEFINITIONS["palette"], folder=folder))
    Image.open(folder / "alpha.png").convert("RGB").save(folder / "grey.png")
    with pytest.raises(FileError, match="are not those recorded"):
        replay(session.recording())


def test_steps_come_one_by_one_and_end_with_the_texture(folder):
    members = Fields({key: v for key, v in DEFINITIONS["series"].items() if key not in ("do", "name", "maker")}, "")
    plan = heeger_bergen.read("mix", members, PictureSource(folder, None))
    made = list(heeger_bergen.steps(plan))
    done = [step.done for step in made]
    assert done == sorted(done)
    assert done[-1] == 1.0
    assert len(made) > 60
    assert sum(step.colours is not None for step in made) == 3 * plan.iterations
    assert made[-1].colours.shape == (3, 3 * 24, 32)


REFUSED = {
    "nothing to go by": (texture("match"), "path: found nothing"),
    "no second": (texture("mix", path="grey.png"), "pattern: found nothing"),
    "second of another kind": (texture("mix", path="grey.png", pattern=7), "pattern: found 7"),
    "nothing painted": (texture("match", rect=[0, 0, 0, 30, 30]), "rect: found nothing but"),
    "size": (texture("match", path="grey.png", size=[0, 4]), "size: found"),
    "huge": (texture("match", path="grey.png", size=[9999999, 4]), "size: found"),
    "levels": (texture("match", path="grey.png", levels=-1), "levels: found -1"),
    "orientations": (texture("match", path="grey.png", orientations=0), "orientations: found 0"),
    "iterations": (texture("match", path="grey.png", iterations=0), "iterations: found 0"),
    "pyramid": (texture("match", path="grey.png", pyramid="cheops"), "pyramid: found"),
    "how": (texture("mix", path="grey.png", pattern="grey.png", how="well"), "how: found"),
    "weight": (texture("mix", path="grey.png", pattern="grey.png", weight=2), "weight: found 2"),
    "series of palettes": (texture("mix", path="grey.png", pattern="grey.png", stages=3), "how: found"),
    "stages": (texture("mix", path="grey.png", pattern="grey.png", how="average", stages=10), "stages: found 10"),
    "bands": (texture("match", path="grey.png", bands={}), "bands: found"),
    "band": (texture("match", path="grey.png", bands=[{"gain": 2}]), "bands[0].level: found nothing"),
    "gain": (texture("match", path="grey.png", bands=[{"level": 0, "gain": -1}]), "bands[0].gain: found -1"),
    "shaping": (texture("match", path="grey.png", bands=[{"level": 0, "shaping": "S"}]), "bands[0].shaping: found"),
    "axes": (texture("match", path="grey.png", axes=[1, "a"]), "axes: found"),
    "structure": (texture("match", path="grey.png", structure="brick"), "structure: found"),
    **{
        f"{name} of a structure": (
            texture("match", path="grey.png", structure="full", **{name: value}),
            f"{name}: found it, expected",
        )
        for name, value in {
            "pyramid": "steerable",
            "levels": 4,
            "orientations": 4,
            "iterations": 5,
            "start": "colour.png",
            "bands": [],
            "axes": [],
        }.items()
    },
    "structure of a palette": (
        texture("mix", path="grey.png", pattern="grey.png", structure="coarse"),
        'how: found "palette", expected average',
    ),
    "roughness": (texture("match", path="grey.png", roughness=7, **SMALL), "roughness: found 7"),
}


@pytest.mark.parametrize(("definition", "message"), REFUSED.values(), ids=REFUSED)
def test_refused_in_one_line(folder, definition, message):
    with pytest.raises(Refusal) as caught:
        apply(Painting(FRAME), parse(definition), Around(folder=folder))
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_both_makers_have_their_row_and_travel_with_brushes(tmp_path):
    assert {"match", "mix"} <= set(MAKERS)
    for definition, kind in ((DEFINITIONS["match"], "matched"), (DEFINITIONS["series"], "series")):
        (command,) = definitions.read([{k: v for k, v in definition.items() if k != "do"}], "textures", tmp_path)
        assert definitions.kind_of(command) == kind
        assert all(str(tmp_path) in command.arguments[name] for name in ("path", "pattern") if name in definition)
        kept = definitions.portable("t", kind, command.arguments.set("sha", "0").set("examples", ("1",)))
        assert kept == command
        assert definitions.defined_by(command, kind, command.arguments.set("roughness", 0.3))


# ---- what sliders change ----


def example():
    rng = np.random.default_rng(5)
    return np.clip(0.5 + 0.15 * rng.standard_normal((3, 48, 48)) * np.array([1, 0.7, 0.4])[:, None, None], 0, 1).astype(
        np.float32
    )


def test_a_louder_subband_is_louder_in_the_texture():
    pattern = analysed(example(), Shape("steerable", 2, 2))
    louder = adjusted(pattern, [Band(0, 1, 2.0)])
    start = noise(pattern.colours.count, (48, 48), 1)
    for place, ordered in (
        analysed(matched_colours(louder, matched_planes(louder, start)), louder.shape, pattern.colours).bands[0].items()
    ):
        before = pattern.bands[0][place].std()
        ratio = ordered.std() / before
        assert (1.5 < ratio < 2.3) if (place.level, place.orientation) == (0, 1) else (0.7 < ratio < 1.35)


def test_changes_that_change_nothing_leave_the_pattern():
    pattern = analysed(example(), Shape("steerable", 2, 2))
    assert adjusted(pattern, [Band(0), Band(1, 0, 1.0, "identity")], (1.0, 1.0)) is pattern


def test_a_curve_bends_the_sizes_and_keeps_order():
    pattern = adjusted(analysed(example(), Shape("steerable", 1, 1)), [Band(0, None, 1.0, "power")])
    for bands in pattern.bands:
        for ordered in bands.values():
            assert (np.diff(ordered) >= 0).all()
    plain = analysed(example(), Shape("steerable", 1, 1))
    (place,) = (place for place in plain.bands[0] if place.level == 0)
    a, b = plain.bands[0][place], pattern.bands[0][place]
    assert np.abs(b - b.mean()).max() == pytest.approx(np.abs(a - a.mean()).max(), rel=1e-2)
    assert b.std() < 0.6 * a.std()


def test_axes_of_colour_can_be_taken_away():
    pattern = adjusted(analysed(example(), Shape("steerable", 2, 2)), (), (1.0, 0.0, 0.0))
    planes = matched_planes(pattern, noise(pattern.colours.count, (32, 32), 0))
    colours = pattern.colours.unclipped(planes).reshape(3, -1)
    spreads = np.sqrt(np.maximum(np.linalg.eigvalsh(np.cov(colours)), 0.0))
    assert spreads[-1] > 20 * spreads[-2]


# ---- alpha ----


def torn(folder):
    """A picture with holes, soft at their rims: its pixels, premultiplied RGBA (4, h, w) of 0..1."""
    rng = np.random.default_rng(8)
    colours = Image.fromarray(rng.integers(60, 256, (12, 12, 3), np.uint8)).resize((48, 48))
    alpha = Image.fromarray(rng.integers(0, 256, (9, 9), np.uint8)).resize((48, 48))
    alpha = alpha.point(lambda value: min(max(3 * value - 300, 0), 255))
    colours.putalpha(alpha)
    colours.save(folder / "torn.png")
    return PictureSource(folder, None).picture(Fields({"path": "torn.png"}, ""))


TORN = texture("match", path="torn.png", size=[64, 48], levels=3)


def flat_stroke(**component):
    brush = {"radius": 60, "hardness": 1, "dynamics": {}, "colour": "#339966", "ink": [{"texture": "t", **component}]}
    return {"do": "stroke", "points": [[0, 20], [48, 20]], "brush": brush}


def test_alpha_is_matched_with_the_colours(folder):
    example = torn(folder)
    made = replay(lines(TORN, folder=folder)).painting.textures["t"].source.data
    assert (made[:3] <= made[3]).all()
    for own, found in zip(example, made, strict=True):
        assert found.mean() == pytest.approx(own.mean(), abs=0.03)
        assert found.std() == pytest.approx(own.std(), rel=0.12)
    assert np.corrcoef(made[0].ravel(), made[3].ravel())[0, 1] == pytest.approx(
        np.corrcoef(example[0].ravel(), example[3].ravel())[0, 1], abs=0.12
    )
    pattern = analysed(example, Shape("steerable", 3, 4))
    planes = matched_planes(pattern, noise(pattern.colours.count, (48, 64), 0))
    assert pattern.colours.count == 4
    wanted = matched_colours(pattern, planes)
    assert np.array_equal(made, np.minimum(wanted, wanted[3]))


def test_ink_covers_where_its_alpha_says(folder):
    torn(folder)
    green = np.array([0.2, 0.6, 0.4], np.float32)[:, None, None]
    drawn = [flat_stroke(), flat_stroke(amount=0.5), flat_stroke(colour="#8080ff")]
    for line, amount, tint in zip(
        drawn, (1.0, 0.5, 1.0), ((1, 1, 1), (1, 1, 1), (128 / 255, 128 / 255, 1)), strict=True
    ):
        painting = replay(lines(TORN, line, folder=folder)).painting
        made = painting.textures["t"].source.data[:, :40, :48]
        seen = evaluate(next(iter(layers(painting.root))).pyramid, 0, FRAME).data
        tinted = made[:3] * np.array(tint, np.float32)[:, None, None]
        assert np.abs(seen[:3] - (green + amount * (tinted - made[3] * green))).max() < 4 * Q
        assert (seen[3] == 1.0).all()


@pytest.mark.parametrize("curve", [None, "negate"])
def test_where_alpha_is_nothing_the_brush_s_colour_stays_at_every_depth(folder, curve):
    torn(folder)
    component = {} if curve is None else {"shaping": curve}
    painting = replay(lines(TORN, flat_stroke(roughness=0.5, **component), folder=folder)).painting
    made = painting.textures["t"].instance({"roughness": 0.5}, 0, 0)
    pyramid = next(iter(layers(painting.root))).pyramid
    green = np.array([0.2, 0.6, 0.4], np.float32)[:, None, None]
    for level in (0, 2, 4):
        rect = Rect.at(8 << level, 8 << level, 96, 96)
        seen, alpha = evaluate(pyramid, level, rect).data[:3], made.cover.appearance(level, rect)[0]
        clear = np.abs(alpha) < 0.004
        assert clear.sum() > 40
        assert np.median(np.abs(seen - green).max(0)[clear]) < 0.02
        assert seen.std() > 0.05


def test_a_series_with_alpha_goes_with_the_pressure(folder):
    torn(folder)
    define = texture("mix", path="colour.png", pattern="torn.png", how="average", stages=3, **SMALL)

    def painted(pressure, **component):
        line = {**flat_stroke(**component), "points": [[0, 20, pressure], [48, 20, pressure]]}
        return shown(replay(lines(define, line, folder=folder)).painting)

    for pressure in (0.0, 0.5, 1.0):
        for a, b in zip(painted(pressure, weight="pressure"), painted(0.7, weight=pressure), strict=True):
            assert np.array_equal(a[:4], b[:4])
    opaque, clear = painted(0.0, weight="pressure")[1], painted(1.0, weight="pressure")[1]
    green = np.array([0.2, 0.6, 0.4], np.float32)[:, None, None]
    assert (np.abs(clear[:3] - green).max(0) < 0.02).mean() > 0.1 + (np.abs(opaque[:3] - green).max(0) < 0.02).mean()


def test_what_was_recorded_before_alpha_counted_is_as_it_was(folder):
    """Then an example was known by the pixels that it has without its alpha."""
    example = torn(folder)
    without = flattened(example)
    sha = ImageSource.of("", heeger_bergen.rgba(without)).sha[:16]
    made = replay(lines({**TORN, "examples": [sha]}, folder=folder)).painting.textures["t"].source
    assert made.opaque
    pattern = analysed(without, Shape("steerable", 3, 4))
    planes = matched_planes(pattern, noise(pattern.colours.count, (48, 64), 0))
    assert np.array_equal(made.data[:3], matched_colours(pattern, planes))
    both = texture("mix", path="torn.png", pattern="torn.png", how="average", **SMALL, examples=[sha, sha])
    assert replay(lines(both, folder=folder)).painting.textures["t"].source.opaque
    with pytest.raises(FileError, match="are not those recorded"):
        replay(lines({**TORN, "examples": ["0" * 16]}, folder=folder))


# ---- the weight under the pen ----


def test_parts_of_stages_add_up_and_meet_only_neighbours():
    pressure = np.linspace(0, 1, 101)[None]
    parts = np.stack([Hat(((0.0, 0.0), (0.5, 1.0), (1.0, 0.3)), k, 5).of(pressure) for k in range(5)])
    assert np.abs(parts.sum(0) - 1).max() < 1e-6
    assert (parts > 0).sum(0).max() <= 2


def test_a_steady_pressure_is_a_steady_weight(folder):
    """At a stage, the same bits as the brush with that weight; between two, what lies between them to the grid."""
    define = DEFINITIONS["series"]

    def painted(pressure, **component):
        brush = {"radius": 30, "dynamics": {}, "ink": [{"texture": "t", **component}]}
        line = {"do": "stroke", "points": [[0, 20, pressure], [48, 20, pressure]], "brush": brush}
        return shown(replay(lines(define, line, folder=folder)).painting)

    for pressure, bound in ((0.5, 0.0), (1.0, 0.0), (0.25, 3 * Q)):
        both = zip(painted(pressure, weight="pressure"), painted(0.7, weight=pressure), strict=True)
        for a, b in list(both)[: None if bound == 0.0 else 2]:  # finer noise is matched to the stages
            assert np.abs(a[:4] - b[:4]).max() <= bound


def test_other_modes_take_the_weight_of_full_pressure(folder):
    textures = replay(lines(DEFINITIONS["series"], folder=folder)).painting.textures
    component = Component("t", parameters=Map(weight=((0.0, 0.0), (1.0, 0.5))))
    ink = mixture(Brush(mode="raster", ink=(component,)), textures, 0, 0)
    assert not ink.swayed
    assert ink.loaded[0].instance.weight == 0.5


def test_weights_in_brushes(folder):
    textures = replay(lines(DEFINITIONS["series"], folder=folder)).painting.textures
    data = {"ink": [{"texture": "t", "amount": 1.0, "colour": "#ffffff", "weight": [[0.0, 0.2], [1.0, 0.9]]}]}
    brush = from_json(data)
    assert to_json(brush)["ink"] == data["ink"]
    ink = resolve(brush, textures, 0, 0)
    assert len(ink.loaded) == len(ink.swayed) == 3
    for wrong in ("tilt", [[0, 2]], [], {"a": 1}, 1.5):
        with pytest.raises(BrushError, match=r"brush\.ink\[0\]\.weight"):
            resolve(from_json({"ink": [{"texture": "t", "weight": wrong}]}), textures, 0, 0)
