"""The four ways in which strokes with examples meet (Ritter et al. 2006, figure 4): which pixels are whose, and along
which outlines rims are grown."""

from pathlib import Path

import numpy as np
import pytest
from planted import masked
from scipy.ndimage import distance_transform_edt

from engine.canvas import growth as growths
from engine.numeric.address import Rect
from engine.strokes.example_files import read_exemplar, read_parameters
from engine.texture.example import show
from engine.texture.example.exemplar import PAD

EXAMPLES = Path(__file__).parents[3] / "palettes" / "examples"
WHOLE = Rect.at(0, 0, 300, 240)
NEAR, BAND, DEEP = 3, 4, 12  # pixels: of an outline; that are an example's rim; from where on none of it may come


@pytest.fixture(scope="module")
def examples(tmp_path_factory):
    folder = tmp_path_factory.mktemp("analyses")
    names = {"paper": "torn-rag-paper", "peel": "orange-peel"}
    return {
        key: read_exemplar(
            EXAMPLES / f"{name}.png",
            EXAMPLES / f"{name}.mask.png",
            read_parameters(EXAMPLES / f"{name}.toml"),
            folder,
        )
        for key, name in names.items()
    }


def capsule(x0, y0, x1, y1, radius):
    """The pixels within a radius of a line."""
    y, x = np.mgrid[: WHOLE.height, : WHOLE.width]
    along = np.clip(((x - x0) * (x1 - x0) + (y - y0) * (y1 - y0)) / ((x1 - x0) ** 2 + (y1 - y0) ** 2), 0, 1)
    return np.hypot(x - x0 - along * (x1 - x0), y - y0 - along * (y1 - y0)) < radius


FIRST, SECOND = capsule(60, 80, 240, 80, 42), capsule(150, 60, 150, 180, 38)


def stroked(growth, examples, key, mask, depth=0.0):
    return growths.settled(growths.laid(growth, depth, 0, key, key, examples[key], 5, WHOLE, mask))


def depths(plot):
    """How far from its example's outline each pixel of a plot comes from, in pixels: (h, w), 0 outside."""
    names = show.sources(plot.region, WHOLE)
    held = np.pad(plot.region.exemplar.mask, 1)
    found = distance_transform_edt(held)[1:-1, 1:-1]
    out = np.zeros(names.shape)
    inside = names >= 0
    out[inside] = found[(names[inside] >> 16) - PAD, (names[inside] & 0xFFFF) - PAD]
    return out


def from_rim(plot, where):
    """The part of some pixels that come from the rim of the example."""
    assert where.sum() > 200
    return (depths(plot)[where] <= BAND).mean()


def has_rims(plot):
    """Along all of its outline a plot's pixels come from the rim, and well inside they do not."""
    within = distance_transform_edt(np.pad(masked(plot, WHOLE), 1))[1:-1, 1:-1]
    return from_rim(plot, (within > 0) & (within <= NEAR)) > 0.9 and from_rim(plot, within > DEEP) < 0.1


def near(inside, outside):
    """The pixels of one mask near to another."""
    return inside & (distance_transform_edt(~outside) <= NEAR)


@pytest.fixture(scope="module")
def before(examples):
    growth = stroked((), examples, "paper", FIRST)
    assert has_rims(growth[0])
    return growth


def test_over(before, examples):
    lower, upper = stroked(before, examples, "peel", SECOND, depth=1.0)
    assert lower is before[0]
    assert np.array_equal(masked(upper, WHOLE), SECOND)
    assert has_rims(upper)


def test_replace(before, examples):
    paper, peel = sorted(stroked(before, examples, "peel", SECOND), key=lambda plot: plot.key)
    assert np.array_equal(masked(paper, WHOLE), FIRST & ~SECOND)
    assert np.array_equal(masked(peel, WHOLE), SECOND)
    assert has_rims(paper)
    assert has_rims(peel)
    assert from_rim(paper, near(FIRST & ~SECOND, SECOND)) > 0.9
    assert from_rim(peel, near(SECOND, FIRST & ~SECOND)) > 0.9


def test_merge(before, examples):
    (joined,) = stroked(before, examples, "paper", SECOND)
    assert np.array_equal(masked(joined, WHOLE), FIRST | SECOND)
    assert has_rims(joined)
    within = distance_transform_edt(np.pad(FIRST | SECOND, 1))[1:-1, 1:-1] > DEEP
    for one, other in ((FIRST, SECOND), (SECOND, FIRST)):  # where the outline of one ran through the other
        assert from_rim(before[0], near(FIRST, ~FIRST) & within & SECOND) > 0.9
        assert from_rim(joined, near(one & other, ~one) & within) < 0.1


def test_eraser(before):
    hole = capsule(120, 80, 180, 80, 24)
    (left,) = growths.settled(growths.cut(before, 0, WHOLE, hole))
    assert np.array_equal(masked(left, WHOLE), FIRST & ~hole)
    assert has_rims(left)
    assert from_rim(left, near(FIRST & ~hole, hole)) > 0.9
    assert from_rim(before[0], near(FIRST & ~hole, hole)) < 0.1
