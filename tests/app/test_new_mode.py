"""A stroke mode is a module and a row: one that is added so paints, is recorded, replayed, shown and told."""

import zipfile

import numpy as np
import pytest
import veil_mode
from immutables import Map

from app.__main__ import main
from app.desk.lab_state import LabState
from engine.brush.checks import BrushError
from engine.brush.modes import MODES
from engine.brush.settings import Brush
from engine.canvas import layers
from engine.canvas.evaluate import evaluate
from engine.numeric.address import Rect
from engine.painting import recording
from engine.painting.value import Painting
from engine.session.replay import replay
from engine.session.session import Session
from engine.studio.requests import Swatch
from engine.studio.textures.swatches import painted

FRAME = Rect.at(0, 0, 64, 64)
POINTS = np.array([[10.0, 12, 1.0], [50, 40, 0.6]])


@pytest.fixture
def veil(monkeypatch):
    monkeypatch.setitem(MODES, veil_mode.ROW.name, veil_mode.ROW)


def test_the_mode_is_unknown_without_its_row():
    with pytest.raises(BrushError, match=r'brush\.mode: found "veil", expected one of paint, erase'):
        Brush(mode="veil")


def test_a_session_paints_with_it_and_its_recording_replays_to_the_same_pixels(veil, tmp_path):
    session = Session(Painting(FRAME, 7))
    live = session.begin(0, (0, 0), Brush(mode="veil", radius=8.0, hardness=1.0, colour="#ff0000", dynamics=Map()))
    for point in POINTS:
        live.add(point[None])
    done = session.finish(live)
    path = tmp_path / "a.jsonl"
    recording.write(session.recording(), path)
    assert '"mode":"veil"' in path.read_text()
    again = replay(recording.read(path)).painting
    for level, rect in ((0, FRAME), (2, FRAME.zoomed(2)), (-2, FRAME.zoomed(-2))):
        one, other = (evaluate(layers.find(p.root, p.active).pyramid, level, rect).data for p in (done, again))
        assert one.tobytes() == other.tobytes()
    assert evaluate(layers.find(done.root, done.active).pyramid, 0, FRAME).data[:, 12, 10].tolist() == [0.5, 0, 0, 0.5]


def test_its_brushes_have_pictures_and_the_lab_paints_in_their_stead(veil):
    brush = Brush(mode="veil", colour="#00ff00")
    assert painted(Swatch("a", brush, (60, 30)), Painting(FRAME, 7))[3].max() == pytest.approx(0.5, abs=0.01)
    assert LabState().brush(brush, "#ffffff", False, frozenset()).mode == "paint"


def test_the_help_lists_it_beside_the_others(veil, capsys):
    assert main(["play", "--help"]) == 0
    told = [line.split(maxsplit=1) for line in capsys.readouterr().out.splitlines()]
    assert [line for line in told if line and line[0] in MODES] == [[row.name, row.tooltip] for row in MODES.values()]


@pytest.mark.window
def test_the_brush_panel_shows_it_and_what_is_painted_is_played_to_the_same_pixels(program, tmp_path, veil):
    app = program(module="veil_mode")
    empty = app.canvas()
    app.click("Veil")
    rows, columns = app.part("Veil")
    app.until(lambda screen: np.median(screen[rows, columns, 2] - screen[rows, columns, 0]) > 10)  # it is chosen: blue
    app.stroke((420, 300), (700, 420))
    app.canvas_unlike(empty)
    saved, script, pictures = tmp_path / "a.ora", tmp_path / "a.jsonl", (tmp_path / "a.png", tmp_path / "b.png")
    app.save_as(saved, seconds=120)
    with zipfile.ZipFile(saved) as archive:
        [member] = [name for name in archive.namelist() if name.endswith(".jsonl")]
        script.write_bytes(archive.read(member))
    assert '"mode":"veil"' in script.read_text()
    assert main(["export", str(saved), str(pictures[0])]) == 0
    assert main(["play", str(script), "--png", str(pictures[1])]) == 0
    assert pictures[0].read_bytes() == pictures[1].read_bytes()
