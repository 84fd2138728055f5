"""What went wrong stays: until it is dealt with, until the painting is another one, or until it is closed by hand."""

import errno
from dataclasses import replace

import pytest

from app.actions.actions import ACTIONS, perform
from app.canvas.view import Place, View
from app.desk.desk import Desk
from app.desk.notices import Notice, Notices
from app.desk.offers import CopyDetails, ShowRoom
from app.faults.fault_guard import FaultGuard
from app.input.events import PenEvent
from app.news import News
from app.tools.painting_gestures import begin_stroke
from engine.canvas.placing.pose import Pose
from engine.files.atomic import replacing
from engine.files.fault import FileError
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.select_commands import Select, Whole
from engine.session.session import Session
from engine.studio import faults, results
from engine.studio import requests as q
from engine.studio.outline import rows

SCENE = results.Scene(Rect(0, 0, 64, 48), (), None, False, False, modified=False, path=None)


class Screen:
    """A desk, what it posts, and the news that come to it."""

    def __init__(self):
        self.posted, self.worked, self.came = [], [], []
        self.desk = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), self.posted.append)
        self.desk.work = self.worked.append
        self._news = News(self.desk, FaultGuard(lambda: None), lambda kind: [])
        self._news.connect(lambda: [self.came.pop(0) for _ in list(self.came)])

    def hear(self, *told):
        self.came += told
        self._news.take(1.0)
        return [notice.text for notice in self.desk.notices.rows]


@pytest.fixture
def screen():
    made = Screen()
    made.hear(results.Ready(), SCENE)
    return made


def test_a_refusal_that_is_no_matter_of_files_is_told_for_some_seconds(screen):
    assert screen.hear(faults.told(FileError("a.png", "no picture"), "")) == []
    assert screen.desk.message.text == "a.png: no picture"


def test_the_window_that_is_closed_waits_for_a_film_unless_that_fails(screen):
    screen.hear(results.Filming(0.5))
    perform(screen.desk, ACTIONS["quit"])
    assert (screen.desk.asked.quit, screen.desk.asked.taken()) == (False, "filming")
    screen.desk.asked.after_film = screen.desk.asked.close
    screen.hear(faults.told(FileError("a.mp4", "no room"), "", "film"), results.Filming())
    assert not screen.desk.asked.quit  # what went wrong is to be seen
    assert screen.hear(results.Filming(0.0)) == []  # another film: that is dealt with
    screen.desk.asked.after_film = screen.desk.asked.close
    screen.hear(results.Note("Wrote a.mp4", about="film"), results.Filming())
    assert screen.desk.asked.quit


@pytest.mark.parametrize("about", sorted(faults.OFFERS))
def test_what_stays_offers_what_can_be_done(screen, about):
    assert set(faults.OFFERS[about] + faults.NO_ROOM + faults.LOGGED) <= set(ACTIONS)
    assert screen.hear(faults.told(FileError("a.ora", "cannot be"), "", about)) == ["a.ora: cannot be"]
    assert perform(screen.desk, ACTIONS["try_again"])
    assert screen.desk.notices.rows == ()
    assert [request.path.name for request in screen.posted] == ["a.ora"]
    assert isinstance(screen.posted[0], {"save": q.Save, "export": q.Export, "open": q.Open}[about])
    assert not perform(screen.desk, ACTIONS["try_again"])


def test_what_is_dealt_with_goes_and_nothing_else_does(screen, tmp_path):
    save, export = (faults.told(FileError("a.ora", "cannot be"), "", about) for about in ("save", "export"))
    assert len(screen.hear(save, save, export)) == 2
    assert len(screen.hear(results.Note("Wrote b.png"))) == 2
    assert screen.hear(results.Note("Wrote b.png", about="export")) == ["a.ora: cannot be"]
    assert screen.hear(SCENE) == ["a.ora: cannot be"]
    assert screen.hear(results.Saved(tmp_path / "a.ora")) == []


def test_another_painting_ends_what_was_about_the_one_before(screen):
    fault = results.Note("A fault", bad=True, fault=True, stays=True, about="fault")
    lost = results.Note("a.ora: 2 things", bad=True, stays=True, about="painting", lines=("a", "b"))
    refused = faults.told(FileError("b.ora", "none"), "", "open")
    assert len(screen.hear(lost, refused, fault)) == 3
    told = screen.hear(results.Scene(Rect(0, 0, 8, 8), (), None, False, False, False, None, serial=1), lost)
    assert [text.partition(":")[0] for text in told] == ["a.ora"]


def test_a_full_disk_is_told_as_one_whatever_the_error_is_made_of(tmp_path):
    def full():
        with replacing(tmp_path / "a.ora"):
            raise OSError(errno.ENOSPC, "No space left on device")

    with pytest.raises(FileError) as raised:
        full()
    assert faults.told(raised.value, "", "save").offers == ("try_again", "save_as", "free_space")
    assert faults.told(FileError("a.ora", "read-only"), "", "save").offers == ("try_again", "save_as")


def test_an_offer_is_done_to_the_notice_that_was_chosen():
    one, other = (Notice(name, offers=("try_again",), about="open") for name in "ab")
    notices = Notices((one, other))
    assert notices.offering("try_again") is other
    notices.chosen = one
    assert notices.offering("try_again") is one
    assert notices.offering("free_space") is None
    notices.close(other)
    assert notices.rows == (one,)


def test_a_notice_names_its_file_without_the_way_there(tmp_path):
    notice = Notice(f"{tmp_path / 'a.ora'}: no layers", path=tmp_path / "a.ora")
    assert notice.short == "a.ora: no layers"


def test_the_room_on_a_disk_is_found_for_a_file_that_is_not_there(screen, tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))  # no file manager
    folder, free = ShowRoom(tmp_path / "missing" / "a.ora").carry_out()
    assert folder == tmp_path
    assert free > 0
    ShowRoom(tmp_path).arrive(screen.desk, (folder, 3 << 20))
    assert screen.desk.message.text == f"3.1 MB free in {tmp_path}"


def test_details_tell_versions_system_graphics_and_the_end_of_the_log(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    assert CopyDetails("card").carry_out().endswith("\n\nThere is no log")
    log = tmp_path / "inkfall" / "log" / "inkfall.log"
    log.parent.mkdir(parents=True)
    log.write_text("".join(f"line {n}\n" for n in range(3000)) + "KeyError: 'missing key'\n")
    told = CopyDetails("a card, 4.5").carry_out()
    assert told.startswith("Inkfall ")
    assert "OpenGL a card, 4.5\n" in told
    assert told.endswith("\nline 2999\nKeyError: 'missing key'")
    assert 8000 < len(told) < 9000
    assert all(line in log.read_text().splitlines() for line in told.partition("\n\n")[2].splitlines())


def test_why_nothing_can_be_painted_on_a_layer_is_told_while_it_is_so(screen):
    session = Session()
    session.do(c.AddLayer("Leaves"))

    def hear():
        screen.hear(replace(SCENE, layers=tuple(rows(session.painting.root)), active=session.painting.active))

    session.do(c.parse({"do": "layer", "set": "Leaves", "locked": True}))
    hear()
    assert begin_stroke(screen.desk, PenEvent("down", 5.0, 5.0)) is None
    hear()
    assert screen.desk.message.text == "Layer “Leaves” is locked"
    session.do(c.parse({"do": "undo"}))
    hear()
    assert screen.desk.message.text == ""


@pytest.mark.parametrize(("at", "seen"), [([40, 8], Pose((5, 1), -3)), ([0, 0], None)])
def test_within_a_selection_what_lies_elsewhere_is_painted_on_as_it_is_seen(screen, at, seen):
    session = Session()
    session.do(c.AddLayer("Leaves"))
    session.do(c.parse({"do": "layer", "add": "Copy", "kind": "placement", "of": "Leaves", "at": at}))
    screen.hear(replace(SCENE, layers=tuple(rows(session.painting.root)), active="Copy"))
    for selected in (False, True):
        if selected:
            screen.desk.selecting.choose(screen.desk.post, Select(Whole("all")))
        assert begin_stroke(screen.desk, PenEvent("down", 5.0, 5.0)) is not None
        begun = [one for one in screen.posted if isinstance(one, q.Begin)][-1]
        assert (begun.layer, begun.seen) == ("Leaves", seen if selected else None)
