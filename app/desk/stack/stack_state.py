"""Which layer is seen alone, and which are chosen together."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from engine.studio.requests import Request
from engine.studio.results import LayerRow
from engine.studio.stack.stack_requests import ShowOnly


@dataclass(slots=True)
class StackState:
    """`only`: the name of the layer, group or placement that is seen alone; None while the painting is.  `serial`: of
    the painting that it is of; `many`: names of those chosen together, of which one is active, empty where that is
    chosen alone; `together`: a number for what is to be undone as one; `colours`: of rows, by the names
    of their layers, rows of ROW_COLOURS; `coloured`: the serial and the file of the painting that they are of;
    `given`: names of layers that were asked for, until they are there."""

    only: str | None = None
    serial: int = 0
    many: set[str] = field(default_factory=set)
    together: int = 0
    colours: dict[str, str] = field(default_factory=dict)
    coloured: tuple[int, str | None] = (-1, None)
    given: set[str] = field(default_factory=set)

    def toggle(self, post: Callable[[Request], None], name: str) -> None:
        """Shows one alone, or the painting again."""
        self.only = None if self.only == name else name
        post(ShowOnly(self.only))

    def follow(
        self, post: Callable[[Request], None], rows: tuple[LayerRow, ...], serial: int, active: str | None = None
    ) -> None:
        """Shows the painting where what is seen alone is gone, or called otherwise, or another painting came; only
        the active layer is chosen from then on where it is none of those that were."""
        self.many &= {row.name for row in rows}
        if serial != self.serial or active not in self.many or len(self.many) < 2:
            self.many = set()
        if self.only is not None and (serial != self.serial or not any(row.name == self.only for row in rows)):
            self.toggle(post, self.only)
        self.serial = serial
