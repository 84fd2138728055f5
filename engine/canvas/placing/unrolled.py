"""The turns of a picture that contains itself laid over one another, as many as are seen."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

import numpy as np

from engine.canvas.layers import Layer
from engine.canvas.placing.clip import clipped
from engine.canvas.placing.portions import Work
from engine.canvas.placing.self_turns import Turns
from engine.canvas.placing.through import set_in
from engine.canvas.placing.unpainted import Unpainted
from engine.canvas.selecting.layer_mask import Mask
from engine.numeric.address import Rect
from engine.numeric.kernel import kernel

HIDING = np.float32(1 - 2.0**-12)  # alpha in front of a pixel from which on nothing behind it counts


# What is left of the turn within one, of each pixel of a rectangle: float32 (h, w).
Left = Callable[[int, Rect], np.ndarray]
# Composites what a turn shows of a rectangle, uncut, around what lies in it: float32 (4, h, w), a new array; or None.
Draw = Callable[[int, Rect, "np.ndarray | None"], "np.ndarray | None"]


def all_turns(turns: Turns, level: int, rect: Rect, draw: Draw, share: np.float32, first: int = 0) -> Work:
    """Makes the picture in a rectangle, from the innermost turn outwards that counts: float32 (4, h, w), None where
    empty.  `share`: how much of a turn shows in the one around it, at most.  `first`: where there are more turns, the
    picture of so many, the outermost, is there to show meanwhile."""
    shown: list[Rect] = []
    part, left = turns.within(0, level, rect), np.float32(1)
    while not part.empty and left >= 1 - HIDING:
        left *= share
        shown.append(part)
        part = turns.within(len(shown), level, part)
    meanwhile: np.ndarray | None = None
    for count in (first, len(shown)) if 0 < first < len(shown) else (len(shown),):
        pixels: np.ndarray | None = None
        for turn in reversed(range(count)):
            inner = None if pixels is None else set_in(pixels, shown[turn + 1], shown[turn])
            pixels = _cut(turns, turn, level, shown[turn], draw(turn, shown[turn], inner))
            yield meanwhile
        meanwhile = None if pixels is None else set_in(pixels, shown[0], rect)
    return meanwhile


def lying_below(turns: Turns, level: int, rect: Rect, draw: Draw) -> Work:
    """As `all_turns`, of what lies below the placement: one turn is laid behind those within it, from the innermost on
    that holds the rectangle, until all is hidden."""
    first = turns.holding(level, rect)
    shown: list[Rect] = []
    part = turns.within(first, level, rect)
    while not part.empty:
        shown.append(part)
        part = turns.within(first + len(shown), level, part)
    pixels: np.ndarray | None = None
    for n in reversed(range(len(shown))):
        part = shown[n]
        pixels = None if pixels is None else set_in(pixels, shown[n + 1], part)
        pixels = _behind(pixels, turns, first + n, level, part, draw)
        yield None if pixels is None else set_in(pixels, part, rect)
    if not shown:
        return None
    pixels = None if pixels is None else set_in(pixels, shown[0], rect)
    for turn in reversed(range(first)):
        if pixels is not None and hides(pixels):
            break
        pixels = _behind(pixels, turns, turn, level, rect, draw)
        yield pixels
    return pixels


def _behind(
    pixels: np.ndarray | None, turns: Turns, turn: int, level: int, rect: Rect, draw: Draw
) -> np.ndarray | None:
    """Returns pixels with a turn laid behind them, cut by its frame."""
    return _cut(turns, turn, level, rect, _lined(pixels, turn, rect, draw))


def _lined(pixels: np.ndarray | None, turn: int, rect: Rect, draw: Draw) -> np.ndarray | None:
    """Returns pixels with a turn laid behind them."""
    if pixels is not None and hides(pixels):
        return pixels
    drawn = draw(turn, rect, None)
    if pixels is None or drawn is None:
        return drawn if pixels is None else pixels
    pixels = np.array(pixels, np.float32, order="C")
    lay_behind(pixels, drawn)
    return pixels


def cut_turns(
    turns: Turns, level: int, rect: Rect, left: Left, draws: tuple[Draw, Draw], first: int, few: int = 0
) -> Work:
    """As `all_turns`, where a mask cuts each turn in the one around it; `draws`: what lies below in a turn, and what it
    shows around that and all within.  `first`: so many turns, the outermost, hold the rectangle, are left whole and
    have nothing above.  `few`: of so many turns more the picture is there to show meanwhile."""
    below, around = draws
    shown = [turns.within(first, level, rect)]
    kept: list[np.ndarray] = []
    through: np.ndarray | None = None  # how much of each pixel all masks so far leave
    meanwhile: np.ndarray | None = None

    def by_now() -> Work:
        pixels: np.ndarray | None = None
        for n in reversed(range(len(kept))):
            part, turn = shown[n], first + n
            inner = None if pixels is None else set_in(pixels, shown[n + 1], part) * kept[n]
            pixels = _cut(turns, turn, level, part, around(turn, part, _lined(inner, turn, part, below)))
            yield meanwhile
        pixels = None if pixels is None else set_in(pixels, shown[0], rect)
        for turn in reversed(range(first)):
            if pixels is not None and hides(pixels):
                break
            pixels = _behind(pixels, turns, turn, level, rect, below)
            yield meanwhile
        return pixels

    while not shown[-1].empty:
        if few and len(kept) == few:
            meanwhile = yield from by_now()
        part = shown[-1]
        share = left(first + len(kept), part)
        through = share if through is None else through[part.slices(shown[-2])] * share
        kept.append(np.where(through < np.float32(1) - HIDING, np.float32(0), share))
        if not kept[-1].any():
            break
        shown.append(turns.within(first + len(kept), level, part))
    return (yield from by_now())


def lying_above(
    turns: Turns, layers: Sequence[Layer] | None, level: int, rect: Rect, draw: Draw, unpainted: Unpainted
) -> Work:
    """As `all_turns`, of what lies above the placement, which lays all over nothing: from the outermost turn inwards,
    until all is hidden.  `layers`: all that is drawn, if there are no placements among it."""
    first = 0 if layers is None else turns.empty(layers, level, rect)
    front: np.ndarray | None = None
    turn, part = first, turns.within(first, level, rect)
    while not part.empty:
        nothing = layers is not None and unpainted.empty(layers, level, part, turns[turn].unclipped)
        drawn = None if nothing else _cut(turns, turn, level, part, draw(turn, part, None))
        if drawn is not None and front is None and part == rect:
            front = drawn
            if hides(front):
                break
        elif drawn is not None:
            front = np.zeros((4, rect.height, rect.width), np.float32) if front is None else front
            if lay_behind(front[:, *part.slices(rect)], np.ascontiguousarray(drawn)):
                break
        yield front
        turn += 1
        part = turns.within(turn, level, part)
    return front


def leaves(sources: Iterable[object]) -> Iterator[object]:
    """Yields sources of steps, and those of the steps of groups among them."""
    for source in sources:
        if isinstance(source, tuple):
            yield from leaves(step.source for step in source)
        else:
            yield source


def only_layers(sources: Iterable[object]) -> list[Layer] | None:
    """Returns the layers among sources of steps; None if there is more among them than these and their masks."""
    found = [one for one in leaves(sources) if not isinstance(one, Mask)]
    layers = [one for one in found if isinstance(one, Layer)]
    return layers if len(layers) == len(found) else None


def laid_over(front: np.ndarray | None, back: np.ndarray | None) -> np.ndarray | None:
    """Returns one picture over another; `front` is written to."""
    if front is not None and back is not None:
        lay_behind(front, np.ascontiguousarray(back))
    return back if front is None else front


def _cut(turns: Turns, turn: int, level: int, rect: Rect, pixels: np.ndarray | None) -> np.ndarray | None:
    clip = turns[turn].own
    return None if pixels is None or clip is None else clipped(pixels, (clip,), level, rect)


def hides(pixels: np.ndarray) -> bool:
    """Tells whether nothing that lies behind pixels counts."""
    return bool((pixels[3] > HIDING).all())


@kernel
def lay_behind(front: np.ndarray, behind: np.ndarray) -> bool:
    """Lays pixels behind others, both premultiplied float32 (4, h, w); one of which less than 2^-12 is left stays as
    it is.  Returns whether all do now."""
    one, hidden = np.float32(1), True
    for y in range(front.shape[1]):
        for x in range(front.shape[2]):
            if front[3, y, x] <= HIDING:
                left = one - front[3, y, x]
                for c in range(4):
                    front[c, y, x] += left * behind[c, y, x]
                hidden &= front[3, y, x] > HIDING
    return hidden
