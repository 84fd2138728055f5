"""What the window knows of guides besides those of the painting."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from app.canvas.view import Place
from engine.painting.guiding.guides import Guide
from engine.studio.results import Scene


class Held(NamedTuple):
    """A guide as it is while it is moved, in the painting of a serial number, until that has it."""

    guide: Guide
    serial: int


class Own(NamedTuple):
    """The symmetry as the hand has it, in the painting of a serial number; `kept`: while its steps were taken back or
    done again."""

    guide: Guide
    serial: int
    kept: bool = False


@dataclass(slots=True)
class GuideState:
    """`held`: the guide in hand; `path`: the shape in hand, on the screen; `bar`: the handles of its last knot; `last`:
    where the last stroke ended; `seams`: the textures that were said not to fit a tile; `shown`: whether guides are
    drawn; `snaps`: whether strokes are drawn onto them; `chosen`: the name of the one whose numbers are shown; `own`:
    the symmetry as the hand has it, which undo and redo leave as it is, whatever the painting's is by then."""

    own: Own | None = None
    held: Held | None = None
    path: tuple[tuple[float, float], ...] = ()
    bar: tuple[tuple[float, float], ...] = ()
    last: Place | None = None
    seams: tuple[str, ...] = ()
    shown: bool = True
    snaps: bool = True
    chosen: str = ""

    def kept_in(self, scene: Scene | None) -> Guide | None:
        """Returns the symmetry as the hand has it in a painting, where steps taken back may have set another."""
        own = self.own
        return own.guide if own is not None and own.kept and scene is not None and own.serial == scene.serial else None
