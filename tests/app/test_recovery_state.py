"""What is on the cards of paintings that can be had back."""

import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import pytest

from app.desk.asked import Asked
from app.desk.recovery import recovery_state as state
from app.desk.recovery import recovery_work
from app.faults import crashes
from app.faults.log import program_line
from engine.journal import entries

ROOT = Path(__file__).parents[2]
NOON = time.mktime((2026, 3, 2, 12, 0, 0, 0, 0, -1))


def entry(ident, when, alive=False, program=""):
    return SimpleNamespace(ident=ident, when=when, alive=alive, program=program)


@pytest.mark.parametrize(
    ("before", "words"),
    [
        (60, "Today, 11:59"),
        (12 * 3600, "Today, 00:00"),
        (12 * 3600 + 60, "Yesterday, 23:59"),
        (3 * 86400, "27 February, 12:00"),
        (300 * 86400, "6 May 2025, 12:00"),
    ],
)
def test_a_day_is_told_as_people_do(before, words):
    if time.tzname[0] == "UTC":  # elsewhere a clock may be changed in between
        assert state.when_text(NOON - before, NOON) == words


@pytest.mark.parametrize(
    ("strokes", "seconds", "words"),
    [
        (1, 0.4, "1 stroke, painted in 0 s"),
        (1234, 59.4, "1,234 strokes, painted in 59 s"),
        (2, 59.6, "2 strokes, painted in 1 min"),
        (2, 3599, "2 strokes, painted in 1 h 00 min"),
        (2, 4380, "2 strokes, painted in 1 h 13 min"),
    ],
)
def test_how_long_it_took_is_told_as_people_do(strokes, seconds, words):
    assert state.made_text(strokes, seconds) == words


def test_what_is_alive_in_another_program_is_not_offered_and_the_newest_comes_first():
    entries = (entry("a", 5.0), entry("b", 9.0), entry("c", 7.0, alive=True), entry("d", 6.0))
    found = state.newest_first(entries, lambda one: one.ident != "d")
    assert [one.ident for one in found] == ["b", "a"]


def test_a_crash_is_told_of_the_painting_of_the_program_that_crashed():
    entries = (entry("a", 1.0, program="7"), entry("b", 2.0, program="8"), entry("c", 3.0, alive=True, program="7"))
    assert state.crashed_among(entries, frozenset({"7", "9"})) == {"a"}
    assert state.crashed_among(entries, frozenset()) == set()


@pytest.fixture
def crashed(tmp_path, monkeypatch):
    """A program whose interpreter has crashed."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    code = "import os, signal, threading\nfrom app.faults.log import LOGGER, open_log, program_ident\nopen_log()\n"
    code += "LOGGER.error('before')\nprint(program_ident(), flush=True)\n"
    code += "threading.Thread(target=os.kill, args=(os.getpid(), signal.SIGSEGV)).start()\nthreading.Event().wait()"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, timeout=90)
    return tmp_path / "inkfall" / "log" / "inkfall.log", done.stdout.decode().strip()


def test_the_program_that_crashed_is_found_in_the_log(crashed):
    log, ident = crashed
    assert crashes.crashed_programs() == {ident}
    with log.open("a") as file:
        file.write(f"2027-01-01 00:00:00,000 INFO MainThread: {program_line('77', 7)}\n")
        file.write("2027-01-01 00:00:00,000 ERROR MainThread: something else\nThread 0x0000000000000007 (waits)\n")
    assert crashes.crashed_programs() == {ident}


def test_programs_that_began_with_a_thread_of_one_number_are_told_apart(tmp_path, monkeypatch):
    """As on Windows, where the numbers of threads are small and come again, and a crash has other words."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    log = tmp_path / "inkfall" / "log" / "inkfall.log"
    log.parent.mkdir(parents=True)
    begins = [f"2027-01-01 00:00:00,000 INFO MainThread: {program_line(ident, 0x1A4C)}" for ident in ("aa", "bb", "cc")]
    crash = "Windows fatal exception: access violation\n\nCurrent thread 0x00001a4c (most recent call first):\n"
    log.write_text("\n".join((begins[0], begins[1], crash, begins[2], "")))
    assert crashes.crashed_programs() == {"bb"}


def test_no_log_no_crash(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    assert crashes.crashed_programs() == frozenset()


class Desk:
    """What the offer needs of the desk."""

    def __init__(self):
        self.recovery, self.asked, self.posted = state.RecoveryState(), Asked(), []
        self.work = self.posted.append


def scene(serial, path):
    return SimpleNamespace(serial=serial, path=path)


def test_what_was_not_saved_of_a_file_is_offered_when_it_is_opened(tmp_path, monkeypatch):
    desk = Desk()
    monkeypatch.chdir(tmp_path)
    recovery_work.offer(desk, scene(0, None))
    recovery_work.offer(desk, scene(1, Path("lake.ora")))
    recovery_work.offer(desk, scene(1, Path("lake.ora")))
    assert desk.posted == [recovery_work.FindCards(tmp_path / "lake.ora")]
    desk.asked.show(recovery_work.CARDS)
    recovery_work.offer(desk, scene(2, tmp_path / "sea.ora"))
    assert len(desk.posted) == 1, "all are listed anyway"


def test_only_cards_of_the_file_that_is_opened_are_shown(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    kept = [
        SimpleNamespace(ident=name, when=1.0, alive=False, program="", path=tmp_path / f"{name}.ora")
        for name in ("lake", "sea")
    ]
    monkeypatch.setattr(entries, "listed", lambda with_bin: tuple(kept))
    for path, names in ((tmp_path / "sea.ora", ["sea"]), (None, ["lake", "sea"]), (tmp_path / "hill.ora", [])):
        desk, work = Desk(), recovery_work.FindCards(path)
        work.arrive(desk, work.carry_out())
        assert [card.ident for card in desk.recovery.cards] == names
        assert desk.asked.dialog == (recovery_work.CARDS if names else "")
