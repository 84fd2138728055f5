"""A fault of the program is told: in the window, on standard error, in the log; and tests fail on it."""

import json

import pytest

from app.__main__ import main
from app.log import log_file

pytestmark = [pytest.mark.window, pytest.mark.timeout(240)]


@pytest.mark.parametrize("excused", [True, False])
def test_a_fault_of_the_engine_is_told_and_the_window_goes_on(program, excused):
    app = program(module="faulty")
    before = app.parked((640, 790))[770:, :600]
    app.keys("ctrl+shift+n")
    app.wait_for("KeyError: 'missing key'")
    words = app.log.read_text()
    assert "inkfall engine: a fault, on the engine's thread" in words
    log = app.folder / "state" / "inkfall" / "log" / "inkfall.log"
    assert "KeyError: 'missing key'" in log.read_text()
    app.until(lambda screen: (screen[770:, :600] != before).any(), (640, 790), 10.0)
    assert app.process.poll() is None
    if not excused:
        with pytest.raises(AssertionError, match="missing key"):
            app.close()
    app.log.write_text("")


def test_the_doctor_names_the_log(capsys):
    assert main(["doctor", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["log"] == str(log_file())
