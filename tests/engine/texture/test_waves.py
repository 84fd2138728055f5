"""Stripes, Sawtooth and Squares: exact pixel averages at every depth, whatever the rectangle."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from engine.numeric.address import Rect
from engine.numeric.detail import parents
from engine.numeric.wave import UNIT
from engine.texture.procedural import Sawtooth, Squares, Stripes, White

KINDS = [Stripes, Sawtooth, Squares]
PERIODS = st.floats(2, 3000)
ANGLES = st.one_of(st.sampled_from([0.0, 90.0, 180.0, -90.0, 45.0, 1e-5, 89.99]), st.floats(-360, 360))
ORIGINS = st.one_of(st.integers(-300, 300), st.integers(-(2**90), 2**90))


def expand(p: np.ndarray) -> np.ndarray:
    """E of (h + 2, w + 2) in float64, by its definition."""
    out = np.empty((2 * p.shape[0] - 4, 2 * p.shape[1] - 4))
    c = p[1:-1, 1:-1]
    for r, v in enumerate((p[:-2], p[2:])):
        for s, h in enumerate((slice(0, -2), slice(2, None))):
            out[r::2, s::2] = (9 * c + 3 * v[:, 1:-1] + 3 * p[1:-1, h] + v[:, h]) / 16
    return out


def along_rows(texture, level: int, rect: Rect, n: int = 64) -> np.ndarray:
    """Pixel averages of a wave: exact integrals along x, n sample rows in y; the origin's place in exact integers."""
    wave = texture.wave(level)
    start = (wave.ux * rect.x0 + wave.uy * rect.y0 + wave.phase) % wave.period
    x = np.arange(rect.width)[None]
    y = ((np.arange(rect.height * n) + 0.5) / n)[:, None]
    left = (start + wave.ux * x + wave.uy * y) / wave.period
    width = wave.ux / wave.period

    def integral(t):
        f = t % 1.0
        return f - f * f if isinstance(texture, Sawtooth) else 0.5 - np.abs(f - 0.5)

    s = (integral(left + width) - integral(left)) / width
    return s.reshape(rect.height, n, rect.width).mean(1)


def sampled(texture, level: int, rect: Rect, n: int = 16) -> np.ndarray:
    """Pixel averages of a checkerboard by n x n samples."""
    wave = texture.wave(level)
    x = ((np.arange(rect.width * n) + 0.5) / n)[None]
    y = ((np.arange(rect.height * n) + 0.5) / n)[:, None]
    s = 1.0
    for w in (wave, wave.across()):
        start = (w.ux * rect.x0 + w.uy * rect.y0 + w.phase) % w.period
        s = s * np.where((start + w.ux * x + w.uy * y) / w.period % 1.0 < 0.5, 1.0, -1.0)
    return s.reshape(rect.height, n, rect.width, n).mean((1, 3))


@pytest.mark.parametrize("kind", [Stripes, Sawtooth])
@pytest.mark.parametrize("angle", [0, 180, -30, 3, 45, 89, 137.5, 200])
@pytest.mark.parametrize("period", [2, 5.7, 40, 300])
def test_average_against_integrals(kind, angle, period):
    rect = Rect.at(-57, 1033, 53, 41)
    for up in (0, 1, 4):
        texture = kind(5, period, angle, 0.3)
        error = texture.appearance(5 + up, rect)[0] - along_rows(texture, 5 + up, rect)
        assert np.sqrt((error**2).mean()) < 0.001
        assert np.abs(error).max() < 0.017  # near 90 degrees an edge may pass between two sample rows


@pytest.mark.parametrize("kind", [Stripes, Sawtooth])
def test_a_quarter_turn_transposes(kind):
    s = kind(0, 11.3, 0.0, 0.1).appearance(3, Rect.at(-5, 40, 30, 20))
    assert (kind(0, 11.3, 90.0, 0.1).appearance(3, Rect.at(40, -5, 20, 30)) == s.transpose(0, 2, 1)).all()


@pytest.mark.parametrize("angle", [0, 90, 3, 45, -30, 200])
@pytest.mark.parametrize("period", [2, 5.7, 40, 300])
def test_squares_against_supersampling(angle, period):
    """Along the axes Squares are exact, so only the samples' own error is left; turned, corners are off too."""
    rect = Rect.at(-57, 1033, 53, 41)
    for up in (0, 1, 4):
        texture = Squares(5, period, angle, 0.3)
        error = texture.appearance(5 + up, rect)[0] - sampled(texture, 5 + up, rect)
        assert np.sqrt((error**2).mean()) < 0.012 + 0.25 / (period * 2**up)
        assert np.abs(error).max() < 0.27


@settings(deadline=None, max_examples=60)
@given(st.sampled_from(KINDS), PERIODS, ANGLES, st.floats(0, 1), ORIGINS, ORIGINS, st.integers(0, 220), st.data())
def test_any_rectangle_holds_the_same_values(kind, period, angle, phase, x, y, up, data):
    texture = kind(-3, period, angle, phase)
    whole = Rect.at(x, y, 83, 70)
    a, b = sorted(data.draw(st.lists(st.integers(0, 83), min_size=2, max_size=2, unique=True)))
    c, d = sorted(data.draw(st.lists(st.integers(0, 70), min_size=2, max_size=2, unique=True)))
    part = Rect(x + a, y + c, x + b, y + d)
    rows, columns = part.slices(whole)
    level = -3 + up
    assert (texture.appearance(level, part) == texture.appearance(level, whole)[:, rows, columns]).all()
    big, small = texture.bandpass(level, whole), texture.bandpass(level, part)
    inner = None if big is None else big[:, rows, columns]
    if small is None:
        assert inner is None or not inner.any()
    else:
        assert small.any()
        assert (small == inner).all()
        assert small.dtype == np.float32
        assert small.flags.c_contiguous


@settings(deadline=None, max_examples=60)
@given(st.sampled_from(KINDS), PERIODS, ANGLES, st.floats(0, 1), ORIGINS, ORIGINS, st.integers(1, 220))
@example(Sawtooth, 2.0, 0.0, 0.0, 1 << 21, 0, 38)  # where the distance to a far edge is cut short
@example(Sawtooth, 2.0, 45.0, 0.5, 0, 4, 39)  # half way between two jumps
def test_bandpass_is_what_expand_leaves_out(kind, period, angle, phase, x, y, up):
    texture = kind(2, period, angle, phase)
    rect = Rect.at(x, y, 40, 36).evened()
    s = texture.appearance(2 + up, rect)[0].astype(np.float64)
    coarse = texture.appearance(1 + up, parents(rect))[0].astype(np.float64)
    found = texture.bandpass(2 + up, rect)
    found = 0.0 if found is None else found[0]
    assert np.abs(s - expand(coarse) - found).max() < 3e-6


@settings(deadline=None, max_examples=20)
@given(st.sampled_from(KINDS), PERIODS, ANGLES, st.floats(0, 1), st.integers(-(2**40), 2**40), st.integers(-99, 99))
def test_a_cascade_of_24_levels_reproduces_s(kind, period, angle, phase, x, y):
    texture = kind(0, period, angle, phase)
    rects = [Rect.at((x << 24) + 12345678, (y << 24) - 7654321, 24, 20).evened()]
    for _ in range(24):
        rects.append(parents(rects[-1]).evened())
    values = texture.appearance(0, rects[24])[0].astype(np.float64)
    for level in range(1, 25):
        rect, above = rects[24 - level], rects[25 - level]
        rows, columns = parents(rect).slices(above)
        values = expand(values[rows, columns])
        detail = texture.bandpass(level, rect)
        if detail is not None:
            values = values + detail[0]
    assert np.abs(values - texture.appearance(24, rects[0])[0]).max() < 1e-5


def on_edge(texture, level: int, axis: int, spread: int = 12) -> Rect:
    """A rectangle around an edge far from the origin, found by walking t to a multiple of the cell."""
    wave = texture.wave(level)
    wave, cell = texture.edges(wave)[0]
    step = (wave.ux, wave.uy)[axis]
    target = (wave.at(0, 0) // cell + 3) * cell
    place = (target - wave.at(0, 0)) // step
    corner = [7, 7]
    corner[axis] = place
    return Rect(corner[0] - spread, corner[1] - spread, corner[0] + spread, corner[1] + spread)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("period", [64, 77.7])
@pytest.mark.parametrize("level", [0, 1, 2, 5, 17, 40, 90, 200])
def test_edges_are_one_pixel_wide_at_every_depth(kind, period, level):
    texture = kind(0, period, 0.0, 0.21)
    row = texture.appearance(level, on_edge(texture, level, 0))[0, 0].astype(np.float64)
    jumps = np.abs(np.diff(row))
    ramp = 2.1 / (period * 2**level) + 1e-6 if kind is Sawtooth else 1e-6
    assert np.ptp(row) > 1.9 - 24 * ramp
    assert (jumps > ramp).sum() in (1, 2)  # one intermediate pixel at most
    assert texture.bandpass(level, on_edge(texture, level, 0)) is not None or level == 0


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("angle", [10.0, 30.0, 44.0])
@pytest.mark.parametrize("level", [2, 9, 40, 200])
def test_turned_edges_are_two_pixels_wide_along_a_scan_line(kind, angle, level):
    texture = kind(0, 50.0, angle, 0.4)
    row = texture.appearance(level, on_edge(texture, level, 0))[0, 12].astype(np.float64)
    ramp = 2.1 / (50 * 2**level) + 1e-6 if kind is Sawtooth else 1e-6
    assert (np.abs(np.diff(row)) > ramp).sum() in (1, 2, 3)


@pytest.mark.parametrize("kind", KINDS)
def test_far_from_edges_there_is_nothing_to_add(kind):
    texture = kind(0, 100.0, 20.0)
    place = 30 << 80, 12 << 80
    assert texture.bandpass(80, Rect.at(*place, 1920, 1080)) is None
    assert texture.bandpass(0, Rect.at(0, 0, 64, 64)) is None
    assert texture.bandpass(-5, Rect.at(0, 0, 64, 64)) is None


def test_orientation_and_sign():
    """Angle 0 varies along x, beginning with +1; the angle turns clockwise as seen, y pointing down."""
    rect = Rect.at(0, 0, 16, 16)
    stripes = Stripes(0, 16.0).appearance(0, rect)[0]
    assert (stripes == np.where(np.arange(16) < 8, 1, -1)).all()
    assert (Stripes(0, 16.0, 90.0).appearance(0, rect)[0] == stripes.T).all()
    assert (Stripes(0, 16.0, 360.0).appearance(0, rect)[0] == stripes).all()
    assert (Stripes(0, 16.0, 0.0, 0.5).appearance(0, rect)[0] == -stripes).all()
    squares = Squares(0, 16.0).appearance(0, rect)[0]
    assert (squares == stripes * stripes.T).all()
    saw = Sawtooth(0, 16.0).appearance(0, rect)[0]
    assert (saw == 1 - (2 * np.arange(16) + 1) / 16).all()
    assert Stripes(0, 16.0, 30.0).wave(0).ux > Stripes(0, 16.0, 30.0).wave(0).uy > 0
    assert Stripes(0, 16.0, 270.0).wave(0).uy == -UNIT


def test_white_is_one_and_adds_nothing():
    assert (White(3).appearance(9, Rect.at(5, 5, 4, 3)) == np.ones((1, 3, 4))).all()
    assert White(3).bandpass(9, Rect.at(5, 5, 4, 3)) is None


@pytest.mark.parametrize("kind", KINDS)
def test_no_appearance_above_the_base(kind):
    with pytest.raises(ValueError, match="coarser than the base level 4"):
        kind(4, 8.0).appearance(3, Rect.at(0, 0, 4, 4))
