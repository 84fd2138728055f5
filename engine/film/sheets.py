"""The pictures of levels from which a film's frames are made: each evaluated once, and where the painting changes.

Which part of which level each frame looks at is decided first.  Frames that follow one another and look at the same
level share a sheet, as long as that does not become much larger than twice the frame's sides.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import Executor, Future
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from engine.canvas import layers
from engine.canvas.composite import composite
from engine.canvas.placing.composite_steps import Planned
from engine.film.aim import Aim, Crop
from engine.film.closing import Other
from engine.numeric.address import Rect
from engine.numeric.askew import Askew
from engine.numeric.convolution import Part, faded, margin, taps
from engine.painting.difference import areas
from engine.painting.rendering import keeping, piece_reader
from engine.painting.value import Painting

FADE = 0.5  # of a level: over so much the coarser picture gives way to the finer one
LARGER = 1.5  # times twice the frame's sides that a sheet may cover
UNDER = np.float32(1.0)  # under all layers
_PIECE = 1024, 256  # pixels across and down that are evaluated at once
Parts = tuple[Part, ...] | tuple[Askew, ...]  # what a frame is the sum of


class Glance(NamedTuple):
    """What a frame takes from one level for a view: where it lies there, which sheet has that, and how much it counts;
    of the aim's upright picture, which is larger where that is turned."""

    aim: Aim
    window: Crop
    sheet: int
    share: float


@dataclass(frozen=True, slots=True)
class Sheet:
    """A rectangle of a level, which the frames `first` to `last` look at."""

    level: int
    rect: Rect
    first: int
    last: int


@dataclass(frozen=True, slots=True)
class Plan:
    """`sheets`, in the order in which they are first looked at; `frames`: of each its glances, one or two of a view."""

    sheets: tuple[Sheet, ...]
    frames: tuple[tuple[Glance, ...], ...]


def plan(aims: Sequence[Aim], size: tuple[int, int], others: Mapping[int, Other] | None = None) -> Plan:
    """Decides what frames of `size` (width, height) look at, by their aims, and by what some of them show besides."""
    others = {} if others is None else others
    still = all((aim.level, aim.fraction) == (aims[0].level, aims[0].fraction) for aim in aims)
    seen = [*aims, *(aim for aim, _ in others.values())]
    widest, tallest = (max(sides) for sides in zip(*(aim.across(size) for aim in seen), strict=True))
    most = LARGER * (2 * widest + 2 * margin(2.0)) * (2 * tallest + 2 * margin(2.0))
    sheets: list[Sheet] = []
    current: dict[tuple[bool, int], int] = {}  # the sheet of each level that is looked at, of the others or not
    frames = []
    for i in range(len(aims)):
        glances = []
        for other, aim, level, share in _looks(aims[i], others.get(i), still):
            window = aim.window(aim.across(size), level)
            need = window.rect.grown(margin(window.step))
            known = current.get((other, level))
            both = need if known is None else sheets[known].rect.union(need)
            if known is None or sheets[known].last < i - 1 or both.area > most:
                known = current[other, level] = len(sheets)
                sheets.append(Sheet(level, need, i, i))
            else:
                sheets[known] = replace(sheets[known], rect=both, last=i)
            glances.append(Glance(aim, window, known, share))
        frames.append(tuple(glances))
    return Plan(tuple(sheets), tuple(frames))


def _looks(aim: Aim, other: Other | None, still: bool) -> Iterator[tuple[bool, Aim, int, float]]:
    """Yields what a frame looks at: whether that is another view than its own, the view, a level of it, and how much
    that counts."""
    both = ((False, aim, 1.0),) if other is None else ((False, aim, 1.0 - other[1]), (True, *other))
    for is_other, seen, part in both:
        for level, share in _levels(seen, still) if part > 0.0 else ():
            yield is_other, seen, level, part * share


def _levels(aim: Aim, still: bool) -> list[tuple[int, float]]:
    """Returns the levels that are looked at, and how much each counts.

    The finer level alone is as sharp as the picture can be; where the zoom comes to a level, that gives way to the
    level itself, so that nothing jumps.
    """
    if aim.fraction == 0.0:
        return [(aim.level, 1.0)]
    x = min(aim.fraction / FADE, 1.0)
    share = 1.0 if still else x * x * (3.0 - 2.0 * x)
    return [(level, part) for level, part in ((aim.level, 1.0 - share), (aim.level + 1, share)) if part > 0.0]


class Sheets:
    """The sheets of a plan that are looked at now.  `pool`: the threads that evaluate them; `ahead`: one that prepares
    the sheet that comes next, None where the painting changes from frame to frame."""

    def __init__(self, plan: Plan, pool: Executor, ahead: Executor | None = None) -> None:
        self._plan, self._pool, self._ahead = plan, pool, ahead
        self._planes: dict[int, tuple[Painting, np.ndarray]] = {}
        self._coming: dict[int, Future[np.ndarray]] = {}
        self._elsewhere = keeping()
        self._planned: tuple[Painting, Planned] | None = None

    def parts(self, frame: int, painting: Painting) -> Parts:
        """Returns what a frame is the sum of; frames are asked for in their order."""
        for gone in [n for n in self._planes if self._plan.sheets[n].last < frame]:
            del self._planes[gone]
        glances = self._plan.frames[frame]
        parts: Parts
        if all(glance.aim.upright for glance in glances):
            parts = tuple(self._part(glance, painting) for glance in glances)
        else:
            parts = tuple(part for glance in glances for part in self._askew(glance, painting))
        self._look_ahead(max(glance.sheet for glance in glances) + 1, painting)
        return parts

    def _part(self, glance: Glance, painting: Painting) -> Part:
        window, rect = glance.window, self._plan.sheets[glance.sheet].rect
        width, height = window.size
        rows = taps(window.y - rect.y0 + window.top, window.step, height)
        columns = taps(window.x - rect.x0 + window.left, window.step, width)
        part = Part(self._brought(glance.sheet, painting), rows, columns)
        return part if glance.share == 1.0 else faded(part, glance.share)

    def _askew(self, glance: Glance, painting: Painting) -> Iterator[Askew]:
        """Yields a level as it is seen turned, or mirrored, or both ways."""
        aim, window, rect = glance.aim, glance.window, self._plan.sheets[glance.sheet].rect
        planes = self._brought(glance.sheet, painting)
        x = window.x - rect.x0 + window.left + window.size[0] * window.step / 2
        y = window.y - rect.y0 + window.top + window.size[1] * window.step / 2
        cos, sin = window.step * math.cos(aim.turn), window.step * math.sin(aim.turn)
        for flip, share in ((1.0, 1.0 - aim.mirrored), (-1.0, aim.mirrored)):
            if share > 0.0:
                yield Askew(planes, x, y, (flip * cos, -sin, flip * sin, cos), share * glance.share)

    def _brought(self, number: int, painting: Painting) -> np.ndarray:
        """Returns a sheet's planes, uint8 (3, h, w), as they are now."""
        sheet = self._plan.sheets[number]
        if number in self._coming:
            self._planes[number] = painting, self._coming.pop(number).result()
        elif number not in self._planes:
            self._planes[number] = painting, self._made(sheet, painting)
        shown, planes = self._planes[number]
        if shown is not painting:
            changed = areas(shown, painting)(sheet.level)
            for rect in [sheet.rect] if changed is None else apart(changed, sheet.rect):
                self._evaluate(sheet, rect, painting, planes)
            self._planes[number] = painting, planes
        return planes

    def _look_ahead(self, number: int, painting: Painting) -> None:
        if self._ahead is None or number >= len(self._plan.sheets) or number in self._coming or number in self._planes:
            return
        self._coming[number] = self._ahead.submit(self._made, self._plan.sheets[number], painting)

    def _made(self, sheet: Sheet, painting: Painting) -> np.ndarray:
        planes = np.empty((3, sheet.rect.height, sheet.rect.width), np.uint8)
        rest = [sheet.rect]
        for number, (shown, known) in list(self._planes.items()):  # what the sheet before has of the same level
            other = self._plan.sheets[number]
            both = other.rect.intersect(sheet.rect)
            if other.level == sheet.level and shown is painting and not both.empty:
                planes[:, *both.slices(sheet.rect)] = known[:, *both.slices(other.rect)]
                rest = _around(sheet.rect, both)
                break
        for rect in rest:
            self._evaluate(sheet, rect, painting, planes)
        return planes

    def _plan_of(self, painting: Painting) -> Planned:
        held = self._planned
        if held is None or held[0] is not painting:
            held = self._planned = painting, Planned.of(layers.pictured(painting.root))
        return held[1]

    def _evaluate(self, sheet: Sheet, rect: Rect, painting: Painting, planes: np.ndarray) -> None:
        planned = self._plan_of(painting)

        def evaluate(piece: Rect) -> None:
            read = piece_reader(sheet.level, piece, placed=self._elsewhere)
            pixels = composite(planned, sheet.level, piece, read)
            pixels[:3] += UNDER - UNDER * pixels[3]
            pixels[:3] *= 255.0
            planes[:, *piece.slices(sheet.rect)] = np.rint(pixels[:3])

        for _ in self._pool.map(evaluate, _pieces(rect)):
            pass


def _pieces(rect: Rect) -> Iterator[Rect]:
    across, down = _PIECE
    for y in range(rect.y0, rect.y1, down):
        for x in range(rect.x0, rect.x1, across):
            yield Rect.at(x, y, across, down).intersect(rect)


def _around(rect: Rect, hole: Rect) -> list[Rect]:
    """Returns a rectangle without a smaller one in it, in up to four rectangles."""
    found = (
        Rect(rect.x0, rect.y0, rect.x1, hole.y0),
        Rect(rect.x0, hole.y1, rect.x1, rect.y1),
        Rect(rect.x0, hole.y0, hole.x0, hole.y1),
        Rect(hole.x1, hole.y0, rect.x1, hole.y1),
    )
    return [part for part in found if not part.empty]


def apart(rects: Sequence[Rect], within: Rect) -> list[Rect]:
    """Returns rectangles that hold all that `rects` have of `within`, and do not meet."""
    out: list[Rect] = []
    for rect in rects:
        rect = rect.intersect(within)
        if rect.empty:
            continue
        while met := next((other for other in out if other.meets(rect)), None):
            out.remove(met)
            rect = rect.union(met)
        out.append(rect)
    return out
