"""What was painted on a layer with example textures: plots, each a region of one example at one depth (Ritter et al.
2006, section 7).

Paint of the same texture at the same depth joins into one region; of another texture at the same depth, it takes the
place of what was there, and both grow rims along the seam; at another depth it lies over or under the rest, whose rims
stay as they were.  Erasing takes pixels away, and what is left grows a rim there.

A growth is a value.  Painting changes masks alone; `previewed` and `settling` make the pixels follow, and the final
ones depend on masks, examples and seeds only.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import Executor
from dataclasses import dataclass, replace

import numpy as np

from engine.canvas.grown import shown as pixels
from engine.canvas.grown.carry import carried
from engine.canvas.grown.closer import BEYOND
from engine.canvas.grown.learnt_below import LOOKED_ABOUT, has_alpha
from engine.canvas.grown.shown import Shown
from engine.numeric.address import Rect
from engine.texture.example import region as regions
from engine.texture.example import tiles
from engine.texture.example.exemplar import Exemplar
from engine.texture.example.region import Region
from engine.texture.example.region_window import OUTSIDE
from engine.texture.example.tiles import NONE, TilePlanes, Tiles
from engine.texture.example.told import translated

_NOWHERE = Rect(0, 0, 0, 0)
_MOST_RECTS = 32  # that changes of one plot are told by
Tell = Callable[[float], None]  # of the part of some work that is done, 0..1
_MOST_LEARNT = 1 << 23  # pixels of tiles: flattened, they take 128 MB
_PASSING = 3  # coarser levels from here on are not looked at: that takes longer than to refine the next one


@dataclass(frozen=True, slots=True, eq=False)
class Plot:
    """A region of one example.

    `depth`: of the plots of a layer those of greater depth number lie on top; `level`: of the canvas, whose pixels are
    the region's; `name`: of the texture when it was painted; `key`: what tells the example's content from others';
    `shown`: what `drawn`, the region as it was last looked at, looks like at this level and coarser ones; `turn`: the
    greater, the later it was painted on.
    """

    depth: float
    level: int
    name: str
    key: str
    region: Region
    shown: Shown = ()
    drawn: Region | None = None
    turn: int = 0

    @property
    def settled(self) -> bool:
        """Tells whether its pixels are as they will stay for this region."""
        return self.drawn is self.region and self.region.fresh(0)

    @property
    def order(self) -> tuple[float, int, str]:
        """By which plots lie on one another."""
        return self.depth, self.level, self.key

    @property
    def finest(self) -> int:
        """Returns the finest level of the canvas at which its example has detail: its own, and of learnt octaves as
        many as make no more than _MOST_LEARNT pixels."""
        own, octaves = self.own_finest, self.region.exemplar.octaves
        area = len(self.region.masks[0]) * tiles.TILE_SIDE**2
        while octaves and area << 2 * (own - self.level + octaves) > _MOST_LEARNT:
            octaves -= 1
        return own + octaves

    @property
    def own_finest(self) -> int:
        """Returns the finest level of the canvas at which its example has pixels of its own."""
        return self.level + len(self.region.exemplar.finer)

    @property
    def outlined(self) -> bool:
        """Tells whether it is refined within its outline, which stays that of its own pixels."""
        learning = self.region.exemplar.learning
        return learning is not None and not has_alpha(learning)


Growth = tuple[Plot, ...]  # the bottom one first, no two of one order, none without a pixel


# --- painting -----------------------------------------------------------------------------------------------------


def laid(
    growth: Growth,
    depth: float,
    level: int,
    name: str,
    key: str,
    exemplar: Exemplar,
    seed: int,
    rect: Rect,
    mask: np.ndarray,
    told: np.ndarray | None = None,
) -> Growth:
    """With the pixels of `mask`, bool (h, w) over `rect` of `level`, painted with an example; `told`: what its stored
    control channels tell of them, uint8 (C, h, w).

    They join the plot of that depth, level and example, whose seed then stays, and leave the others of that depth.  Of
    plots of a finer level all pixels below them leave; of a coarser one those whose centre lies in them, so that it
    makes no difference in how many strokes a mask is painted.
    """
    if rect.empty or not mask.any():
        return growth
    own = next((plot for plot in growth if plot.order == (depth, level, key)), None)
    turn = 1 + max((plot.turn for plot in growth), default=0)
    if own is None:
        own = Plot(depth, level, name, key, regions.empty(exemplar, seed))
    grown = _painted(own, rect, mask, False, told)
    others = [_cut(p, level, rect, mask) if p.depth == depth else p for p in growth if p is not own]
    return _ordered([*others, replace(grown, turn=turn)], growth)


def cut(growth: Growth, level: int, rect: Rect, mask: np.ndarray, depth: float | None = None) -> Growth:
    """Without the pixels of `mask`, bool (h, w) over `rect` of `level`: of one depth, or of all; of plots of other
    levels as `laid` takes them."""
    return _ordered([_cut(p, level, rect, mask) if depth in (None, p.depth) else p for p in growth], growth)


def swapped(growth: Growth, plot: Plot, name: str, key: str, exemplar: Exemplar) -> Growth:
    """With another example for a plot's region; it joins the plot of that example, depth and level if there is one."""
    if plot.key == key:
        return growth
    order = plot.depth, plot.level, key
    own = next((p for p in growth if p.order == order), None)
    turn = 1 + max(p.turn for p in growth)
    if own is None:
        own = Plot(*order[:2], name, key, regions.empty(exemplar, plot.region.seed))
    masks = plot.region.masks[0]
    for place, mask in masks.items():
        told = translated(plot.region, own.region, place)
        own = _painted(own, tiles.rect_of(place), mask.data[0] > 0, False, told)
    return _ordered([*(p for p in growth if p.order != order and p is not plot), replace(own, turn=turn)], growth)


def at(growth: Growth, level: int, x: int, y: int, depth: float | None = None) -> Plot | None:
    """Returns the topmost plot that has the pixel at the centre of a pixel of `level`, of one depth or of any."""
    for plot in reversed(growth):
        if depth in (None, plot.depth):
            up = level - plot.level
            half = 1 << -up >> 1 if up < 0 else 0
            place = Rect.at((x << -up) + half, (y << -up) + half, 1, 1) if up < 0 else Rect.at(x >> up, y >> up, 1, 1)
            if tiles.gathered(plot.region.masks[0], place, np.zeros((1, 1, 1), np.uint8)).any():
                return plot
    return None


def _painted(plot: Plot, rect: Rect, mask: np.ndarray, erase: bool, told: np.ndarray | None = None) -> Plot:
    region = regions.painted(plot.region, rect, mask, erase, told)
    same = region.masks[0] is plot.region.masks[0] and (not region.told or region.told[0] is plot.region.told[0])
    return plot if same else replace(plot, region=region)


def _cut(plot: Plot, level: int, rect: Rect, mask: np.ndarray) -> Plot:
    """Tile by tile where a plot has few in a large rectangle."""
    for place, gone in carried(rect, mask, plot.level - level, plot.region.masks[0]):
        plot = _painted(plot, place, gone, True)
    return plot


def _ordered(plots: Iterable[Plot], before: Growth) -> Growth:
    """Returns a growth of some plots; the one before, if it has the same."""
    found = tuple(sorted((plot for plot in plots if plot.region.masks[0]), key=lambda plot: plot.order))
    same = len(found) == len(before) and all(
        one is other or one.region is other.region for one, other in zip(found, before, strict=True)
    )
    return before if same else found


# --- pixels that follow -------------------------------------------------------------------------------------------


def previewed(growth: Growth) -> Growth:
    """With the coarsest level of what is new synthesised, and shown: some milliseconds, while the pen moves."""
    found = tuple(_previewed(plot) for plot in growth)
    return growth if all(one is other for one, other in zip(found, growth, strict=True)) else found


def _previewed(plot: Plot) -> Plot:
    if plot.settled:
        return plot
    region = regions.refined(plot.region, upto=len(plot.region.levels) - 1)
    return _drawn(plot, region)


def _drawn(plot: Plot, region: Region, threads: Executor | None = None) -> Plot:
    if plot.drawn is region and plot.region is region:
        return plot
    return replace(plot, region=region, shown=pixels.followed(plot.shown, plot.drawn, region, threads), drawn=region)


def settled(growth: Growth, threads: Executor | None = None, tell: Tell = lambda part: None) -> Growth:
    """With all pixels as they will stay; `tell` hears of the part that is done."""
    count = sum(not plot.settled for plot in growth)
    found: list[Plot] = []
    done = 0
    for plot in growth:
        if not plot.settled:
            plot = _settled(plot, threads, one_of(tell, done, count))
            done += 1
        found.append(plot)
    return tuple(found)


def one_of(tell: Tell, number: int, count: int) -> Tell:
    """Returns what hears of one of so many pieces of some work, of which `tell` hears."""
    return lambda part: tell((number + part) / count)


def _settled(plot: Plot, threads: Executor | None, tell: Tell) -> Plot:
    region, work = plot.region, [4.0**-n for n in range(len(plot.region.levels))]
    for step in regions.refining(region, 0, threads):
        region = step.region
        tell((sum(work[step.level + 1 :]) + step.done * work[step.level]) / sum(work))
    return _drawn(plot, region, threads)


def is_settled(growth: Growth) -> bool:
    """Tells whether every plot has its final pixels."""
    return all(plot.settled for plot in growth)


def settling(growth: Growth, near: tuple[int, Rect] | None = None, threads: Executor | None = None) -> Iterator[Growth]:
    """Yields the steps to the final pixels, some milliseconds each; the same value again where a step changed
    nothing to see.

    Plots that meet the rectangle `near` of a level first, then the ones painted last.  Any step may be the last that is
    asked for: what is finished stays.
    """
    waiting = [plot for plot in growth if not plot.settled]
    waiting.sort(key=lambda plot: (near is not None and _near(plot, near), plot.turn), reverse=True)
    for plot in waiting:
        for changed in _settling(plot, threads):
            if changed is not plot:
                growth = tuple(changed if p is plot else p for p in growth)
                plot = changed
            yield growth


def _near(plot: Plot, near: tuple[int, Rect]) -> bool:
    level, rect = near
    return bool(pixels.keys_within(rect.zoomed(plot.level - level), (plot.region.masks[0],)))


def _settling(plot: Plot, threads: Executor | None) -> Iterator[Plot]:
    region = plot.region
    for step in regions.refining(region, 0, threads):
        if step.region is region:
            yield plot
            continue
        region = step.region
        if step.level < _PASSING or plot.drawn is None:  # what was never seen is, at once
            plot = yield from _following(plot, region, threads)
        else:
            plot = replace(plot, region=region)
            yield plot
    if plot.drawn is not region:
        yield from _following(plot, region, threads)


def _following(plot: Plot, region: Region, threads: Executor | None) -> Generator[Plot, None, Plot]:
    steps = pixels.following(plot.shown, plot.drawn, region, threads)
    while True:
        try:
            next(steps)
        except StopIteration as end:
            plot = replace(plot, region=region, shown=end.value, drawn=region)
            yield plot
            return plot
        yield plot


def progress(growth: Growth) -> tuple[list[tuple[int, Rect]], float]:
    """Tells where pixels are not as they will stay, as (level, rectangle); and the part of the work that is done,
    0..1."""
    pending, done, whole = [], 0.0, 0.0
    for plot in growth:
        if plot.settled:
            continue
        region = plot.region
        rect = tiles.changed_rect(region.levels[0].mask, region.masks[0], 0)
        rect = _extent(region.masks[0]) if rect.empty else rect
        pending.append((plot.level, rect))
        work = [4.0**-n for n in range(len(region.levels))]
        whole += sum(work) * rect.area
        done += sum(work[region.finest :]) * rect.area
    return pending, done / whole if whole else 1.0


# --- looking ------------------------------------------------------------------------------------------------------


def over(out: np.ndarray, growth: Growth, level: int, rect: Rect) -> None:
    """Lays all plots, the bottom one first, over `out`, float32 (C, h, w) on the grid, which covers `rect` of a level:
    four planes of premultiplied colour, and ink, if there are more, which is covered alone."""
    for plot in growth:
        pixels.over(out, plot.shown, plot.region, level - plot.level, rect)


def planes(growth: Growth, level: int, rect: Rect) -> np.ndarray | None:
    """Returns what all plots show of `rect` of any level: premultiplied float32 (4, h, w) on the grid; None where
    nothing."""
    if not meets(growth, level, rect):
        return None
    out = np.zeros((4, rect.height, rect.width), np.float32)
    over(out, growth, level, rect)
    return out


def meets(growth: Growth, level: int, rect: Rect) -> bool:
    """Tells whether any plot may show something in `rect` of a level."""
    return any(pixels.meets(plot.shown, level - plot.level, rect) for plot in growth)


def bounds(growth: Growth, level: int) -> Rect:
    """Returns the smallest rectangle of `level` outside which nothing shows."""
    whole = _NOWHERE
    for plot in growth:
        whole = whole.union(_carried(_extent(plot.region.masks[0]), level - plot.level))
    return whole


def _extent(masks: Tiles) -> Rect:
    return tiles.changed_rect(NONE, masks, 0)


def _carried(rect: Rect, finer: int) -> Rect:
    """Returns what a rectangle can show `finer` levels below its own: expanding spreads it by less than two pixels."""
    return rect.grown(2).zoomed(finer) if finer > 0 else rect.zoomed(finer)


def changed_rects(old: Growth, new: Growth, level: int) -> list[Rect]:
    """Rectangles of `level` outside which two growths look alike."""
    before, after = ({plot.order: plot for plot in growth} for growth in (old, new))
    found = []
    for order in before.keys() | after.keys():
        one, other = before.get(order), after.get(order)
        if one is not other:
            found += [_carried(rect, level - order[1]) for rect in _changed(one, other, level > order[1])]
    return found


def _changed(one: Plot | None, other: Plot | None, finer: bool) -> list[Rect]:
    """Returns what differs at the plots' own level; with `finer`, also what can be seen below it."""
    was, now = (plot.shown[0] if plot is not None and plot.shown else NONE for plot in (one, other))
    found = list(tiles.changed_rects(was, now, 0, slice(None)))
    if not finer:
        return _fewer(found)
    if any(plot is not None and plot.region.exemplar.finer for plot in (one, other)):
        was, now = (plot.region.levels[0].sources if plot is not None else NONE for plot in (one, other))
        found += [rect.grown(BEYOND) for rect in tiles.changed_rects(was, now, OUTSIDE)]
    if any(plot is not None and plot.region.exemplar.octaves for plot in (one, other)):
        found = [rect.grown(LOOKED_ABOUT) for rect in found]
    return _fewer(found)


def _fewer(rects: list[Rect]) -> list[Rect]:
    """Returns those that lie near one another joined, until few are left."""
    side = tiles.TILE_SIDE
    while len(rects) > _MOST_RECTS:
        side *= 2
        joined: dict[tuple[int, int], Rect] = {}
        for rect in rects:
            key = rect.y0 // side, rect.x0 // side
            joined[key] = joined.get(key, _NOWHERE).union(rect)
        rects = list(joined.values())
    return rects


def tiles_of(growth: Growth) -> set[TilePlanes]:
    """Returns all tiles that a growth holds."""
    found: set[TilePlanes] = set()
    for plot in growth:
        region = plot.region
        parts = (part for n in region.levels for part in (n.mask, n.above, n.sources, n.told))
        held = (*region.masks, *region.told, *plot.shown, *parts)
        for part in {id(part): part for part in held}.values():
            found.update(part.values())
    return found
