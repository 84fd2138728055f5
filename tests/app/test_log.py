"""The log of faults: what goes into it, from which thread, and how large it becomes."""

import subprocess
import sys
from pathlib import Path

import pytest

from app.__main__ import main
from app.cli import info
from app.faults import log

ROOT = Path(__file__).parents[2]
HOOKS = {
    "raise KeyError('in the open')": "KeyError: 'in the open'",
    "t = threading.Thread(target={}.pop, args=('on a thread',), name='filer'); t.start(); t.join()": (
        "ERROR filer: a fault that ends a thread\nTraceback",
        "KeyError: 'on a thread'",
    ),
    "type('Left', (), {'__del__': lambda self: {}.pop('left over')})()": "KeyError: 'left over'",
    "os.kill(os.getpid(), signal.SIGSEGV)": "Fatal Python error: Segmentation fault",
}


@pytest.fixture
def state(tmp_path, monkeypatch):
    """Where the log lies."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    return tmp_path / "inkfall" / "log" / "inkfall.log"


def run(code):
    """A program that opens the log and does something."""
    lines = f"import logging, os, signal, threading\nfrom app.faults.log import LOGGER, open_log\nopen_log()\n{code}\n"
    return subprocess.run([sys.executable, "-c", lines], cwd=ROOT, capture_output=True, text=True, timeout=90)


@pytest.mark.parametrize("code", HOOKS)
def test_what_nobody_takes_is_in_the_log(state, code):
    done = run(code)
    expected = HOOKS[code]
    for words in (expected,) if isinstance(expected, str) else expected:
        assert words in state.read_text()
        assert words in done.stderr or code.startswith("os.kill")


def test_an_interruption_is_no_fault(state):
    assert "KeyboardInterrupt" in run("raise KeyboardInterrupt").stderr
    (line,) = state.read_text().splitlines()
    assert " INFO MainThread: program " in line


def test_the_log_begins_anew_when_it_is_full_and_keeps_the_last_ones(state):
    done = run(f"for n in range(6): LOGGER.error('fault %d %s', n, 'x' * {log.SIZE * 2 // 3})")
    assert done.returncode == 0
    kept = sorted(state.parent.iterdir())
    assert [path.name for path in kept] == ["inkfall.log", "inkfall.log.1", "inkfall.log.2", "inkfall.log.3"]
    assert all(path.stat().st_size <= log.SIZE for path in kept)
    assert "fault 5" in state.read_text()
    assert "fault 2" in kept[-1].read_text()


def test_a_crash_after_the_log_began_anew_is_in_it(state):
    run(f"for n in range(2): LOGGER.error('%s', 'x' * {log.SIZE * 2 // 3})\nos.kill(os.getpid(), signal.SIGSEGV)")
    assert "Segmentation fault" in state.read_text()


def test_a_log_that_cannot_be_written_is_done_without(state):
    state.parent.parent.write_bytes(b"no folder")
    done = run("LOGGER.error('told all the same')")
    assert done.returncode == 0
    assert "no log is kept" in done.stderr
    assert "told all the same" in done.stderr


def broken(_options):
    raise KeyError("missing key")


def test_a_fault_of_a_command_is_one_line_that_names_the_log(state, tmp_path, monkeypatch, capsys, faults):
    monkeypatch.setattr(info, "run", broken)
    assert main(["info", str(tmp_path)]) == 1
    told = capsys.readouterr().err
    assert told.startswith("inkfall: a fault in Inkfall: KeyError: 'missing key' (test_log.py, line ")
    assert told.endswith(f"; {state} tells more\n")
    assert told.count("\n") == 1
    assert "Traceback (most recent call last)" in state.read_text()
    assert "KeyError: 'missing key'" in state.read_text()
    assert not [handler for handler in log.LOGGER.handlers if handler.__class__.__module__.startswith("logging")]
    faults.clear()


def test_without_a_log_the_line_tells_how_to_see_more(state, tmp_path, monkeypatch, capsys):
    state.parent.parent.write_bytes(b"no folder")
    monkeypatch.setattr(info, "run", broken)
    assert main(["info", str(tmp_path)]) == 1
    assert capsys.readouterr().err.endswith("; INKFALL_TRACEBACK=1 shows more\n")


def test_a_refusal_is_in_no_log(state, tmp_path, capsys):
    (tmp_path / "a.ora").write_bytes(b"no painting")
    assert main(["info", str(tmp_path / "a.ora")]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert not state.exists()
