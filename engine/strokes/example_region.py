"""The region of an example as a definition tells it: steps, each of which selects pixels of the example's picture.

A step is a `select` command without `do`: what it takes (`stroke`, `like`, `alpha`, `all`) and `op`, how that joins
what was selected before ("replace", "add", "subtract", "intersect"); or `invert`, or `smooth`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from engine.brush.checks import thawed
from engine.brush.footprint import Footprint
from engine.brush.settings import Brush
from engine.checks.field_error import FieldError
from engine.checks.values import described
from engine.files.strict_json import Fields
from engine.numeric.address import Rect
from engine.painting import commands as c

STEPS_CAP = 4096
_FURTHEST = 1 << 24  # pixels from the corner at which a stroke may begin
SMOOTH, PASSES = 2, 3  # pixels that one smoothing reaches, and how often it is done
SPACING = 0.1  # of the dabs of a round brush, in radii: their union has no scallops
_HALF_STEP = 1 / 512  # of 8-bit colours, which lie on the grid only nearly

Op = Callable[[np.ndarray, np.ndarray], np.ndarray]
OPS: dict[str, Op] = {
    "replace": lambda inside, taken: taken,
    "add": lambda inside, taken: inside | taken,
    "subtract": lambda inside, taken: inside & ~taken,
    "intersect": lambda inside, taken: inside & taken,
}


def round_brush(radius: float) -> Brush:
    """Returns the brush that paints regions, with a radius in pixels of the example."""
    return Brush(radius=radius, hardness=1.0, spacing=SPACING)


def followed(inside: np.ndarray, steps: Iterable[Any], picture: np.ndarray, place: str = "region") -> np.ndarray:
    """Returns a region, bool (h, w), after steps.  `picture`: the example, premultiplied RGBA, float32 (4, h, w) on the
    grid.  FieldError names the step and the member by `place`; BrushError what is wrong with a stroke."""
    for i, step in enumerate(steps):
        inside = _after(inside, thawed(step), picture, f"{place}[{i}]")
    return inside


def _after(inside: np.ndarray, step: Any, picture: np.ndarray, place: str) -> np.ndarray:
    if not isinstance(step, Mapping):
        raise FieldError(place, described(step), "an object")
    named = [name for name in (*_TAKEN, *_CHANGED) if name in step]
    if len(named) != 1:
        raise FieldError(place, described(sorted(step)), f"one of {', '.join((*_TAKEN, *_CHANGED))}")
    members = Fields(step, place)
    if named[0] in _CHANGED:
        return _CHANGED[named[0]](inside) if members.flag(named[0]) else inside
    op = members.take("op", "replace")
    if op not in OPS:
        raise members.fault("op", f"one of {', '.join(OPS)}")
    return OPS[op](inside, _TAKEN[named[0]](members, picture))


# --- what is taken ---------------------------------------------------------------------------------------------------


def lay(taken: np.ndarray, footprint: Footprint, points: np.ndarray, value: bool = True) -> Rect:
    """Sets the pixels of a region, bool (h, w), that more points of a stroke take, and returns a rectangle that holds
    them."""
    return _set(taken, footprint.lay(points), value)


def _set(taken: np.ndarray, covering: Iterable[tuple[Rect, np.ndarray]], value: bool) -> Rect:
    whole, changed = Rect(0, 0, taken.shape[1], taken.shape[0]), Rect(0, 0, 0, 0)
    for rect, covered in covering:
        part = rect.intersect(whole)
        if not part.empty:
            taken[part.slices(whole)][covered[part.slices(rect)]] = value
            changed = changed.union(part)
    return changed


def _stroke(members: Fields, picture: np.ndarray) -> np.ndarray:
    value, place = members.take("stroke"), members.at("stroke")
    if not isinstance(value, Mapping):
        raise FieldError(place, described(value), "a stroke")
    stroke = c.parse({**value, "do": "stroke"}, place)
    assert isinstance(stroke, c.Stroke)
    if stroke.level != 0:
        raise FieldError(f"{place}.level", str(stroke.level), "0")
    if max(map(abs, stroke.origin)) > _FURTHEST:
        raise FieldError(f"{place}.origin", described(list(stroke.origin)), f"two integers within {_FURTHEST}")
    _, height, width = picture.shape
    taken = np.zeros((height, width), np.bool_)
    footprint = Footprint(stroke.brush, stroke.origin, within=Rect(0, 0, width, height), copies=stroke.copies)
    _set(taken, footprint.whole(stroke.points), True)
    return taken


def _like(members: Fields, picture: np.ndarray) -> np.ndarray:
    """Tells where a picture is like the pixel `at`, in every channel by at most `tolerance` (0..1); `contiguous`:
    only what hangs together with it."""
    about = Fields(members.take("like"), members.at("like"))
    x, y = about.integers("at", 2, limit=_FURTHEST)
    _, height, width = picture.shape
    if not (0 <= x < width and 0 <= y < height):
        raise about.fault("at", f"a pixel of the example, {width} x {height}")
    tolerance = about.number("tolerance", 0.1, lo=0.0, hi=1.0)
    near: np.ndarray = np.abs(picture - picture[:, y, x][:, None, None]).max(axis=0) <= np.float32(
        tolerance + _HALF_STEP
    )
    if not about.flag("contiguous", True):
        return near
    from scipy import ndimage  # here: it takes its time to load

    parts, _ = ndimage.label(near)
    found: np.ndarray = parts == parts[y, x]
    return found


def _alpha(members: Fields, picture: np.ndarray) -> np.ndarray:
    found: np.ndarray = (picture[3] > 0.0) == members.flag("alpha")
    return found


def _all(members: Fields, picture: np.ndarray) -> np.ndarray:
    return np.full(picture.shape[1:], members.flag("all"))


_TAKEN: dict[str, Callable[[Fields, np.ndarray], np.ndarray]] = {
    "stroke": _stroke,
    "like": _like,
    "alpha": _alpha,
    "all": _all,
}

# --- what is changed -------------------------------------------------------------------------------------------------


def smoothed(inside: np.ndarray) -> np.ndarray:
    """Returns where most of the surroundings are inside: bool (h, w).  The picture goes on past its edges as it ends
    there."""
    soft = inside.astype(np.int64)
    for _ in range(PASSES):
        for axis in (0, 1):
            soft = _summed(soft, axis)
    found: np.ndarray = 2 * soft > (2 * SMOOTH + 1) ** (2 * PASSES)
    return found


def _summed(soft: np.ndarray, axis: int) -> np.ndarray:
    """Returns the sum of 2 SMOOTH + 1 values along an axis."""
    ends = [(0, 0), (0, 0)]
    ends[axis] = (SMOOTH + 1, SMOOTH)
    total = np.pad(soft, ends, mode="edge").cumsum(axis=axis)
    count, size = 2 * SMOOTH + 1, soft.shape[axis]
    upper, lower = np.arange(count, count + size), np.arange(size)
    found: np.ndarray = total.take(upper, axis) - total.take(lower, axis)
    return found


_CHANGED: dict[str, Callable[[np.ndarray], np.ndarray]] = {"invert": np.logical_not, "smooth": smoothed}
