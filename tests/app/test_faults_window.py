"""A fault of the program is told: in the window, on standard error, in the log; and tests fail on it."""

import json
import os
import subprocess
import time

import pytest
from dragging import Drag

from app.__main__ import main
from app.faults.fault_guard import QUIET
from app.faults.log import log_file

pytestmark = pytest.mark.window


@pytest.mark.parametrize("excused", [True, False])
def test_a_fault_of_the_engine_is_told_and_the_window_goes_on(program, excused):
    app = program(module="faulty")
    before = app.parked()[770:, :600]
    app.keys("ctrl+shift+n")
    app.wait_for("KeyError: 'missing key'")
    words = app.log.read_text()
    assert "inkfall engine: a fault, on the engine's thread" in words
    log = app.folder / "state" / "inkfall" / "log" / "inkfall.log"
    app.wait_until(lambda: "KeyError: 'missing key'" in log.read_text(), "it is not in the log")
    app.until(lambda screen: (screen[770:, :600] != before).any())
    assert app.process.poll() is None
    if not excused:
        with pytest.raises(AssertionError, match="missing key"):
            app.close()
    app.close_excused()


def window_of(app):
    command = ["xdotool", "search", "--onlyvisible", "--name", "Inkfall"]
    return int(subprocess.check_output(command, env={**os.environ, "DISPLAY": app.display}, text=True).split()[0])


def test_a_fault_of_the_window_costs_no_painting(program, tmp_path):
    began, app = time.monotonic(), program(module="faulty_window")
    app.wait_for("KeyError: 'missing layer'")
    before = app.canvas()
    app.stroke((400, 300), (700, 500))
    painted = app.canvas_unlike(before)
    app.keys("4")
    app.wait_for("KeyError: 'missing key'")
    app.keys("r")
    app.stroke((500, 300), (600, 400))
    app.wait_for("KeyError: 'missing point'")
    (tmp_path / "stone.png").write_bytes(b"")
    Drag(app.display, window_of(app), tmp_path / "stone.png").drop(600, 600)
    app.wait_for("KeyError: 'missing panel'")
    assert app.comes_to(painted)
    app.keys("b")
    app.stroke((400, 600), (800, 250))
    app.canvas_unlike(painted)
    app.save_as(tmp_path / "spared.ora", 90.0)  # its kernels may still be compiled
    app.wait_for("KeyError: 'missing file'")
    app.canvas()
    assert app.process.poll() is None
    words = app.log.read_text()
    log = app.folder / "state" / "inkfall" / "log" / "inkfall.log"
    for what in ("layer", "key", "point", "panel", "file"):
        app.wait_until(lambda what=what: f"KeyError: 'missing {what}'" in log.read_text(), f"{what} is not in the log")
    assert log.read_text().count("missing layer") <= 2 * (1 + (time.monotonic() - began) / QUIET), "in every frame"
    assert "imgui-error" not in words
    app.close_excused()
    assert main(["info", str(tmp_path / "spared.ora")]) == 0


def test_the_doctor_names_the_log(capsys):
    assert main(["doctor", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["log"] == str(log_file())
