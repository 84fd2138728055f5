"""Finding paintings that can be had back, on the files' thread, and having them back."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from app.desk.desk import Desk, FileWork, Message
from app.desk.recovery.recovery_state import crashed_among, newest_first
from app.faults.crashes import crashed_programs
from app.trace import trace
from engine.studio.requests import Recover
from engine.studio.results import Opening, Scene

if TYPE_CHECKING:
    from engine.journal.entries import Entry

CARDS = "unclosed"  # the dialog that shows them
_Found = tuple[tuple["Entry", ...], frozenset[str]]


@dataclass(frozen=True, slots=True)
class FindCards(FileWork):
    """Looks for paintings that were not closed; `path`: only for those of this file."""

    path: Path | None = None

    def carry_out(self) -> _Found:
        """Examines each entry by itself; returns those that can be had back, and which of their programs crashed."""
        from engine.journal.entries import listed  # here: the window is up before the engine is loaded

        entries = listed(with_bin=False)
        return newest_first(entries, self._wanted), crashed_among(entries, crashed_programs())

    def _wanted(self, entry: Entry) -> bool:
        return self.path in (None, entry.path)

    def arrive(self, desk: Desk, found: _Found) -> None:
        """Shows the cards, if there are any."""
        desk.recovery.cards, desk.recovery.crashed = found
        trace(f"cards: {len(desk.recovery.cards)}")
        if desk.recovery.cards:
            desk.asked.show(CARDS)


@dataclass(frozen=True, slots=True)
class ListBin(FileWork):
    """Finds what lies in the bin."""

    def carry_out(self) -> tuple[Entry, ...]:
        """Returns it, the newest first."""
        from engine.journal.entries import listed  # here: the window is up before the engine is loaded

        return newest_first(listed(), lambda entry: entry.in_bin)

    def arrive(self, desk: Desk, found: tuple[Entry, ...]) -> None:
        """Hands it on."""
        desk.recovery.bin = found


@dataclass(frozen=True, slots=True)
class Discard(FileWork):
    """Puts a painting into the bin; one that is in it is deleted."""

    entry: Entry

    def carry_out(self) -> None:
        """Does it; OSError where that cannot be."""
        from engine.journal.entries import discard  # here: the window is up before the engine is loaded

        discard(self.entry)

    def arrive(self, desk: Desk, found: None) -> None:
        """Shows nothing: the card is gone."""


def offer(desk: Desk, scene: Scene) -> None:
    """Looks for what was painted on a file and not saved, once it is opened; not while all are listed anyway."""
    state = desk.recovery
    if scene.serial == state.serial:
        return
    state.serial = scene.serial
    if scene.path is not None and CARDS not in (desk.asked.dialog, desk.asked.shown):
        desk.work(FindCards(Path(os.path.abspath(scene.path))))


def recover(desk: Desk, entry: Entry) -> None:
    """Has a painting back, as an untitled one, which the status line tells until it is there; the one that is open is
    asked about first, unless the engine still loads: then there is hardly any, and what there is goes into the bin."""

    def begin() -> None:
        desk.learn(opening=Opening(entry.name))
        desk.message = Message()
        desk.post(Recover(entry.folder, entry.name))

    if desk.known.ready:
        desk.guard(begin)
    else:
        begin()
