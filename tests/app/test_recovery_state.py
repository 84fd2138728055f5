"""What is on the cards of paintings that can be had back."""

import os
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
from engine.journal import entries

ROOT = Path(__file__).parents[2]
NOON = time.mktime((2026, 3, 2, 12, 0, 0, 0, 0, -1))


def entry(ident, when, alive=False):
    return SimpleNamespace(ident=ident, when=when, alive=alive)


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


def test_a_crash_is_told_of_the_painting_that_was_painted_on_last_before_it():
    entries = (entry("a", 100.0), entry("b", 200.0), entry("c", 300.0), entry("d", 199.0, alive=True))
    assert state.crashed_among(entries, (150.0, 250.0)) == {"a", "b"}
    assert state.crashed_among(entries, (50.0,)) == set()


@pytest.fixture
def crashed(tmp_path, monkeypatch):
    """A program whose interpreter has crashed."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    code = "import os, signal\nfrom app.faults.log import LOGGER, open_log\nopen_log()\nLOGGER.error('before')\n"
    code += "os.kill(os.getpid(), signal.SIGSEGV)"
    subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, timeout=60)
    return tmp_path / "inkfall" / "log" / "inkfall.log"


def test_when_the_interpreter_crashed_is_found_and_noted_once(crashed):
    now = time.time()
    os.utime(crashed, (now - 500, now - 500))
    noted = run_crashes()
    assert noted == pytest.approx([now - 500], abs=1.0)
    with crashed.open("a") as file:
        file.write("2027-01-01 00:00:00,000 ERROR MainThread: something else\n")
    assert run_crashes() == pytest.approx(noted, abs=1.0)
    assert crashed.read_text().count("interpreter crashed") == 1


def test_a_crash_with_faults_after_it_was_before_them(crashed):
    with crashed.open("a") as file:
        file.write("2026-01-01 00:00:00,000 ERROR MainThread: something else\n")
    assert run_crashes() == [time.mktime((2026, 1, 1, 0, 0, 0, 0, 0, -1))]


def test_no_log_no_crash(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    assert crashes.crashes() == ()


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
        SimpleNamespace(ident=name, when=1.0, alive=False, path=tmp_path / f"{name}.ora") for name in ("lake", "sea")
    ]
    monkeypatch.setattr(entries, "listed", lambda with_bin: tuple(kept))
    for path, names in ((tmp_path / "sea.ora", ["sea"]), (None, ["lake", "sea"]), (tmp_path / "hill.ora", [])):
        desk, work = Desk(), recovery_work.FindCards(path)
        work.arrive(desk, work.carry_out())
        assert [card.ident for card in desk.recovery.cards] == names
        assert desk.asked.dialog == (recovery_work.CARDS if names else "")


def run_crashes():
    """What a program that starts finds, with its log open."""
    code = "from app.faults.log import open_log\nopen_log()\nfrom app.faults.crashes import crashes\nprint(*crashes())"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, timeout=60, check=True
    )
    return [float(word) for word in done.stdout.split()]
