"""A power cut at any moment loses no stroke that is older than a second: every state of the disk that it may leave is
made, from the operations that the real program did, and recovered."""

import random
import threading
import time

import pytest
from recorded_disk import Disk, Recorder
from test_answers import draw, idle
from test_recovering import painter

from engine.journal import entries
from engine.journal.story import read_story
from engine.journal.writing import SYNC_DOWN, SYNC_UP
from engine.painting import commands as c
from engine.studio.filing.recovering import recovered

STROKES = 10
OLD = 1.0  # seconds, beside those in which the machine stood still and those that a sync took
TOGETHER = 2.0  # seconds within which several of those may meet one stroke


class Lateness:
    """When a thread had its turn while others worked, and how many seconds late."""

    def __init__(self) -> None:
        self.turns, self._ended = [], threading.Event()
        self._thread = threading.Thread(target=self._watch, daemon=True)
        self._thread.start()

    def _watch(self) -> None:
        begun = time.monotonic()
        while not self._ended.wait(0.01):
            now = time.monotonic()
            self.turns.append((now, now - begun - 0.01))
            begun = time.monotonic()

    def end(self) -> list[tuple[float, float]]:
        self._ended.set()
        self._thread.join()
        return self.turns


def most(moments):
    """The most seconds that came together, of moments in order, each with how many it cost."""
    return max((sum(cost for at, cost in moments if 0.0 <= when - at <= TOGETHER) for when, _ in moments), default=0.0)


def painted(folder, monkeypatch):
    """The operations of a program that paints with checkpoints after every stroke, when each pen-up was told, and from
    which age a stroke is kept here: a machine that stands still does so for all threads."""
    lateness = Lateness()
    recorder = Recorder(folder, monkeypatch)
    monkeypatch.setattr("engine.studio.preparing.processes.Preparing.busy", False)
    for name in ("LIMIT", "PAUSE_FACTOR", "PICTURE_PAUSE"):
        monkeypatch.setattr(f"engine.studio.journalled.beside.{name}", 1e-9)
    worker = painter(folder / "p")
    ups = []
    draw(worker, 4, 0)
    ups.append(time.monotonic())
    idle(worker)
    for n in range(1, STROKES):
        draw(worker, 20, n)
        ups.append(time.monotonic())
        end = time.monotonic() + 0.3
        while time.monotonic() < end:
            worker.results()
            time.sleep(0.01)
    idle(worker)
    worker.close(60, by_choice=False)
    return recorder.operations, ups, OLD + most(recorder.syncs) + most(lateness.end())


def cut(folder, operations, ups, old, told, most):
    """Tries so many states after each operation, at most; how many were tried, and how many were opened."""
    disk, tried, looked = Disk(folder / "then"), 0, 0
    for one in operations:
        disk.take(one)
        needed = sum(up < one.when - old for up in ups)
        for number, state in enumerate(disk.states(told, most)):
            place = folder / f"now{tried}"
            for name, data in state.items():
                (place / name).parent.mkdir(parents=True, exist_ok=True)
                (place / name).write_bytes(data)
            found = entries.listed(place / "p")
            assert found or not needed, (tried, one)
            for entry in found:
                story = read_story(entry.folder)
                held = sum(isinstance(command, c.Stroke) for command in story.commands)
                held += sum(asked.finished for asked in story.asked.values())
                assert held >= needed, (tried, one, story.faults)
                if story.head and ((one.what == "move" and number == 0) or (number == 0 and tried % 40 == 0)):
                    again = recovered(entry.folder)
                    assert len(again.session.log) >= needed
                    looked += 1
            tried += 1
    return tried, looked


def test_no_state_lacks_a_stroke_older_than_a_second(tmp_path, monkeypatch):
    assert max(SYNC_UP, 0.5) == 0.5
    assert SYNC_DOWN <= 1.0
    (tmp_path / "then").mkdir()
    with monkeypatch.context() as patched:
        operations, ups, old = painted(tmp_path / "then", patched)
    assert len(ups) == STROKES
    assert ups[-1] - ups[0] > 2 * OLD
    assert {one.what for one in operations} >= {"write", "sync", "sync names", "move", "make", "mkdir"}
    tried, looked = cut(tmp_path, operations, ups, old, random.Random(5), 2)
    print(len(operations), tried, looked)
    assert tried > len(operations)
    assert looked > 3


@pytest.mark.nightly
def test_many_states_lack_none(tmp_path, monkeypatch):
    (tmp_path / "then").mkdir()
    with monkeypatch.context() as patched:
        operations, ups, old = painted(tmp_path / "then", patched)
    tried, looked = cut(tmp_path, operations, ups, old, random.Random(6), 60)
    print(len(operations), tried, looked)
    assert tried > 10 * len(operations)
