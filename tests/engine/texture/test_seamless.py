"""Examples grown without seams, beside the method that definitions had before, whose pixels stay."""

from __future__ import annotations

import zlib

import numpy as np
import pytest
from exemplars import bounded, controlled, faint, graded, told_at, unbounded

from engine.numeric.address import Rect
from engine.numeric.neighbourhood import FULL, straight_shapes
from engine.texture.example import pieces, show
from engine.texture.example.exemplar import PAD, Exemplar
from engine.texture.example.region import empty, painted, refined
from engine.texture.example.rules import example_of

METHODS = {}, {"method": 2}
RECT = Rect.at(-31, 17, 150, 90)
# Of what each method grows: to be altered with the method alone, which then is another one.
GROWN = {
    "correction": (bounded, {}, (1501588159, 1497471127)),
    "correction, two passes": (bounded, {"passes": 2, "neighbourhood": 5}, (1175250441, 1530718470)),
    "correction without a rim": (unbounded, {}, (4184315613, 2744219634)),
    "correction with maps": (controlled, {}, (4221566806, 1981179095)),
    "seamless with maps": (controlled, {"method": 2}, (2658262364, 3978941240)),
    "seamless": (bounded, {"method": 2}, (4096492948, 2160659992)),
    "seamless without a rim": (unbounded, {"method": 2}, (2445470605, 4022330710)),
}


def grown(exemplar: Exemplar, rect: Rect, mask: np.ndarray, seed: int = 3) -> tuple[np.ndarray, np.ndarray]:
    """Sources and pixels."""
    region = refined(painted(empty(exemplar, seed), rect, mask, values=told_at(exemplar, rect)))
    return show.sources(region, rect), show.pixels(region, rect)


@pytest.mark.parametrize(("make", "values", "sums"), GROWN.values(), ids=GROWN)
def test_what_was_grown_stays(make, values, sums):
    y, x = np.mgrid[:90, :150]
    mask = abs(y - 45 - 20 * np.sin(x / 20.0)) < 18
    assert tuple(zlib.crc32(found.tobytes()) for found in grown(make(64, **values), RECT, mask)) == sums


def repeated(exemplar: Exemplar) -> float:
    """The part of a level band that comes from where what lies some way along it comes from, at the worst distance."""
    names, _ = grown(exemplar, Rect(0, 0, 440, 44), np.ones((44, 440), bool))
    found = names[:, 20:-20]
    return max(float((found[:, lag:] == found[:, :-lag]).mean()) for lag in range(6, 60))


@pytest.mark.parametrize("make", [bounded, graded])
def test_level_bands_repeat_less(make):
    before, after = repeated(make(120)), repeated(make(120, method=2))
    assert after < 0.75 * before


def test_pieces_hang_on_their_place_alone_and_fit():
    exemplar = unbounded(96, method=2)
    n = len(exemplar.levels) - 1
    example, block, corners = example_of(exemplar, n), exemplar.block, exemplar.blocks

    def laid(squares: Rect, wanted: bool = True) -> np.ndarray:
        size = squares.height, squares.width
        return pieces.fitting(7, squares, corners, block, example, np.full(size, wanted)) % np.uint64(corners.size)

    def seams(drawn: np.ndarray) -> float:
        """How far what goes on across the edges between columns is apart."""
        level, names, total = exemplar.levels[n], corners[drawn], 0.0
        for y, x in np.ndindex(drawn.shape[0], drawn.shape[1] - 1):
            (row, column), (other, beside) = (divmod(int(names[y, x + k]), 1 << 16) for k in (0, 1))
            left, right = level.compared[row : row + block, column + block - 2 :], level.compared[other:, beside - 2 :]
            total += np.abs(left[:, :4].astype(float) - right[:block, :4]).mean()
        return total

    whole = laid(Rect(-6, -3, 18, 11))
    part = laid(Rect(-1, 2, 9, 7))
    assert np.array_equal(whole[5:10, 5:15], part)
    assert seams(whole) < 0.95 * seams(laid(Rect(-6, -3, 18, 11), wanted=False))


def test_straight_shapes_are_those_of_half_planes():
    shapes = straight_shapes()
    assert FULL not in shapes
    assert len(np.unique(shapes)) == len(shapes)
    left = np.uint64(sum(1 << (7 * y + x) for y in range(7) for x in range(5)))
    assert left in shapes
    assert ((shapes >> np.uint64(24)) & np.uint64(1)).all()  # the pixel itself is inside
    assert bounded(64).ragged >= 1
    assert unbounded(48).ragged == 0


@pytest.mark.parametrize("level", [False, True])
def test_narrow_strokes_are_not_as_faint_as_a_rim(level):
    y, x = np.mgrid[:80, :260]
    middle = 40 if level else 40 + 20 * np.sin(x / 30.0)
    mask = abs(y - middle) < 4
    found = [grown(faint(120, **values), Rect(0, 0, 260, 80), mask)[1][..., 3][mask].mean() for values in METHODS]
    assert found[1] > 1.5 * found[0]
    wide = abs(y - middle) < 30
    found = [grown(faint(120, **values), Rect(0, 0, 260, 80), wide)[1][..., 3][wide].mean() for values in METHODS]
    assert abs(found[1] / found[0] - 1.0) < 0.1


def test_ragged_rims_are_as_faint_as_they_are():
    """Of a rim with grain in its alpha no more than its share is taken of what is faintest."""
    exemplar = bounded(120, method=2)
    y, x = np.mgrid[:120, :300]
    mask = abs(y - 60 - 30 * np.sin(x / 40.0)) < 24
    names, _ = grown(exemplar, Rect(0, 0, 300, 120), mask)
    edge = mask & ~(mask & np.roll(mask, 1, 0) & np.roll(mask, -1, 0) & np.roll(mask, 1, 1) & np.roll(mask, -1, 1))
    own = exemplar.mask & ~(
        exemplar.mask
        & np.roll(exemplar.mask, 1, 0)
        & np.roll(exemplar.mask, -1, 0)
        & np.roll(exemplar.mask, 1, 1)
        & np.roll(exemplar.mask, -1, 1)
    )
    alpha = exemplar.pixels[..., 3].astype(float)
    taken = alpha[(names[edge] >> 16) - PAD, (names[edge] & 0xFFFF) - PAD]
    assert abs(taken.mean() - alpha[own].mean()) < 0.25 * alpha[own].std()
