"""The numbers of an op as its loop wants them: parameters, colour matrices, ramps of colours."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np

from engine.brush import checks, tones
from engine.brush.ops import Chosen

_MOST = 9


def numbers(op: Chosen) -> np.ndarray:
    """Returns the op's numeric parameters in turn, float32 (9,), 0 where it has none."""
    out = np.zeros(_MOST, np.float32)
    for i, part in enumerate(part for part in (op.row.parameters if op.row else ()) if part.kind == "number"):
        out[i] = np.rint(op.parameters[part.name]) if part.whole else op.parameters[part.name]
    return out


@lru_cache(32)
def saturating(amount: float) -> np.ndarray:
    """Returns the matrix (3, 3), not to be written to, that multiplies what a colour differs from its grey by `amount`;
    brightness stays."""
    return amount * np.eye(3) + (1.0 - amount) * np.tile(np.array(tones.LUMA), (3, 1))


@lru_cache(32)
def turning(degrees: float) -> np.ndarray:
    """Returns the matrix (3, 3), not to be written to, that turns colours about the grey axis; brightness and greys
    stay."""
    angle = math.radians(degrees)
    cross = np.array([[0.0, -1.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 1.0, 0.0]]) / math.sqrt(3.0)
    grey = np.tile(np.array(tones.LUMA), (3, 1))
    turn = np.eye(3) * math.cos(angle) + math.sin(angle) * cross + (1.0 - math.cos(angle)) / 3.0
    chroma = np.eye(3) - grey
    out: np.ndarray = chroma @ turn @ chroma + grey
    return out


@lru_cache(32)
def ramp(stops: tuple[tuple[float, str], ...]) -> np.ndarray:
    """Returns the colours of a ramp at 1025 places from 0 to 1: float32 (1025, 3), not to be written to."""
    places = np.linspace(0.0, 1.0, tones.STEPS + 1)
    colours = np.array([checks.rgb(colour) for _, colour in stops])
    columns = [np.interp(places, [place for place, _ in stops], column) for column in colours.T]
    return np.ascontiguousarray(np.stack(columns, axis=1).astype(np.float32))
