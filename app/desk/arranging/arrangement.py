"""Where panels lie, as a value: in which column and in which order, how wide and high, or floating over the canvas.

Lengths are points, so that an arrangement means the same on every screen.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from immutables import Map

PanelBox = tuple[float, float, float, float]  # left, top, width, height


class Dock(NamedTuple):
    """A panel that can be arranged.  `high`: usually; `least`: it is no lower while there is room; `section`: the title
    of the section that folds all of it; `home`: its column at first; `fills`: it takes what room is left."""

    title: str
    hint: str
    high: float
    least: float
    section: str = ""
    home: str = "left"
    fills: bool = False


DOCKS = {
    "tools": Dock("Tools", "What the hand does", 85.0, 85.0),
    "brushes": Dock("Brushes", "Presets, with pictures", 260.0, 200.0, "Brushes", fills=True),
    "settings": Dock("Brush settings", "What the brush in hand is set to", 560.0, 200.0),
    "colour": Dock("Colour", "Wheel, sliders, palettes", 362.0, 120.0, "Colour", "right"),
    "ink": Dock("Ink mixer", "Textures in the paint", 148.0, 76.0, "Ink mixer", "right"),
    "layers": Dock("Layers", "The stack of layers", 300.0, 204.0, "Layers", "right", fills=True),
}
COLUMNS = "left", "right"
NARROWEST_COLUMN, WIDEST_COLUMN, USUAL_WIDTHS = 236.0, 560.0, (248.0, 286.0)
FREE = 320.0  # of the canvas that columns leave, at least
LOWEST_DOCK, HIGHEST_DOCK = 60.0, 4000.0
_HOMES = {side: tuple(name for name, dock in DOCKS.items() if dock.home == side) for side in COLUMNS}


@dataclass(frozen=True, slots=True)
class Arrangement:
    """Each panel is in one column or floats; one that is `hidden` keeps its place.  `widths`: of the left and the right
    column; `heights`: of panels that were dragged; `strip`: of what opens below the canvas, 0 as it comes."""

    left: tuple[str, ...] = _HOMES["left"]
    right: tuple[str, ...] = _HOMES["right"]
    floating: Map[str, PanelBox] = field(default_factory=Map)
    hidden: frozenset[str] = frozenset()
    widths: tuple[float, float] = USUAL_WIDTHS
    heights: Map[str, float] = field(default_factory=Map)
    strip: float = 0.0

    def column(self, side: str) -> tuple[str, ...]:
        """Returns the panels of a column that are to be seen, from the top."""
        return tuple(name for name in (self.left if side == "left" else self.right) if name not in self.hidden)

    def side(self, name: str) -> str:
        """Returns "left", "right" or "floating"."""
        return "left" if name in self.left else "right" if name in self.right else "floating"


def docked(told: Arrangement, name: str, side: str, above: str = "") -> Arrangement:
    """Puts a panel into a column, before the one named `above`, or at its end."""
    told = replace(_without(told, name), hidden=told.hidden - {name})
    names = told.left if side == "left" else told.right
    place = names.index(above) if above in names else len(names)
    names = (*names[:place], name, *names[place:])
    return replace(told, left=names) if side == "left" else replace(told, right=names)


def floated(told: Arrangement, name: str, box: PanelBox) -> Arrangement:
    """Lets a panel float over the canvas."""
    told = _without(told, name)
    return replace(told, floating=told.floating.set(name, box), hidden=told.hidden - {name})


def shown_or_hidden(told: Arrangement, name: str) -> Arrangement:
    """Hides a panel, or shows it where it was."""
    return replace(told, hidden=told.hidden ^ {name})


def sides_swapped(told: Arrangement) -> Arrangement:
    """Returns it with the columns on one another's sides."""
    return replace(told, left=told.right, right=told.left, widths=(told.widths[1], told.widths[0]))


def widened(told: Arrangement, side: str, width: float) -> Arrangement:
    """Gives a column a width, within bounds."""
    width, (left, right) = max(NARROWEST_COLUMN, min(WIDEST_COLUMN, width)), told.widths
    return replace(told, widths=(width, right) if side == "left" else (left, width))


def widths_in(told: Arrangement, room: float) -> tuple[float, float]:
    """Returns how wide the columns are in a window of such a width: none where nothing is to be seen, and no wider than
    leaves some of the canvas."""
    left, right = (width if told.column(side) else 0.0 for side, width in zip(COLUMNS, told.widths, strict=True))
    most = max(room - FREE, 0.0)
    if left + right <= most or not left + right:
        return left, right
    least = tuple(min(NARROWEST_COLUMN, width) for width in (left, right))
    part = max(0.0, most - sum(least)) / max(left + right - sum(least), 1e-9)
    return least[0] + (left - least[0]) * part, least[1] + (right - least[1]) * part


def heights_in(
    told: Arrangement, names: Sequence[str], folded: Mapping[str, float], room: float, fixed: Mapping[str, float]
) -> list[float]:
    """Returns how high the panels `names` of a column are that has so much room: together as high as that, unless all
    are folded.  `folded`: by those that are, how high they are then; `fixed`: by those that nobody drags, likewise."""
    settled = {**fixed, **folded}
    free = [name for name in names if name not in settled]
    if not free:
        return [settled[name] for name in names]
    room = max(0.0, room - sum(settled[name] for name in names if name in settled))
    least = {name: DOCKS[name].least for name in free}
    if sum(least.values()) >= room:
        return [settled[name] if name in settled else least[name] * room / sum(least.values()) for name in names]
    filler = filling(names, settled)
    wanted = {name: max(told.heights.get(name, DOCKS[name].high), LOWEST_DOCK) for name in free}
    low = {name: min(least[name], wanted[name]) for name in free} | {filler: least[filler]}
    wanted[filler] = low[filler]
    over = sum(wanted.values()) - room
    if over > 0:
        part = over / max(sum(wanted.values()) - sum(low.values()), 1e-9)
        wanted = {name: high - (high - low[name]) * part for name, high in wanted.items()}
    wanted[filler] = room - sum(high for name, high in wanted.items() if name != filler)
    return [settled[name] if name in settled else wanted[name] for name in names]


def filling(names: Sequence[str], settled: Collection[str]) -> str:
    """Returns which of a column's panels takes the room that is left; "" for none, where all are `settled`."""
    free = [name for name in names if name not in settled]
    return next((name for name in reversed(free) if DOCKS[name].fills), free[-1] if free else "")


def edge_dragged(
    told: Arrangement, pair: tuple[str, str], heights: tuple[float, float], by: float, filler: str
) -> Arrangement:
    """Makes the upper of two panels higher, as far as the lower one can give way; the one that fills the column needs
    no height of its own."""
    lowest = min(LOWEST_DOCK, *heights)
    by = max(lowest - heights[0], min(heights[1] - lowest, by))
    kept = told.heights
    for name, high in zip(pair, (heights[0] + by, heights[1] - by), strict=True):
        kept = kept if name == filler else kept.set(name, max(LOWEST_DOCK, min(HIGHEST_DOCK, high)))
    return replace(told, heights=kept)


def _without(told: Arrangement, name: str) -> Arrangement:
    left, right = (tuple(other for other in names if other != name) for names in (told.left, told.right))
    floating = told.floating.delete(name) if name in told.floating else told.floating
    return replace(told, left=left, right=right, floating=floating)
