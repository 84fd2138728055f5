"""A picture is examined: measured, made into a texture in every way, and the way that suits it is named."""

from __future__ import annotations

import time
from collections.abc import Generator, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from engine.checks.field_error import FieldError
from engine.makers.doctor.apartness import Likeness, likeness
from engine.makers.doctor.flattening import Gradients, evened, gradients
from engine.makers.doctor.measuring import Grain, grain_of
from engine.makers.doctor.trying import TRIED
from engine.makers.heeger_bergen import part_looked_at

_LOOKED_AT = 256  # pixels along the sides of what is looked at, and of what is made
_LEAST = 16  # pixels along them
_OBJECTS, _GRAIN = 0.12, 0.04  # of `Grain.structure`: above it are things, below it is even grain
_NEAR = 1.25  # times as far off as another: as good
_WHOLE = 1.6  # times as far off: as good, where joints of bricks or threads go on
_CLEAR, _RIMMED = 0.5, 0.02  # alpha below which a pixel is outside; the part of them that makes a rim
_COPIES = 0.1  # of the patches: so many are seen


@dataclass(frozen=True, slots=True, eq=False)
class Trial:
    """One way: what it made (C, h, w), in how many seconds, and how like the example; or what it found to be amiss."""

    way: str
    colours: np.ndarray | None
    seconds: float
    likeness: Likeness | None
    fault: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Report:
    """`example`: the part that was looked at, without the gradients that were found, if it was to be `flat`; `kinds`:
    of stochastic, quasi-periodic, directional, inhomogeneous, structured, those that it is, the most telling first;
    `advice`: one of TRIED, "" while there are trials to come, "paper" or "colour" where a texture would not do; `why`:
    a sentence."""

    example: np.ndarray
    grain: Grain
    gradients: Gradients
    kinds: tuple[str, ...]
    trials: tuple[Trial, ...] = ()
    advice: str = ""
    why: str = ""


def examined(picture: np.ndarray, seed: int = 0, flat: bool = False) -> Iterator[Report | None]:
    """Yields None after each piece of work, and a report after each way that was tried; the last has the advice.

    `picture`: float32 (1, 3 or 4, h, w) in 0..1.  `flat`: gradients that are found are taken out first.  FieldError
    where there is nothing to look at.
    """
    if len(picture) == 4 and not picture[3].any():
        raise FieldError("picture", "nothing but transparency", "a picture")
    picture = part_looked_at(picture)
    found = gradients(picture)
    picture = evened(picture, found) if flat else picture
    example = middle_of(picture)
    yield None
    grain = grain_of(example)
    report = Report(example, grain, found, kinds_of(grain))
    yield report
    size = max(example.shape[1], _LEAST), max(example.shape[2], _LEAST)
    trials: tuple[Trial, ...] = ()
    if not grain.flat and min(example.shape[1:]) >= _LEAST:
        for way in TRIED:
            trial = yield from _tried(way, example, size, seed)
            trials = *trials, trial
            yield Report(example, grain, found, report.kinds, trials)
    advice, why = advised(report, {trial.way: trial for trial in trials}, flat)
    yield Report(example, grain, found, report.kinds, trials, advice, why)


def middle_of(picture: np.ndarray) -> np.ndarray:
    """Returns the middle of a picture, as large as is looked at."""
    top, left = (max(0, (n - _LOOKED_AT) // 2) for n in picture.shape[1:])
    return np.ascontiguousarray(picture[:, top : top + _LOOKED_AT, left : left + _LOOKED_AT])


def kinds_of(grain: Grain) -> tuple[str, ...]:
    """Names what a picture is, the most telling first."""
    if grain.flat:
        return ()
    found = {
        "inhomogeneous": grain.inhomogeneous,
        "quasi-periodic": bool(grain.periods),
        "structured": grain.structure > _OBJECTS,
        "directional": grain.angle is not None,
    }
    return tuple(name for name, holds in found.items() if holds) or ("stochastic",)


def _tried(way: str, example: np.ndarray, size: tuple[int, int], seed: int) -> Generator[None, None, Trial]:
    taken, colours = 0.0, None
    work = TRIED[way].make(example, size, seed)
    while colours is None:
        began = time.perf_counter()
        try:
            colours = next(work)
        except FieldError as error:
            return Trial(way, None, taken, None, f"found {error.found}, expected {error.expected}")
        taken += time.perf_counter() - began
        yield
    found = None
    for found in likeness(example, colours):
        if found is None:
            yield
    return Trial(way, colours, taken, found)


def advised(report: Report, trials: Mapping[str, Trial], flat: bool) -> tuple[str, str]:
    """Returns the way that suits a picture, and why, in a sentence."""
    grain, kinds = report.grain, report.kinds
    likenesses = {name: trial.likeness for name, trial in trials.items() if trial.likeness is not None}
    if grain.flat:
        return "colour", "It is of one colour: a plain colour does the same."
    if not likenesses:
        height, width = report.example.shape[1:]
        return "paper", f"{width} x {height} pixels are too few to learn from: as a paper it stays as it is."
    if len(report.example) == 4 and float((report.example[3] < _CLEAR).mean()) > _RIMMED:
        return "grown", "Part of it is transparent: it has a rim, which it keeps when it is grown as an example."
    lit = "" if flat or not report.gradients.light else " Light falls off over it: set it straight first."
    if "inhomogeneous" in kinds:
        return "grown", (
            "One part of it is unlike another, and a texture is the same all over: grown as an example, its parts stay "
            f"together.{lit}"
        )
    if "quasi-periodic" in kinds:
        best = min(("objects", "full", "grown"), key=lambda name: _apart(likenesses, name))
        if _apart(likenesses, "pieces") < _WHOLE * _apart(likenesses, best):
            best = "pieces"
        length = grain.periods[0].length
        return (
            best,
            f"It repeats every {length:.0f} px: its layout has to be kept, and {_named(best)} keeps it best.{lit}",
        )
    if "structured" in kinds:
        return _of_things(likenesses, lit)
    if grain.structure > _GRAIN or _apart(likenesses, "histograms") > _NEAR * _apart(likenesses, "statistics"):
        how = "lines in it go on" if grain.angle is not None else "edges in it go on"
        return (
            "statistics",
            f"It has no things to keep, but {how} from fine to coarse: statistics keep that, and copy nothing.{lit}",
        )
    if _apart(likenesses, "scattered") < _NEAR * _apart(likenesses, "histograms"):
        return "scattered", f"It is even grain: scattered, it never repeats, and is as like it as all else.{lit}"
    return "histograms", f"It is even grain: histograms are enough, and the soonest made.{lit}"


def _of_things(likenesses: Mapping[str, Likeness], lit: str) -> tuple[str, str]:
    whole, things = likenesses.get("full"), likenesses.get("objects")
    if things is None:
        return "statistics", f"There are things in it, but it is too small to keep them.{lit}"
    if whole is None or things.apart < 2.0 * whole.apart or whole.copied > _COPIES:
        less = (
            ""
            if whole is None or whole.copied - things.copied < 0.02
            else f", not {whole.copied:.0%} as the full layout"
        )
        return "objects", f"There are things in it, and objects keep them; {things.copied:.0%} is copied{less}.{lit}"
    return "full", f"There are things in it with fine detail, which only the full layout keeps.{lit}"


def _apart(likenesses: Mapping[str, Likeness], name: str) -> float:
    return likenesses[name].apart if name in likenesses else 1e9


def _named(way: str) -> str:
    return {
        "full": "the full layout",
        "objects": "objects",
        "pieces": "a layout of large pieces",
        "grown": "growing it as an example",
    }[way]
