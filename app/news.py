"""What the engine tells, and the thread for files: each result becomes known, and goes to those who hear it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from app.desk import flight
from app.desk.desk import Desk, Hear, Message
from app.desk.files import Done
from app.desk.holding.kept_desk import keep_colours
from app.desk.holding.palette_making import TO_PALETTE, palette_of_copied
from app.desk.holding.picking_up import take_ink
from app.desk.known import Known, known_after
from app.desk.moving import independence
from app.desk.outside import clipboard
from app.desk.outside.arriving import welcome_arrived
from app.desk.outside.noting_opened import follow_opened
from app.desk.recovery import recovery_work
from app.desk.stack.row_colours import follow_rows
from app.faults.fault_guard import FaultGuard
from app.trace import trace
from engine.studio import results
from engine.studio.adjusting.trial_records import Tried
from engine.studio.copy_records import Copied
from engine.studio.moving.move_requests import BakeTold, Extent, PaintedTold
from engine.studio.moving.sheet_records import CarriedSheets, Shown
from engine.studio.past.past_records import Here
from engine.studio.results import Result

Hearers = Callable[[type], Sequence[Hear]]  # those who hear results of a type
Source = Callable[[], Sequence[Result | Done]]


def _note(desk: Desk, note: results.Note, _now: float) -> None:
    desk.told(note)


def _saved(desk: Desk, saved: results.Saved, _now: float) -> None:
    desk.notices.settle("save", "elsewhere")
    desk.say(saved.told or f"Saved {Path(saved.path).name}", bad=bool(saved.told))
    path = Path(saved.path).absolute()
    desk.opened.saves[path] = desk.opened.saves.get(path, 0) + 1
    desk.asked.saved()


def _overtaken(desk: Desk, told: results.Overtaken, _now: float) -> None:
    desk.asked.about_overtaken(told)


def _filmed(desk: Desk, told: results.Filming, _now: float) -> None:
    if told.part is None:
        desk.asked.filmed()
    elif told.part == 0.0:  # another one: what is told of the one before is dealt with
        desk.notices.settle("film")


def _scene(desk: Desk, scene: results.Scene, _now: float) -> None:
    desk.notices.shown(scene.serial)
    if desk.message.of not in (None, desk.known.active):
        desk.message = Message()
    desk.masks.follow(desk.post, desk.known.active)
    desk.stack.follow(desk.post, scene.layers, scene.serial, scene.active)
    follow_rows(desk)
    recovery_work.offer(desk, scene)
    follow_opened(desk)
    keep_colours(desk)
    welcome_arrived(desk)


def _done(desk: Desk, done: Done, _now: float) -> None:
    done.arrive(desk)


def _picked(desk: Desk, picked: results.Picked, _now: float) -> None:
    if picked.alpha > 0.01:
        desk.hand.colour = picked.rgb


def _copied(desk: Desk, told: Copied, now: float) -> None:
    if told.about == TO_PALETTE:
        palette_of_copied(desk, told)
    else:
        clipboard.give_away(desk, told, now)


HEARS: dict[type, Hear] = {
    Done: _done,
    results.Note: _note,
    results.Saved: _saved,
    results.Filming: _filmed,
    results.Scene: _scene,
    results.Overtaken: _overtaken,
    results.Picked: _picked,
    Here: take_ink,
    Copied: _copied,
    results.Looked: flight.fly,
    Tried: lambda desk, tried, now: setattr(desk.adjusting, "best", tried),
    Extent: lambda desk, extent, now: desk.moving.told(extent),
    BakeTold: independence.ask,
    PaintedTold: lambda desk, told, now: setattr(desk.export, "painted", told.rect),
    CarriedSheets: lambda desk, sheets, now: desk.moving.sheets.come(sheets),
    Shown: lambda desk, shown, now: desk.moving.sheets.shown(shown),
    results.Whole: lambda desk, whole, now: desk.show(whole),
}


class News:
    """Brings results to the desk itself, as HEARS has it, and to `hearers`; none keeps the next from it by a fault."""

    def __init__(self, desk: Desk, guard: FaultGuard, *hearers: Hearers) -> None:
        self._desk, self._guard, self._hearers = desk, guard, hearers
        self._sources: list[Source] = []

    def connect(self, source: Source) -> None:
        """From now on takes the results that a source gives, too."""
        self._sources.append(source)

    def take(self, now: float) -> bool:
        """Takes in all results; True if there were any."""
        return self.take_from(self._sources, now)

    def take_from(self, sources: Sequence[Source], now: float) -> bool:
        """Takes in what some sources have; True if that was anything."""
        came = [result for source in sources for result in source()]
        for result in came:
            with self._guard.spare("on a result"):
                self._hear(result, now)
        return bool(came)

    def _hear(self, result: Result | Done, now: float) -> None:
        before = self._desk.known
        self._desk.known = known_after(before, result, now)
        for hear in self._who(type(result)):
            hear(self._desk, result, now)
        _trace(before, self._desk.known)

    def _who(self, kind: type) -> list[Hear]:
        own = [HEARS[kind]] if kind in HEARS else []
        return own + [hear for hearers in self._hearers for hear in hearers(kind)]


def _trace(before: Known, after: Known) -> None:
    """Tells those who measure what is there from now on: the engine and its brushes, examples, what has grown."""
    if after.ready and after.presets and not (before.ready and before.presets):
        trace("engine ready")
    if before.preparing is not None and after.preparing is None:
        trace("examples ready")
    if after.prepared != before.prepared and after.prepared.ready == after.prepared.of:
        trace("all brushes ready")
    if (before.growing is None) != (after.growing is None):
        trace("all has grown" if after.growing is None else "something grows")
    if after.writing != before.writing:
        trace(f"{after.writing.files} files are being written{', its own too' * after.writing.saving}")
