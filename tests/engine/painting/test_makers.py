"""Lewis' makers by command: what they make, what they refuse, replay, and paintings reopened without the pictures."""

import json

import numpy as np
import pytest
from immutables import Map
from PIL import Image

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas.evaluate import evaluate
from engine.canvas.layers import layers
from engine.files.fault import FileError
from engine.makers.makers import MAKERS
from engine.numeric.address import Rect
from engine.numeric.arithmetic import EVERYWHERE
from engine.numeric.impulse import corners, impulse_response, suggested_window
from engine.numeric.spectra import SPREAD
from engine.painting import recording as r
from engine.painting.commands import parse, to_json
from engine.session.apply import Around, Painting, Refusal, apply
from engine.session.replay import replay
from engine.session.session import Session

FRAME = Rect.at(0, 0, 48, 40)
PLACES = ((-1, Rect.at(0, 0, 24, 20)), (0, FRAME), (3, Rect.at(100, 90, 64, 64)))
BAR = {"points": [[20, 40], [44, 40]], "brush": {"radius": 5, "colour": "#ffffff", "dynamics": {}}}


@pytest.fixture
def folder(tmp_path):
    rng = np.random.default_rng(3)
    grain = rng.integers(0, 256, (40, 36), np.uint8)
    Image.fromarray(grain).save(tmp_path / "grey.png")
    Image.fromarray(rng.integers(0, 256, (40, 36, 3), np.uint8)).save(tmp_path / "colour.png")
    Image.fromarray(rng.integers(0, 256, (36, 40, 4), np.uint8)).save(tmp_path / "other.png")
    return tmp_path


def texture(maker, **members):
    return {"do": "texture", "name": "t", "maker": maker, **members}


STROKE = {
    "do": "stroke",
    "points": [[4, 6], [44, 36]],
    "brush": {"radius": 12, "ink": [{"texture": "t", "amount": 0.9, "colour": "#ffffff", "period": 24}]},
}
DEFINITIONS = {
    "spectrum": texture("spectrum", path="grey.png"),
    "coloured spectrum": texture("spectrum", path="colour.png", phase="zero", part="imag", seed=4),
    "spectrum with phases": texture("spectrum", path="colour.png", phase="grey.png"),
    "forward": texture("spectrum", path="grey.png", forward=True, part="log"),
    "spectrum scattered": texture("spectrum", path="grey.png", field="sparse", density=4, roughness=0.3),
    "shapes": texture("spectrum", size=[64, 48], shapes=[{"shape": "ring", "frequency": 0.3}, {"shape": "noise"}]),
    "strokes": texture("spectrum", size=[64, 64], strokes=[BAR], seed=9),
    "strokes scattered": texture("sparse", size=[64, 64], shapes=[{"shape": "points"}], strokes=[BAR], quantise=3),
    "shape of a picture": texture("spectrum", size=[32, 32], shapes=[{"shape": "image", "path": "colour.png"}]),
    "step": texture("sparse", size=[32, 24], step=0.1, turn=1),
    "sample": texture("sparse", path="colour.png", density=20, mean=0.1, spread=0.5),
    "photograph": texture("impulse", path="colour.png"),
    "photograph, tiled": texture("impulse", path="grey.png", window=16, average=9, phase="random", field="tile"),
}


def lines(*commands, folder):
    path = folder / "a.jsonl"
    path.write_text("\n".join(map(json.dumps, [{"inkfall": 1, "frame": [0, 0, 48, 40]}, *commands])))
    return r.read(path)


def shown(painting):
    """All values of all layers at some places."""
    return [evaluate(layer.pyramid, level, rect).data for layer in layers(painting.root) for level, rect in PLACES]


def assert_same(one, other):
    for a, b in zip(shown(one), shown(other), strict=True):
        assert np.array_equal(a, b)


@pytest.mark.parametrize("definition", DEFINITIONS.values(), ids=DEFINITIONS)
def test_it_replays_and_reopens_without_its_pictures(folder, definition):
    script = lines(definition, STROKE, folder=folder)
    session = replay(script)
    once = session.painting
    assert_same(once, replay(script).painting)
    assert once.textures["t"].source.data is not None
    save(folder / "a.ora", Snapshot(once, session.recording()))
    for name in ("grey.png", "colour.png"):
        (folder / name).unlink()
    found = open_painting(folder / "a.ora")
    assert not found.notes
    assert_same(once, found.painting)
    assert found.painting.textures["t"].parameters == once.textures["t"].parameters
    again = Session(found.painting, log=found.recording.commands, folder=folder)
    further = {**STROKE, "points": [[40, 6], [6, 36]]}
    again.do(parse(further))
    session.do(parse(further))
    assert_same(session.painting, again.painting)


def test_what_was_recorded_replays_without_its_pictures(folder):
    """The recording inside a painting, with the pictures that the painting holds."""
    session = replay(lines(DEFINITIONS["photograph"], STROKE, folder=folder))
    save(folder / "a.ora", Snapshot(session.painting, session.recording()))
    (folder / "colour.png").unlink()
    found = open_painting(folder / "a.ora")
    recorded = next(command for command in found.recording.commands if to_json(command)["do"] == "texture")
    told = to_json(recorded)
    assert told["sha"] == session.painting.textures["t"].source.sha
    assert told["window"] == session.painting.textures["t"].source.width
    assert told["average"] == 4
    around = Around(pictures=found.pictures)
    painting = apply(Painting(FRAME), recorded, around)
    painting = apply(painting, parse(STROKE), around)
    assert_same(session.painting, painting)


def test_another_picture_under_the_same_path_is_told(folder):
    session = replay(lines(DEFINITIONS["sample"], folder=folder))
    Image.open(folder / "other.png").convert("RGB").save(folder / "colour.png")
    with pytest.raises(FileError, match="not those that were there"):
        replay(session.recording())


def test_a_piece_of_the_canvas_is_an_impulse_response(folder):
    rock = {"radius": 60, "hardness": 1, "dynamics": {}, "ink": [{"texture": "rock", "colour": "#ffffff"}]}
    definition = texture("impulse", rect=[0, 4, 4, 40, 32], window=20)
    commands = [{"do": "stroke", "points": [[0, 20], [48, 20]], "brush": rock}, definition, STROKE]
    script = lines(*commands, folder=folder)
    painting = replay(script).painting
    assert painting.textures["t"].source.data.shape == (4, 20, 20)
    assert painting.textures["t"].kind == "sparse"
    assert_same(painting, replay(script).painting)


REFUSED = {
    "nothing to go by": (texture("impulse"), "path: found nothing"),
    "path and rect": (texture("sparse", path="grey.png", rect=[0, 0, 0, 4, 4]), "rect: found"),
    "field": (texture("spectrum", path="grey.png", field="line"), "field: found"),
    "step and path": (texture("sparse", path="grey.png", step=0.1), "step: found 0.1"),
    "step's edge": (texture("sparse", step=2), "step: found 2"),
    "step's size": (texture("sparse", step=0, size=[4, 999]), "size: found"),
    "part": (texture("spectrum", path="grey.png", part="half"), "part: found"),
    "forward": (texture("spectrum", path="grey.png", forward=1), "forward: found 1"),
    "phases of another size": (texture("spectrum", path="grey.png", phase="other.png"), "phase: found a picture of 40"),
    "density": (texture("sparse", path="grey.png", density=0), "density: found 0"),
    "quantise": (texture("sparse", path="grey.png", quantise=0.5), "quantise: found 0.5"),
    "window": (texture("impulse", path="grey.png", window=10000), "window: found 10000"),
    "average": (texture("impulse", path="grey.png", average=0), "average: found 0"),
    "phase": (texture("impulse", path="grey.png", phase="up"), "phase: found"),
    "size": (texture("spectrum", size=[4, 99999]), "size: found"),
    "shape": (texture("spectrum", shapes=[{"shape": "star"}]), "shapes[0].shape: found"),
    "shape's number": (texture("spectrum", shapes=[{"shape": "ring", "width": -1}]), "shapes[0].width: found -1"),
    "stroke": (texture("spectrum", strokes=[{"points": 7}]), "strokes[0].points"),
    "stroke at a level": (texture("spectrum", strokes=[{**BAR, "level": 2}]), "strokes[0]"),
    "brush of a stroke": (texture("spectrum", strokes=[{**BAR, "brush": {"radius": -1}}]), "strokes[0].brush.radius"),
}


@pytest.mark.parametrize(("definition", "message"), REFUSED.values(), ids=REFUSED)
def test_refused_in_one_line(folder, definition, message):
    with pytest.raises(Refusal) as caught:
        apply(Painting(FRAME), parse(definition), Around(folder=folder))
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("maker", ["spectrum", "sparse", "impulse"])
def test_pictures_that_are_none(folder, maker):
    (folder / "text.png").write_text("no picture")
    for path in ("none.png", "text.png", "/dev/zero"):
        with pytest.raises(FileError, match=path):
            apply(Painting(FRAME), parse(texture(maker, path=path)), Around(folder=folder))


def test_all_promised_makers_have_their_row():
    assert {"white", "rock", "stripes", "image", "canvas", "spectrum", "sparse", "impulse"} <= set(MAKERS)


def test_a_definition_survives_the_file(folder):
    command = parse(DEFINITIONS["strokes"])
    assert parse(to_json(command)) == command
    assert isinstance(command.arguments, Map)


# ---- impulse responses of photographs ----


def noise_of(taps, size, seed=0):
    """White noise through a filter, periodic: a texture whose spectrum is known."""
    noise = np.random.default_rng(seed).standard_normal(size)
    return np.fft.ifft2(np.fft.fft2(noise) * np.fft.fft2(taps, size)).real.astype(np.float32)


def test_averaging_lowers_the_variance_of_the_spectrum():
    taps = np.outer(np.hanning(9), np.hanning(5))
    photo = noise_of(taps, (256, 256))[None]
    truth = np.abs(np.fft.fft2(taps, (32, 32)))
    truth /= np.sqrt((truth**2).mean())

    def fault(average):
        found = np.abs(np.fft.fft2(impulse_response(photo, 32, average)[0]))
        found /= np.sqrt((found**2).mean())
        return np.sqrt(((found - truth) ** 2).mean())

    assert fault(36) < 0.5 * fault(1)
    assert fault(9) < fault(1)


@pytest.mark.parametrize("phase", ["window", "zero", "random"])
def test_channels_keep_their_strengths(phase):
    grain = noise_of(np.outer(np.hanning(9), np.hanning(9)), (96, 96))
    photo = np.stack([grain, 0.5 * grain, -0.25 * grain])
    found = impulse_response(photo, 32, 6, phase)
    assert found.std() == pytest.approx(SPREAD, rel=0.01)
    assert found.mean(axis=(1, 2)) == pytest.approx([0, 0, 0], abs=1e-4)
    deviations = found.std(axis=(1, 2))
    assert deviations / deviations[0] == pytest.approx([1, 0.5, 0.25], rel=0.02)
    if phase == "window":
        assert np.corrcoef(found[0].ravel(), found[2].ravel())[0, 1] == pytest.approx(-1, abs=0.02)


def test_pieces_lie_within_the_picture_and_apart():
    places = corners((100, 80), (32, 32), 30)
    assert places[0] == (34, 24)
    assert len(set(places)) == 30
    assert all(0 <= y <= 68 and 0 <= x <= 48 for y, x in places)
    assert set(corners((5, 9), (5, 9), 3)) == {(0, 0)}


def test_coarser_textures_get_larger_windows():
    fine, coarse = (noise_of(np.outer(np.hanning(n), np.hanning(n)), (300, 300))[None] for n in (5, 15))
    assert suggested_window(fine) < suggested_window(coarse) <= 128
    assert suggested_window(fine[:, :7, :20]) == 7
    for picture in (fine, coarse, fine[:, :7, :20]):
        assert suggested_window(picture, EVERYWHERE) == suggested_window(picture)
    assert suggested_window(np.zeros((1, 1, 1), np.float32)) == 1


def test_a_large_photograph_is_a_sample(tmp_path):
    photo = np.tile(np.random.default_rng(1).integers(0, 256, (300, 360), np.uint8), (8, 6))
    Image.fromarray(photo).save(tmp_path / "photo.png")
    found = apply(Painting(), parse(texture("sparse", path="photo.png")), Around(folder=tmp_path)).textures["t"]
    assert (found.source.width, found.source.height) == (2160, 2400)
    assert found.instance({}, 0, 0).appearance(0, Rect.at(0, 0, 8, 8)).std() > 0.01
