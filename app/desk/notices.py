"""Notices: lines about what went wrong that stay until they are dealt with, or closed by hand."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

OF_A_PAINTING = (
    "save",
    "open",
    "recover",
    "painting",
    "grown",
    "elsewhere",
    "fill",
    "fault",
)  # what notices are about that end with the painting


@dataclass(frozen=True, slots=True)
class Notice:
    """A line that stays.  `offers`: what can be done about it, rows of ACTIONS in app.actions; `about`: of what
    it is, empty for what nothing else deals with; `path`: of which file; `lines`: what more there is to read."""

    text: str
    bad: bool = True
    offers: tuple[str, ...] = ()
    about: str = ""
    path: Path | None = None
    lines: tuple[str, ...] = ()

    @property
    def short(self) -> str:
        """Gives the line with the name of its file in place of the whole path."""
        return self.text if self.path is None else self.text.replace(str(self.path), self.path.name)


@dataclass(slots=True)
class Notices:
    """Those that stay, the newest last.  `chosen`: the one of which something is being done; `serial`: of the
    painting; `seen`: whether the newest is on the screen."""

    rows: tuple[Notice, ...] = ()
    chosen: Notice | None = None
    serial: int = 0
    seen: bool = False

    def add(self, notice: Notice) -> None:
        """Shows a notice, in place of the one about the same."""
        self.settle(notice.about)
        self.rows = (*(row for row in self.rows if row != notice), notice)

    def settle(self, *about: str) -> None:
        """Takes away what is dealt with."""
        self.rows = tuple(row for row in self.rows if not row.about or row.about not in about)

    def about(self, what: str) -> bool:
        """Tells whether one is about something."""
        return any(row.about == what for row in self.rows)

    def shown(self, serial: int) -> None:
        """Takes away what was about the painting before, if this is another one."""
        if serial != self.serial:
            self.serial = serial
            self.settle(*OF_A_PAINTING)

    def close(self, notice: Notice) -> None:
        """Takes one away."""
        self.rows = tuple(row for row in self.rows if row is not notice)

    def offering(self, offer: str) -> Notice | None:
        """Returns the notice of which an offer is meant: the chosen one, or the newest with that offer."""
        if self.chosen is not None and offer in self.chosen.offers:
            return self.chosen
        return next((row for row in reversed(self.rows) if offer in row.offers), None)
