"""How the tools Fill, Wand and Gradient are set, and what was asked to be filled last."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

from app.canvas.view import View
from engine.numeric.address import Rect
from engine.painting.commands import DefineTexture
from engine.painting.fill_command import LOOKED_AT_CAP, Fill, Like
from engine.studio.adjusting.trial_records import TryFill

WIDEST_SHOWN = 64.0  # px of the screen that the panel offers


@dataclass(slots=True)
class FillState:
    """`tolerance`: 0..1; `gap`: px of the screen; `seen`: all that is seen is looked at, not the layer alone;
    `grown`: px of the screen by which the wand goes under the soft rim of what it finds; `fill_grown`: by which a
    fill does; `last`: what was asked for last. Of what is gone round `boxed`: by a rectangle; `regions`: which of it,
    as `Like` has them. Of gradients `shape`: its kind; `fades`: to nothing, not to the other colour; `gradient`: the
    one laid last; `tried`: the one that is seen while it is dragged; `named`: the names of those that were asked
    for."""

    tolerance: float = 0.12
    gap: float = 0.0
    seen: bool = True
    grown: float = 1.0
    fill_grown: float = 0.0
    contiguous: bool = True
    last: Fill | None = None
    boxed: bool = False
    regions: str = "alike"
    shape: str = "linear"
    fades: bool = False
    gradient: DefineTexture | None = None
    tried: TryFill | None = None
    named: set[str] = field(default_factory=set)


def looked_at(view: View, level: int) -> Rect:
    """Returns the pixels of a level in which the region of a place on the screen is looked for: what is seen, and half
    as much again on each side, as far as that is not too much."""
    seen = view.visible(level)
    most = LOOKED_AT_CAP // max(1, seen.area)
    across, down = (min(side // 2, side * max(0, min(3, most - 1)) // 8) for side in (seen.width, seen.height))
    wide = Rect(seen.x0 - across, seen.y0 - down, seen.x1 + across, seen.y1 + down)
    return wide if wide.area <= LOOKED_AT_CAP else seen


def all_in(rect: Rect, level: int) -> Like:
    """Returns what all pixels of a rectangle are like."""
    return Like((rect.x0, rect.y0), level, rect, 1.0, 0, False)


def unbounded(fill: Fill) -> Fill:
    """Returns the same fill, wherever its region ends."""
    return replace(fill, open=True)


def all_gone_round(fill: Fill) -> Fill:
    """Returns the same fill, of all that its line goes round."""
    like = fill.like
    return fill if like is None or like.within is None else replace(fill, like=replace(like, regions="line"))
