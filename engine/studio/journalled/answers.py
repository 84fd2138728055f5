"""What the engine tells the journal: what became of what was asked for, and what was done without being asked.

The journal hears of a command before any result that shows it is sent.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from engine.brush.checks import thawed
from engine.checks.owned import Owned
from engine.journal.entries import change_about
from engine.journal.records import Kind, told_command, told_object
from engine.journal.story import COMMAND, STROKE
from engine.journal.volume import Continued, End, Volume
from engine.kernel_cache import NotCompiled
from engine.painting import commands as c
from engine.painting.recording import Recording
from engine.strokes.example_stroke import Live
from engine.studio import requests as q
from engine.studio.easel import Easel
from engine.studio.journalled.anew import Anew, Begun, Past
from engine.studio.journalled.beside import Beside
from engine.studio.journalled.posts import Posts

_CARRIED_OUT = (q.Begin, q.Points, q.Finish, q.Do)


class Answers(Owned):
    """It belongs to the engine's thread.  `making`: how the painting was made, None if nobody knows."""

    def __init__(self, easel: Easel, posts: Posts) -> None:
        self._easel, self._posts, self._journal = easel, posts, posts.journal
        self._stroke: int | None = None  # the one on the easel
        self._command: int | None = None  # the one that is being carried out
        self._parted = False  # whether points of the stroke were refused
        self._count = 0  # of the commands that the journal has of this painting
        self._beside = Beside(self._journal, lambda: posts.is_compiling(), lambda: posts.wake())
        easel.aside.append(self._beside.roots)
        self._anew = Anew(self._beside.do, lambda: posts.wake())
        self.making: Callable[[], Recording | None] = lambda: None
        easel.session.heard = self._heard
        posts.is_modified = lambda: easel.modified

    def carry_out(self, request: q.Request, handle: Callable[[q.Request], None]) -> None:
        """Has a request handled, and tells what became of it."""
        number = self._posts.number(request) if isinstance(request, q.Begin | q.Do) else None
        self._command = number if isinstance(request, q.Do) else None
        try:
            with self.timed() if isinstance(request, _CARRIED_OUT) else _untimed():
                handle(request)
        except NotCompiled:
            raise  # it is tried again
        except Exception:
            self._parted = self._parted or isinstance(request, q.Points)
            self._settle(request, number)
            raise
        else:
            self._settle(request, number)
        finally:
            self._command = None
        self.rest()

    def rest(self) -> None:
        """Begins the journal anew if that is lost, and has written what is due beside it, unless a stroke is in
        progress, of which nothing can be told twice."""
        if self._easel.live is not None:
            return
        lost = self._journal.entry
        if lost.lost and (begun := self._anew.begun(lost, self._past)) is not None:
            self._go_on(begun)
        self._beside.rest(self._easel.session.painting, self._count)

    @property
    def due(self) -> float | None:
        """When there is something to rest for, by the monotonic clock; None if nothing is known of."""
        return None if self._easel.live is not None else self._beside.due

    @contextmanager
    def timed(self) -> Iterator[None]:
        """What is done within is to be done again by a recovery."""
        start = time.monotonic()
        try:
            yield
        finally:
            self._beside.spent += time.monotonic() - start

    def turn(self, head: Mapping[str, object], continued: Continued | None = None, count: int = 0) -> None:
        """Another painting comes on the easel, which has so many commands already; what is there, the artist knew of
        when he asked for another."""
        self._beside.leave(self._easel.session.painting)
        self._anew.drop()
        self._count = count
        self._journal.turn(head, End.BIN if self._easel.modified else End.DELETED, continued)
        self._beside.turn(head)

    def secure(self) -> None:
        """Begins the journal anew at once, if it is lost: nobody will do so later."""
        entry = self._journal.entry
        if entry.is_whole:
            return
        if self._easel.live is not None:  # of a stroke in progress nothing can be told twice
            self._easel.finish()
        begun = self._anew.begun_now(entry, self._past)
        if begun is not None:
            self._go_on(begun)

    def close(self) -> None:
        """The painting is closed as it is."""
        self.secure()
        self._beside.leave(self._easel.session.painting)
        self._beside.close()

    def replaces(self, path: Path) -> Callable[[], None]:
        """A file is going to be written; returns what waits, on any thread, until the journal can do without the one
        that is there."""
        return self._beside.replaces(path)

    def mark(self) -> Callable[[Path], None]:
        """Returns what tells that the painting as it is now has been written to a file."""
        count, entry = self._count, self._journal.entry

        def saved(path: Path) -> None:
            told = {"path": os.path.abspath(path), "commands": count}
            self._journal.note(Kind.SAVED, told_object(told), entry)
            self._beside.do(partial(_rename, entry, path))

        return saved

    def _past(self) -> Past:
        easel, session, made = self._easel, self._easel.session, self.making()
        name = str(self._journal.entry.head.get("name") or "") if easel.path is None else easel.path.name
        header, textures = session.recording().header, tuple(session.painting.textures.values())
        base = session.base if made is None else None
        return Past(easel.path, name, header, session.folder, base, session.log.now(), textures, easel.modified)

    def _go_on(self, begun: Begun) -> None:
        """The same painting goes on in an entry that was begun anew."""
        log = self._easel.session.log
        self._count = len(log)
        self._journal.turn(begun.head, End.DELETED, begun.until(log))
        if self._easel.path is not None and not self._easel.modified:
            self.mark()(self._easel.path)
        self._beside.again()

    def _settle(self, request: q.Request, number: int | None) -> None:
        """Tells of what is over, and was not carried out, that it was refused."""
        live, before = self._easel.live, self._stroke
        if isinstance(request, q.Begin) and live is not None and live.asked is None:
            live.asked, self._parted = number, False
        self._stroke = None if live is None else live.asked
        if isinstance(request, q.Abandon):  # told by who posted it, or only put off
            return
        for one in {number, before} - {None, self._stroke}:
            assert one is not None
            self._journal.answer(one, Kind.REFUSED)
            self._posts.settle(one)

    def _heard(self, command: c.Command, live: Live | None) -> None:
        """A command was carried out; `live`: as a stroke that grew on the easel."""
        self._count += 1
        self._beside.changed()
        if isinstance(command, c.DefineTexture):
            self._beside.keep(self._easel.session.painting.textures[command.name])
        number = self._command if live is None else live.asked
        last = live is None or not live.full
        if live is None:
            self._command = None
        if number is not None:
            told = COMMAND + told_command(command) if live is None or self._parted else _told_stroke(command, last)
            if self._journal.answer(number, Kind.DONE, told, last):
                return
        self._journal.note(Kind.DID, told_command(command))


@contextmanager
def _untimed() -> Iterator[None]:
    yield


def _rename(entry: Volume, path: Path) -> None:
    """Tells in a list that a painting has this file."""
    if entry.folder is not None and entry.end is None:
        change_about(entry.folder, name=path.name, path=os.path.abspath(path))


def _told_stroke(stroke: c.Command, last: bool) -> bytes:
    """Returns what a stroke is besides what was asked for."""
    assert isinstance(stroke, c.Stroke)
    about = {"count": len(stroke.points), "last": last, "layer": stroke.layer, "seed": stroke.seed}
    return STROKE + told_object({**about, "extra": thawed(stroke.extra)})
