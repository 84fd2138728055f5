"""The record of what a desk keeps between sessions."""

from __future__ import annotations

from dataclasses import dataclass

from app.desk.holding.wheel_record import WheelSet

MOST_FAVOURITES = 9  # as many as there are digits to press


@dataclass(frozen=True, slots=True)
class KeptDesk:
    """`favourites`: names of brushes, in the order of their keys; `colours`: those painted with, #rrggbb, the last one
    first; `palette`: the name of the one that is shown; `wheel`: how the wheel is set."""

    favourites: tuple[str, ...] = ("Pencil", "Ink pen", "Gouache", "Soft airbrush", "Eraser")
    colours: tuple[str, ...] = ()
    palette: str = ""
    wheel: WheelSet = WheelSet()  # noqa: RUF009  # it never changes
