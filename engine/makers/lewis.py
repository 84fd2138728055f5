"""Samples of texture from spectra and photographs (Lewis 1984, section 5), as texture commands describe them.

A sample travels as a picture: S as (S + 1) / 2 over alpha 1, grey where its three channels are equal.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np
from immutables import Map

from engine.checks.field_error import FieldError
from engine.files.fault import FileError
from engine.files.strict_json import Fields
from engine.makers import spectrum
from engine.numeric import impulse, spectra
from engine.numeric.arithmetic import LIBRARY
from engine.numeric.array_functions import array_functions
from engine.numeric.grid import snapped
from engine.painting.capture import PictureSource
from engine.painting.commands import SEED_LIMIT

SAMPLE_CAP = 1 << 22  # pixels of a sample that is made
GIVEN_CAP = 1 << 24  # of one that is given: its transform and its pyramid are held in memory
_SPREAD_CAP = 4.0
_STEP_SIZE, _LEAST_STEP, _LARGEST_STEP = (128, 128), 8, 512  # pixels of a step's sample
_NOTHING: Map[str, Any] = Map()
_PARTS = {**{name: name for name in spectra.PARTS}, "imag": "imaginary"}


@dataclass(frozen=True, slots=True)
class Sample:
    """`rgba`: premultiplied, float32 (4, h, w) on the grid.  `found`: what the maker chose where the members are
    silent."""

    rgba: np.ndarray
    found: Map[str, Any] = _NOTHING


class Pictures(Protocol):
    """Where examples come from, such as `capture.PictureSource`."""

    @property
    def arithmetic(self) -> int:
        """Gives the arithmetic in which what is made of them is worked out."""
        ...

    def picture(self, members: Fields) -> np.ndarray:
        """Reads the picture that members name: float32 (C, h, w)."""
        ...


Maker = Callable[[Fields, PictureSource], Sample]


def of_spectrum(members: Fields, place: PictureSource) -> Sample:
    """Returns an amplitude spectrum, from a picture or painted, becomes a sample (section 5.1)."""
    if "path" not in members and "rect" not in members:
        design = replace(spectrum.read(members.all()), arithmetic=place.arithmetic)
        return Sample(spectrum.spectrum_picture(spectrum.sample(spectrum.drawn(design, place.shape), design)))
    given = place.picture(members)
    height, width = given.shape[1:]
    _check_size(members, given)
    part = members.take("part", "real")
    if part not in _PARTS:
        raise members.fault("part", f"one of {', '.join(_PARTS)}")
    forward = members.flag("forward", False)
    phase = members.text("phase", spectrum.usual_phase(forward), cap=4096)
    seed = members.integer("seed", 0, lo=-SEED_LIMIT, hi=SEED_LIMIT)
    turns = np.full((1, height, width), 0.5, np.float32)
    if phase not in ("random", "zero"):
        turns, phase = _phases(members, place, (height, width)), "painted"
    loudness = _planes(given)  # premultiplied: what is transparent is silent
    design = spectrum.Design((width, height), phase=phase, seed=seed, part=_PARTS[part], forward=forward)
    design = replace(design, arithmetic=place.arithmetic)
    sheets = spectrum.Sheets(loudness if forward else spectra.symmetric(loudness), turns)
    return Sample(spectrum.spectrum_picture(spectrum.sample(sheets, design)))


def of_picture(members: Fields, place: PictureSource) -> Sample:
    """Returns a picture as it is, a step, or a spectrum's sample, to be scattered (section 5.2)."""
    if "step" in members:
        return _step(members)
    if "path" not in members and "rect" not in members:
        return of_spectrum(members, place)
    given = place.picture(members)
    _check_size(members, given)
    return Sample(_pictured(flattened(given, place.arithmetic)))


def _step(members: Fields) -> Sample:
    """Dark on the left and bright on the right: scattered, and turned at random, the plane breaks along straight lines
    (faulting, section 6.2).  `step`: how much of the width the edge between takes."""
    if "path" in members or "rect" in members:
        raise members.fault("step", "either a step or a picture")
    soft = members.number("step", lo=0.0, hi=1.0)
    width, height = members.integers("size", 2, _STEP_SIZE, limit=_LARGEST_STEP)
    if min(width, height) < _LEAST_STEP:
        raise members.fault("size", f"[width, height], each {_LEAST_STEP} to {_LARGEST_STEP}")
    across = np.arange(1, 2 * width, 2, dtype=np.float32) / np.float32(width) - np.float32(1.0)  # -1..1
    edge = max(np.float32(soft), np.float32(2.0 / width))
    t = np.clip(np.float32(0.5) + across / (np.float32(2.0) * edge), 0.0, 1.0)
    smooth = t * t * (np.float32(3.0) - np.float32(2.0) * t)
    return Sample(_pictured(np.broadcast_to(smooth, (1, height, width))))


def of_photograph(members: Fields, place: Pictures) -> Sample:
    """Windowed pieces of a photograph, averaged as spectra, become an impulse response (section 5.3).

    A coloured one keeps its mean colour, and its contrast as `spread`.
    """
    planes, own = flattened(place.picture(members), place.arithmetic), array_functions(place.arithmetic)
    window = members.integer("window", None, lo=1, hi=impulse.LARGEST)
    if window is None:
        window = impulse.suggested_window(planes, place.arithmetic)
    average = members.integer("average", 4, lo=1, hi=4096)
    phase = members.take("phase", "window")
    if phase not in impulse.PHASES:
        raise members.fault("phase", f"one of {', '.join(impulse.PHASES)}")
    seed = members.integer("seed", 0, lo=-SEED_LIMIT, hi=SEED_LIMIT)
    response = impulse.impulse_response(planes, window, average, phase, seed, place.arithmetic)
    found: dict[str, Any] = {"window": window, "average": average}
    means = np.full((1, 1, 1), 0.5, np.float32)
    if len(planes) == 3:
        means = own.mean(planes, axis=(1, 2), keepdims=True, dtype=np.float64).astype(np.float32)
        deviation = float(np.sqrt(own.mean(np.square(planes - means), dtype=np.float64)))
        found["spread"] = min(round(2.0 * deviation / spectra.SPREAD, 4), _SPREAD_CAP)
    return Sample(_pictured(_fitted(response, means)), Map(found))


def flattened(rgba: np.ndarray, arithmetic: int = LIBRARY) -> np.ndarray:
    """Red, green and blue of a premultiplied picture (4, h, w), or one plane if they are equal: float32.

    What is transparent takes the mean colour of the rest, so that it adds nothing to a texture.
    """
    own = array_functions(arithmetic)
    covered = max(float(own.mean(rgba[3], dtype=np.float64)), 1e-6)
    mean = own.mean(rgba[:3], axis=(1, 2), keepdims=True, dtype=np.float64).astype(np.float32) / np.float32(covered)
    return _planes(np.concatenate([rgba[:3] + (1.0 - rgba[3:]) * mean, rgba[3:]]))


def opaque_or_not(rgba: np.ndarray) -> np.ndarray:
    """Returns a premultiplied picture (4, h, w) as few planes as tell it: grey, RGB, or all four."""
    return rgba if (rgba[3] != 1.0).any() else _planes(rgba)


def _planes(rgba: np.ndarray) -> np.ndarray:
    grey = np.array_equal(rgba[0], rgba[1]) and np.array_equal(rgba[0], rgba[2])
    return rgba[:1] if grey else rgba[:3]


def _phases(members: Fields, place: PictureSource, size: tuple[int, int]) -> np.ndarray:
    """Returns the phases that a picture tells, 0..1 for -pi..pi, 1/2 where it is transparent: float32 (1, h, w)."""
    given = place.picture(Fields({"path": members.text("phase", cap=4096)}, ""))
    if given.shape[1:] != size:
        raise FieldError(
            "phase", f"a picture of {given.shape[2]} x {given.shape[1]}", f"{size[1]} x {size[0]}, as the amplitudes"
        )
    out: np.ndarray = given[:3].mean(axis=0, keepdims=True) + np.float32(0.5) * (1.0 - given[3:])
    return out


def _check_size(members: Fields, given: np.ndarray) -> None:
    height, width = given.shape[1:]
    if height * width > GIVEN_CAP:
        where = members.text("path", "rect", cap=4096)
        raise FileError(where, f"found {width} x {height} pixels, expected at most {GIVEN_CAP} for a sample")


def _fitted(response: np.ndarray, means: np.ndarray) -> np.ndarray:
    """A response of mean 0 laid around its means, as large as 0..1 has room for: one factor for all channels."""
    room = [
        (1.0 - mean) / max(plane.max(), 1e-9) if above else mean / max(-plane.min(), 1e-9)
        for plane, mean in zip(response, np.broadcast_to(means.reshape(-1), len(response)), strict=True)
        if np.ptp(plane) > 1e-6
        for above in (True, False)
    ]
    out: np.ndarray = response * np.float32(max(min(room, default=0.5), 1e-3)) + means
    return out


def _pictured(planes: np.ndarray) -> np.ndarray:
    """Returns planes (1 or 3, h, w) of 0..1 as an opaque picture (4, h, w) on the grid."""
    out = np.ones((4, *planes.shape[1:]), np.float32)
    out[:3] = np.clip(planes, 0.0, 1.0)
    return snapped(out)
