"""One record for every pointing device, and the interface of what delivers them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

LEFT, MIDDLE, RIGHT, BACK, FORWARD = 1, 2, 3, 4, 5
PAD = 100  # and its number: a button beside a tablet
ENDS = "up", "lost"  # kinds that end a stroke, which stays


@dataclass(frozen=True, slots=True)
class PenEvent:
    """One report of a pen or a mouse.

    kind: `move`, `down`, `up`, `wheel`, or `lost`: nothing more comes of what was pressed, as the pen is unplugged or
    another window is in front; where it was last is told.
    `done`, `back`: the keys Enter and Backspace, while something is drawn.  x, y: framebuffer pixels with fractions.
    pressure 0..1 (a mouse: 1 while its button is down).  Tilt in degrees, -90..90; `rotation` of
    the barrel in degrees clockwise, None where the pen does not tell it.  time: seconds of a steady clock.
    button: 1 left or tip, 2 middle, 3 right, 4 back, 5 forward, from 6 on what else there is; those beside a tablet
    begin after PAD.  pad: the wheel is a ring beside a tablet.  touch: a finger.  eraser: the pen is held
    the other way round.  dx, dy: notches of the wheel, up and left positive.
    """

    kind: str
    x: float
    y: float
    pressure: float = 1.0
    tilt_x: float = 0.0
    tilt_y: float = 0.0
    rotation: float | None = None
    time: float = 0.0
    button: int = 0
    eraser: bool = False
    pen: bool = False
    pad: bool = False
    touch: bool = False
    dx: float = 0.0
    dy: float = 0.0


class PointerSource(Protocol):
    """Delivers pointer events in the order in which they happened."""

    name: str

    def events(self) -> list[PenEvent]:
        """Returns what came since the last call."""
        ...

    def close(self) -> None:
        """Stops listening."""
        ...


class PenSource(PointerSource, Protocol):
    """One that hears pens.  `near`: a pen moves the system's mouse too, whose events are not to count."""

    @property
    def near(self) -> bool:
        """Tells whether it does now."""
        ...

    def tablets(self) -> list[str]:
        """Returns the names of the pens that are there, as far as it knows them."""
        ...
