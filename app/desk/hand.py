"""What the artist has in hand: the brush, the tool, the colours, and what the brush brings along.

Panels and tools read it freely; the brush, its textures and the tool change through the methods alone.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

from app.desk.colours import RGB, to_hex
from app.desk.holding import dipping
from app.desk.holding.sizes import Sizes
from engine.brush.modes import MODES, Mode
from engine.brush.settings import Brush
from engine.painting.commands import DefineTexture

HISTORY = 24  # colours remembered
SMALLEST, LARGEST = 0.5, 2000.0  # radius of a brush on the screen, pixels
WITH_BRUSH = ("brush", "fill", "enclose")  # tools that lay what the brush lays
BLACK, WHITE = (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)


@dataclass(slots=True)
class Hand:
    """`provided`: textures that were posted to the engine, each with the serial of the painting that it is for;
    `paper_stays`: the brushes that are taken next are used on the paper of this one; `stabiliser`: how much the path
    of a stroke is smoothed, 0..1; `steadying`: how, a row of engine.brush.steadying.STEADIED; `colours`: those painted
    with before, the last one first; `original`: the brush as it was taken, or saved."""

    colour: RGB = (0.11, 0.16, 0.24)
    other_colour: RGB = WHITE
    colours: list[RGB] = field(default_factory=list)
    stabiliser: float = 0.3
    steadying: str = "weighted"
    paper_stays: bool = False
    provided: set[tuple[int, DefineTexture]] = field(default_factory=set)
    sizes: Sizes = field(default_factory=Sizes)
    original: Brush = field(default_factory=Brush)
    _brush: Brush = field(default_factory=Brush)
    _preset: str = ""
    _needs: tuple[DefineTexture, ...] = ()
    _tool: str = "brush"
    _erasing: bool = False

    @property
    def brush(self) -> Brush:
        """Returns the brush; its radius is in pixels of the screen, its colour is what its inks were mixed for."""
        return self._brush

    @property
    def preset(self) -> str:
        """Returns the name under which it was taken, or saved; empty if it has none."""
        return self._preset

    @property
    def needs(self) -> tuple[DefineTexture, ...]:
        """Returns the textures that it came with."""
        return self._needs

    @property
    def tool(self) -> str:
        """Returns a row of TOOLS in app.tools."""
        return self._tool

    @property
    def erasing(self) -> bool:
        """Tells whether the brush erases; never with another tool."""
        return self._erasing

    def stroke_mode(self, eraser: bool = False) -> Mode:
        """Returns what a stroke does: the row of the brush's mode, or of what erasing with it is; `eraser`: the
        pen's other end touches the canvas."""
        row = self._brush.row
        return MODES[row.eraser] if self._erasing or eraser else row

    def dipped(self) -> Brush:
        """Returns the brush with the colour on it, as strokes have it."""
        return dipping.dipped(self._brush, to_hex(self.colour))

    def take(self, brush: Brush, preset: str | None = None, needs: tuple[DefineTexture, ...] | None = None) -> None:
        """Takes a brush; without a name or textures of its own it keeps those of the one before."""
        self.sizes.leave(self._preset, self._brush)
        self._brush = brush
        if preset is not None:
            self._preset, self.original = preset, brush
        self._needs = self._needs if needs is None else needs

    def change(self, **settings: Any) -> None:
        """Gives the brush other settings."""
        self._brush = replace(self._brush, **settings)

    def bring(self, *textures: DefineTexture) -> None:
        """Adds textures that the brush brings along, in place of those of the same names."""
        names = {texture.name for texture in textures}
        self._needs = (*(need for need in self._needs if need.name not in names), *textures)

    def use(self, tool: str) -> None:
        """Chooses a tool; the brush paints again."""
        self.erase(False)
        self._tool = tool

    def erase(self, on: bool = True) -> None:
        """Makes the brush erase, or paint again, each at its own size."""
        if on != self._erasing:
            self.change(radius=self.sizes.turned(self._brush.radius))
        self._tool, self._erasing = "brush", on

    def resize(self, factor: float) -> None:
        """Makes the brush larger or smaller."""
        self.change(radius=round(max(SMALLEST, min(LARGEST, self._brush.radius * factor)), 2))

    def swap(self) -> None:
        """Swaps the two colours."""
        self.colour, self.other_colour = self.other_colour, self.colour

    def remember(self) -> None:
        """Puts the colour first among those painted with."""
        if self.colour in self.colours:
            self.colours.remove(self.colour)
        self.colours.insert(0, self.colour)
        del self.colours[HISTORY:]


def go_on_with_brush(hand: Hand) -> None:
    """Chooses the brush, unless a tool that works with it is chosen."""
    hand.use(hand.tool if hand.tool in WITH_BRUSH else "brush")


def mixed_now(hand: Hand) -> Brush:
    """Returns the brush with the colour, and its inks as they go with that; which are fixed is still told."""
    return dipping.in_colour(hand.brush, to_hex(hand.colour))


def radius_of(hand: Hand, eraser: bool) -> float:
    """Returns the radius of a stroke, pixels of the screen; `eraser`: the pen's other end touches the canvas."""
    resting = hand.sizes.resting
    return resting if eraser and not hand.erasing and resting is not None else hand.brush.radius
