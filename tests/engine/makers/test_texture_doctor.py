"""The texture doctor: kinds of textures that are known beforehand, gradients put in and taken out, advice."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.checks.field_error import FieldError
from engine.makers.doctor.apartness import likeness
from engine.makers.doctor.examining import advised, examined, kinds_of
from engine.makers.doctor.flattening import evened, gradients
from engine.makers.doctor.measuring import Grain, grain_of
from engine.makers.doctor.trying import TRIED
from engine.numeric.address import Rect
from engine.texture.table import instance

SIDE = 96


def rock(side=SIDE, seed=3):
    """Grain that is the same all over: (1, side, side)."""
    found = instance("rock", {"period": 12, "seed": seed}, 0, 0).appearance(0, Rect.at(0, 0, side, side))
    return np.clip(0.5 + 0.5 * found, 0.0, 1.0).astype(np.float32)


def pebbles(side=SIDE + 16):
    """Round things of many sizes, lit from one side."""
    rng, count = np.random.default_rng(4), side * side // 40
    out, near = np.full((side, side), 0.2), np.arange(-8, 9)
    for cy, cx, r in zip(*rng.uniform(8, side - 9, (2, count)), rng.uniform(3, 8, count), strict=True):
        part = out[int(cy) - 8 : int(cy) + 9, int(cx) - 8 : int(cx) + 9]
        inside = near[:, None] ** 2 + near**2 < r**2
        part[inside] = (0.55 + 0.35 * near / r + np.zeros((17, 1)))[inside]
    return np.ascontiguousarray(out[None, 8:-8, 8:-8], np.float32)


def bricks(wide=24, high=12, side=SIDE):
    y, x = np.mgrid[:side, :side]
    course = y // high
    joint = (y % high < 2) | ((x + course % 2 * wide // 2) % wide < 2)
    return np.where(joint, 0.9, 0.35)[None].astype(np.float32)


def lines_along(angle, side=SIDE):
    """Grain drawn out along an angle in degrees."""
    y, x = np.mgrid[:side, :side]
    across = x * np.sin(np.radians(angle)) - y * np.cos(np.radians(angle))
    waves = sum(np.sin(across / f + p) for f, p in ((1.7, 0.0), (2.9, 2.0), (4.1, 4.0), (1.13, 1.0)))
    return (0.5 + 0.1 * waves)[None].astype(np.float32)


def last(work):
    *_, found = work
    return found


@pytest.mark.parametrize(
    ("picture", "kind"),
    [(rock(), "stochastic"), (pebbles(), "structured"), (bricks(), "quasi-periodic"), (lines_along(30), "directional")],
    ids=["rock", "pebbles", "bricks", "lines"],
)
def test_what_a_picture_is(picture, kind):
    assert kind in kinds_of(grain_of(picture))


def test_two_halves_that_differ_are_no_texture():
    picture = np.concatenate([rock(), 0.1 * rock(seed=5)], axis=2)
    assert kinds_of(grain_of(picture))[0] == "inhomogeneous"


@settings(max_examples=12, deadline=None)
@given(wide=st.sampled_from([16, 20, 24]), high=st.sampled_from([6, 8, 10]))
def test_periods_are_those_of_the_bricks(wide, high):
    """The nearest place that looks the same is a course lower and half a brick aside, or two courses lower."""
    found = grain_of(bricks(wide, high)).periods
    near = min(np.hypot(high, wide / 2), 2 * high, wide)
    assert found
    assert found[0].length == pytest.approx(near, abs=1.0)
    assert len(found) == 1 or 20 < abs(found[0].angle - found[1].angle) < 160


@settings(max_examples=12, deadline=None)
@given(angle=st.integers(0, 179))
def test_the_direction_is_that_of_the_lines(angle):
    found = grain_of(lines_along(angle)).angle
    assert found is not None
    assert abs((found - angle + 90) % 180 - 90) < 4


def test_light_that_falls_off_is_taken_out():
    lit = rock() * np.linspace(0.25, 1.0, SIDE, dtype=np.float32)
    found = gradients(lit)
    assert found.light > 0.3
    assert gradients(rock()).light == 0.0
    flat = evened(lit, found)
    assert gradients(flat).light == 0.0
    assert abs(float(flat[..., : SIDE // 3].mean() / flat[..., -SIDE // 3 :].mean()) - 1.0) < 0.1


def slanted(far, side=128):
    """A plane of pebbles as seen from a side: the upper end is `far` times as large as the lower."""
    whole, out = pebbles(4 * side + 16)[0], np.empty((side, side), np.float32)
    for row in range(side):
        near = far + (1.0 - far) * row / (side - 1)
        y = int((1.0 / near - 1.0) * side * far / (1.0 - far) * 1.5) % len(whole)
        x = 2 * side + (np.arange(8 * side) / 8 - side / 2) / near
        out[row] = whole[y, x.astype(int)].reshape(side, 8).mean(axis=1)
    return out[None]


def test_a_slant_is_found_and_set_upright():
    found = gradients(slanted(0.4))
    assert found.slant == "up"
    assert found.nearer > 1.4
    assert gradients(pebbles(144)).slant == ""
    assert gradients(np.ascontiguousarray(np.rot90(slanted(0.4), 2, (1, 2)))).slant == "down"
    upright = evened(slanted(0.4), found)
    assert gradients(upright).nearer < found.nearer


def test_nothing_is_as_like_an_example_as_itself():
    example = pebbles()
    own, others = last(likeness(example, example)), last(likeness(example, rock()))
    assert own.apart < 1e-3
    assert own.copied == 1.0
    assert others.apart > 0.3
    assert others.copied < 0.05


def test_pebbles_are_to_be_kept_as_objects_are():
    report = last(examined(pebbles()))
    assert report.advice in ("objects", "full")
    assert {trial.way for trial in report.trials} == set(TRIED)
    assert all(trial.colours.shape == (1, SIDE, SIDE) and np.isfinite(trial.colours).all() for trial in report.trials)
    far = {trial.way: trial.likeness.apart for trial in report.trials}
    assert far["objects"] < far["histograms"]
    assert "thing" in report.why


def test_reports_come_while_it_works():
    reports = [report for report in examined(rock(48)) if report is not None]
    assert [len(report.trials) for report in reports] == [*range(len(TRIED) + 1), len(TRIED)]
    assert all(not report.advice for report in reports[:-1])
    assert reports[-1].advice in ("scattered", "histograms", "statistics")


SHAPES = [(1, 8, 8), (3, 1, 200), (4, 30, 20), (1, 16, 16), (3, 1, 1)]


@pytest.mark.parametrize("shape", SHAPES, ids=str)
@pytest.mark.parametrize("filled", ["grain", "one", "two"])
def test_any_picture_gets_advice(shape, filled):
    rng = np.random.default_rng(2)
    values = {"grain": rng.random(shape), "one": np.full(shape, 0.5), "two": rng.integers(0, 2, shape)}[filled]
    picture = values.astype(np.float32)
    if len(picture) == 4:
        picture[:3] *= picture[3]
    for flat in (False, True):
        report = last(examined(picture, flat=flat))
        assert report.advice in (*TRIED, "paper", "colour")
        assert report.why.endswith(".")


def test_what_is_transparent_all_over_is_refused():
    with pytest.raises(FieldError, match="nothing but transparency"):
        next(examined(np.zeros((4, 32, 32), np.float32)))


def test_every_kind_gets_advice_whatever_else_it_is():
    reports = [report for report in examined(rock(32)) if report is not None]
    trials = {trial.way: trial for trial in reports[-1].trials}
    for structure, periods, angle, uneven in itertools.product(
        (0.0, 0.08, 0.4), (True, False), (None, 20.0), (0.0, 0.9)
    ):
        grain = Grain(False, structure, grain_of(bricks()).periods if periods else (), angle, 0.5, uneven, 0.0)
        report = reports[0].__class__(reports[0].example, grain, reports[0].gradients, kinds_of(grain))
        advice, why = advised(report, trials, False)
        assert advice in TRIED
        assert why.endswith(".")
