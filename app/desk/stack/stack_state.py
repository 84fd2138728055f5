"""Which layer is seen alone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from engine.studio.requests import Request
from engine.studio.results import LayerRow
from engine.studio.stack.stack_requests import ShowOnly


@dataclass(slots=True)
class StackState:
    """`only`: the name of the layer, group or placement that is seen alone; None while the painting is.  `serial`: of
    the painting that it is of."""

    only: str | None = None
    serial: int = 0

    def toggle(self, post: Callable[[Request], None], name: str) -> None:
        """Shows one alone, or the painting again."""
        self.only = None if self.only == name else name
        post(ShowOnly(self.only))

    def follow(self, post: Callable[[Request], None], rows: tuple[LayerRow, ...], serial: int) -> None:
        """Shows the painting where what is seen alone is gone, or called otherwise, or another painting came."""
        if self.only is not None and (serial != self.serial or not any(row.name == self.only for row in rows)):
            self.toggle(post, self.only)
        self.serial = serial
