"""Masks found by themselves: how well on twenty pictures whose masks are known, and what a correction takes.

Untouched on plain grounds, after three strokes on textured ones: each through the middle of the largest part that is
wrong, as an artist would lay it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import NamedTuple

import numpy as np
from scipy import ndimage

from bench import Figure, Skipped
from bench.clock import processor
from bench.composites import SIDE, Composite, composites
from engine.numeric.address import Rect
from engine.texture.mattes.finding import Cut, Outline, Sought, cut_out_of, outlined, sought
from engine.texture.mattes.fine_rim import stretched
from engine.texture.mattes.marks import Mark

PLAIN, TEXTURED = 0.97, 0.95  # of the union, at least, lies in both
STROKES = 3
SEEN, WHOLE = 0.3, 3.0  # seconds until a correction is seen, and its rim
LARGE = 1024  # pixels along the largest example
WAYS = 16  # in which a stroke may lie


class Judged(NamedTuple):
    """`overlap`: of the masks, intersection over union; `all_over`, `soft`: mean error of alpha, of all pixels and of
    those that are neither in nor out."""

    overlap: float
    all_over: float
    soft: float


def measure(small: bool = False) -> Iterator[Figure | Skipped]:
    side, names, repeats = (128, ("bread on white", "leaves on gravel"), 1) if small else (SIDE, None, 3)
    pictures = list(composites(side, names))
    for plain, wanted in ((True, PLAIN), (False, TEXTURED)):
        found = {one.name: judged(one, 0 if plain else STROKES) for one in pictures if one.plain == plain}
        told = ", ".join(f"{name} {one.overlap:.3f}" for name, one in found.items())
        least = min(one.overlap for one in found.values())
        of = "plain grounds, untouched" if plain else f"textured grounds, {STROKES} strokes"
        yield Figure(f"{of}: least overlap", least, "", str(wanted), least / wanted, 1.0, True, told)
        errors = [float(np.mean([one[k] for one in found.values()])) for k in (1, 2)]
        note = f"{errors[1]:.3f} where it is neither 0 nor 1"
        yield Figure(f"{of}: mean error of alpha", errors[0], "", "0.02", errors[0] / 0.02, 1.0, note=note)
    (picture,) = composites(side if small else LARGE, ("leaves on gravel",))
    yield from _times(sought(picture.pixels), picture, repeats)


def _times(looked: Sought, picture: Composite, repeats: int) -> Iterator[Figure]:
    across, middle = len(picture.pixels), len(picture.pixels) / 2
    marks = [Mark(True, ((0.4 * across, middle), (0.6 * across, middle)), across / 40)]
    outline = outlined(looked, marks)
    rows = (
        ("found", partial(sought, picture.pixels), WHOLE),
        ("corrected", partial(outlined, looked, marks), SEEN),
        ("its rim", partial(_rimmed, looked, outline), WHOLE),
    )
    for name, work, bound in rows:
        taken = min(processor(work) for _ in range(repeats))
        note = "seconds of the processor"
        yield Figure(f"{name}, {across} x {across}", taken * 1e3, "ms", f"{bound} s", taken / bound, 1.0, note=note)


def _rimmed(looked: Sought, outline: Outline) -> None:
    for _ in Cut(looked, outline).steps():
        pass


def judged(picture: Composite, strokes: int) -> Judged:
    """What is found after so many strokes."""
    looked = sought(picture.pixels)
    alpha = cut_out_of(looked, strokes_laid(picture, looked, strokes))[..., 3] / 255
    found, soft = alpha >= 0.5, (picture.alpha > 0.02) & (picture.alpha < 0.98)
    apart = np.abs(alpha - picture.alpha)
    overlap = (found & picture.mask).sum() / (found | picture.mask).sum()
    return Judged(float(overlap), float(apart.mean()), float(apart[soft].mean()))


def strokes_laid(picture: Composite, looked: Sought, count: int) -> list[Mark]:
    """As an artist who sees what is found lays them, one after the other."""
    marks: list[Mark] = []
    height, width = picture.mask.shape
    for _ in range(count):
        found = stretched(outlined(looked, marks).trace, (height, width), Rect(0, 0, width, height)) > 0.5
        wrong = found != picture.mask
        if not wrong.any():
            break
        marks.append(_stroke(wrong, picture.mask))
    return marks


def _stroke(wrong: np.ndarray, mask: np.ndarray) -> Mark:
    """The longest straight stroke through the deepest place of the largest part that is wrong."""
    parts, _ = ndimage.label(wrong)
    sizes = np.bincount(parts.ravel())
    sizes[0] = 0
    far = ndimage.distance_transform_edt(np.pad(parts == sizes.argmax(), 1))[1:-1, 1:-1]
    y, x = np.unravel_index(far.argmax(), far.shape)
    radius = max(1.0, 0.5 * float(far[y, x]))
    ways = [(np.cos(a), np.sin(a)) for a in np.arange(WAYS) * np.pi / WAYS]
    lines = [[_end(far, (x, y), (s * dx, s * dy), radius) for s in (-1, 1)] for dx, dy in ways]
    longest = max(lines, key=lambda ends: math.dist(ends[0], ends[1]))
    return Mark(bool(mask[y, x]), tuple(longest), radius)


def _end(far: np.ndarray, at: tuple[int, int], way: tuple[float, float], radius: float) -> tuple[float, float]:
    """How far a stroke goes one way."""
    end = float(at[0]), float(at[1])
    while True:
        x, y = end[0] + way[0], end[1] + way[1]
        inside = 0 <= int(y) < far.shape[0] and 0 <= int(x) < far.shape[1]
        if not inside or far[int(y), int(x)] < radius:
            return end
        end = x, y
