"""The numbers of an op as its loop wants them: parameters, colour matrices, ramps of colours."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from engine.brush import checks, tones
from engine.brush.ops import Chosen
from engine.numeric.arithmetic import LIBRARY
from engine.numeric.curves import smooth_curve
from engine.numeric.functions import functions

_MOST = 9


def numbers(op: Chosen) -> np.ndarray:
    """Returns the op's numeric parameters in turn, float32 (9,), 0 where it has none."""
    out = np.zeros(_MOST, np.float32)
    for i, part in enumerate(part for part in (op.row.parameters if op.row else ()) if part.kind == "number"):
        out[i] = np.rint(op.parameters[part.name]) if part.whole else op.parameters[part.name]
    return out


@lru_cache(64)
def tone_table(knots: tuple[tuple[float, float], ...]) -> np.ndarray:
    """Returns the tones that a curve through knots makes of 0, 1/1024, ..., 1: float32 (1025,), not to be written
    to."""
    values = smooth_curve(knots, np.arange(tones.STEPS + 1) / tones.STEPS)
    out: np.ndarray = np.clip(values, 0.0, 1.0).astype(np.float32)
    out.flags.writeable = False
    return out


@lru_cache(32)
def saturating(amount: float) -> np.ndarray:
    """Returns the matrix (3, 3), not to be written to, that multiplies what a colour differs from its grey by `amount`;
    brightness stays."""
    return amount * np.eye(3) + (1.0 - amount) * np.tile(np.array(tones.LUMA), (3, 1))


@lru_cache(32)
def turning(degrees: float, arithmetic: int = LIBRARY) -> np.ndarray:
    """Returns the matrix (3, 3), not to be written to, that turns colours about the grey axis; brightness and greys
    stay."""
    own, angle = functions(arithmetic), math.radians(degrees)
    cos, sin = own.cos(angle), own.sin(angle)
    cross = np.array([[0.0, -1.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 1.0, 0.0]]) / math.sqrt(3.0)
    grey = np.tile(np.array(tones.LUMA), (3, 1))
    turn = np.eye(3) * cos + sin * cross + (1.0 - cos) / 3.0
    chroma = np.eye(3) - grey
    if arithmetic == LIBRARY:
        out: np.ndarray = chroma @ turn @ chroma + grey
        return out
    everywhere: np.ndarray = _times(_times(chroma, turn), chroma) + grey
    return everywhere


@lru_cache(32)
def recolouring(degrees: float, amount: float, arithmetic: int = LIBRARY) -> np.ndarray:
    """Returns the matrix (3, 3), not to be written to, that turns colours, then saturates them."""
    return _times(saturating(amount), turning(degrees, arithmetic))


def _times(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Returns the product of two matrices (3, 3), its sums in order: the same bits everywhere."""
    out: np.ndarray = a[:, :1] * b[:1] + a[:, 1:2] * b[1:2] + a[:, 2:] * b[2:]
    return out


@lru_cache(32)
def ramp(stops: tuple[tuple[float, str], ...]) -> np.ndarray:
    """Returns the colours of a ramp at 1025 places from 0 to 1: float32 (1025, 3), not to be written to."""
    places = np.linspace(0.0, 1.0, tones.STEPS + 1)
    colours = np.array([checks.rgb(colour) for _, colour in stops])
    columns = [np.interp(places, [place for place, _ in stops], column) for column in colours.T]
    return np.ascontiguousarray(np.stack(columns, axis=1).astype(np.float32))
