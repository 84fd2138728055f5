"""A file is opened beside the painting, which stays until the new one is whole, and can be painted on."""

import os
import threading
import time

import numpy as np
import pytest
from PIL import Image
from test_easel import BRUSHES, Window, line

from engine.archive.saving import Snapshot, save
from engine.files.fault import Cancelled, FileError
from engine.painting import commands as c
from engine.painting import recording as recordings
from engine.painting.value import Painting
from engine.session.replay import replay
from engine.studio import requests as q
from engine.studio import results
from engine.studio.filing import playing
from engine.studio.filing.document import Document
from engine.studio.filing.documents import opened
from engine.studio.filing.opening_requests import CancelOpening, FileWhole, Show, StopPlaying
from engine.studio.filing.openings import Wanted
from opens import Watch, opens, read

HEADER = '{"inkfall": 1, "frame": [0, 0, 200, 200], "seed": 3}\n'
STROKE = '{"do": "stroke", "points": [[10, 10], [60, 90], [120, 40]], "brush": {"radius": 7}}\n'


def paint(window):
    window.studio.do(q.Begin(0, (0, 0), BRUSHES[0]))
    window.studio.do(q.Points(line(6)))
    window.studio.do(q.Finish())


def of(window, kind):
    return [result for result in window.other if isinstance(result, kind)]


class Slow:
    """A file that comes when it is let, on the real thread of an opening."""

    def __init__(self, window):
        self.window, self.gate, self.ended = window, threading.Event(), threading.Event()
        window.studio.filing.openings.start(Wanted("slow.ora", self._read))

    def _read(self, watch):
        try:
            watch.tell(0.25)
            while not self.gate.wait(0.01):
                watch.check()
            return Document(Painting(seed=77), "slow.ora")
        finally:
            self.ended.set()

    def comes(self):
        self.gate.set()
        return read(self.window.studio, self.window.posted).file


def test_it_takes_the_paintings_place_when_it_is_whole_and_not_before():
    window = Window()
    paint(window)
    slow = Slow(window)
    before = window.studio.easel.session
    number = slow.comes()
    assert of(window, results.Opening)[0] == results.Opening("slow.ora")
    assert of(window, results.Whole) == [results.Whole(number, "slow.ora")]
    assert window.studio.easel.session is before
    window.studio.do(Show(number))  # what was there when it was asked for was asked about then
    assert window.studio.easel.session.painting.seed == 77
    assert of(window, results.Opening)[-1] == results.Opening()
    assert not window.scene().modified


def test_what_was_painted_meanwhile_is_asked_about_and_is_on_the_old_painting():
    window = Window()
    slow = Slow(window)
    number = slow.comes()
    paint(window)  # posted before the window could answer
    before = window.studio.easel.session
    window.studio.do(Show(number))
    assert of(window, results.Whole)[-1] == results.Whole(number, "slow.ora", changed=True)
    assert window.studio.easel.session is before
    assert len(before.log) == 1
    window.studio.do(Show(number, sure=True))
    assert window.studio.easel.session.painting.seed == 77
    assert window.studio.easel.session.log == []


def test_a_stroke_in_hand_is_not_taken_away():
    window = Window()
    slow = Slow(window)
    window.studio.do(q.Begin(0, (0, 0), BRUSHES[0]))
    window.studio.do(q.Points(line(6)))
    window.studio.do(Show(slow.comes()))
    assert of(window, results.Whole)[-1].changed
    window.studio.do(q.Finish())
    assert len(window.studio.easel.session.log) == 1


def test_what_was_painted_meanwhile_and_saved_is_not_asked_about(tmp_path):
    window = Window()
    slow = Slow(window)
    paint(window)
    window.studio.do(q.Save(tmp_path / "a.ora"))
    end = time.monotonic() + 90
    while window.scene().modified:
        assert time.monotonic() < end
        if window.posted:
            window.studio.do(window.posted.popleft())
    window.studio.do(Show(slow.comes()))
    assert window.studio.easel.session.painting.seed == 77


@pytest.mark.parametrize("end", [CancelOpening(), q.New(Painting().frame), "close"])
def test_it_can_be_given_up_at_any_time(end):
    window = Window()
    slow = Slow(window)
    window.studio.close() if end == "close" else window.studio.do(end)
    assert of(window, results.Opening)[-1] == results.Opening()
    assert slow.ended.wait(90)
    painting = window.studio.easel.session.painting
    window.studio.do(Show(1, sure=True))
    assert window.studio.easel.session.painting is painting
    assert not [request for request in window.posted if isinstance(request, FileWhole)]


def test_another_file_takes_the_place_of_one_that_hangs(tmp_path):
    window = Window()
    slow = Slow(window)
    save(tmp_path / "a.ora", Snapshot(Painting(seed=5)))
    opens(window.studio, window.posted, tmp_path / "a.ora")
    assert window.studio.easel.session.painting.seed == 5
    assert slow.ended.wait(90)


@pytest.mark.parametrize("ending", [".ora", ".png", ".jsonl"])
def test_a_pipe_is_refused_and_nobody_waits_for_it(tmp_path, ending):
    path = tmp_path / f"pipe{ending}"
    os.mkfifo(path)
    window = Window()
    paint(window)
    before = window.studio.easel.session
    opens(window.studio, window.posted, path)
    note = of(window, results.Note)[-1]
    assert note.text == f"{path}: not a regular file"
    assert note.stays
    assert note.path == path
    assert of(window, results.Opening)[-1] == results.Opening()
    assert window.studio.easel.session is before


def test_blank_lines_are_bounded(tmp_path):
    path = tmp_path / "blank.jsonl"
    path.write_bytes(b"\n" * (2 * recordings.BLANK_CAP))
    with pytest.raises(FileError, match=f"line {recordings.BLANK_CAP + 1}: found more than 1000000 blank lines"):
        opened(path, False, False, Watch())
    path.write_bytes(HEADER.encode() + b"\n" * recordings.BLANK_CAP + STROKE.encode())
    assert len(opened(path, False, False, Watch()).log) == 1


def large_picture(path):
    Image.fromarray(np.zeros((3000, 3000, 3), np.uint8)).save(path, compress_level=1)


def long_recording(path):
    path.write_text(HEADER + 30_000 * '{"do": "view", "level": 0, "origin": [0, 0], "size": [200, 200]}\n')


@pytest.mark.parametrize(("name", "write"), [("a.png", large_picture), ("a.jsonl", long_recording)])
def test_the_large_is_read_in_pieces_and_is_told_how_far(tmp_path, name, write):
    write(tmp_path / name)
    watch = Watch(most=3)
    with pytest.raises(Cancelled):
        opened(tmp_path / name, False, False, watch)
    assert watch.parts == sorted(watch.parts)
    assert 0.0 < watch.parts[-1] < 0.5


def test_a_recording_is_played_to_its_end_with_its_steps_and_what_failed_is_told(tmp_path):
    view = '{"do": "view", "level": 1, "origin": [5, 6], "size": [200, 200]}\n'
    wrong = '{"do": "layer", "remove": "Nobody"}\n'
    (tmp_path / "r.jsonl").write_text(HEADER + view + STROKE + wrong + STROKE)
    (tmp_path / "good.jsonl").write_text(HEADER + view + STROKE + STROKE)
    window = Window()
    opens(window.studio, window.posted, tmp_path / "r.jsonl")
    session = window.studio.easel.session
    expected = replay(recordings.read(tmp_path / "good.jsonl"))
    assert session.log == expected.log
    assert window.scene().modified
    assert window.scene().path is None
    assert of(window, results.Looked) == [results.Looked(1.0, (5.0, 6.0), (200.0, 200.0))]
    note = of(window, results.Note)[-1]
    assert note.stays
    assert note.text.startswith("r.jsonl: line 4: ")
    window.studio.do(q.Do(c.Undo(2)))
    assert not window.scene().can_undo
    assert session.painting.root.children == Painting().root.children
    window.studio.do(q.Do(c.Redo(2)))
    assert window.scene().can_undo


def test_a_recording_that_plays_tells_how_far_it_is_and_can_be_stopped(tmp_path, monkeypatch):
    monkeypatch.setattr(playing, "PIECE", 1e-9)  # seconds: one thing at a time
    (tmp_path / "r.jsonl").write_text(HEADER + STROKE * 4)
    window = Window()
    studio = window.studio
    for stopped in (False, True):
        window.other.clear()
        opens(studio, window.posted, tmp_path / "r.jsonl", live=True)
        while studio.due is not None:
            studio.play()
            if stopped and len(of(window, results.Played)) == 2:
                studio.do(StopPlaying())
        parts = [told.part for told in of(window, results.Played)]
        assert parts == ([0.0, 0.25, None] if stopped else [0.0, 0.25, 0.5, 0.75, 1.0, None])
        assert len(studio.easel.session.log) == (1 if stopped else 4)
        assert len(studio.easel.session.log[0].points) == 3, "the stroke in hand is drawn to its end"
    studio.do(StopPlaying())  # nothing plays
    assert of(window, results.Note)[-1].text == "The recording was stopped"
