"""How a brush's settings follow the pen: value = setting * curve(pressure), curves piecewise linear."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from engine.brush.checks import Knots
from engine.brush.settings import SETTINGS, Brush, Curve
from engine.numeric.kernel import Array, kernel

DYNAMIC = ("radius", "opacity", "flow", "hardness", "spacing")

_PRESSURE = ((0.0, 0.0), (1.0, 1.0))
_STEADY = ((0.0, 1.0),)
_BRUSHES = 1024  # whose responses are kept


class Response(NamedTuple):
    """A brush's dynamic settings for the compiled walk, in the order of DYNAMIC.

    `values`, `lo`, `hi`: float64 (5,); `inputs`, `outputs`: knots, float64 (5, k); `counts`: int64 (5,), how many of
    the k are used.
    """

    values: np.ndarray
    lo: np.ndarray
    hi: np.ndarray
    inputs: np.ndarray
    outputs: np.ndarray
    counts: np.ndarray


def knots_of(curve: Curve | Mapping[str, Knots] | None) -> Knots:
    """Returns the knots of a curve of pressure; None is the constant 1, and so is what follows other inputs alone."""
    if isinstance(curve, Mapping):
        curve = curve.get("pressure")
    if curve is None:
        return _STEADY
    return _PRESSURE if isinstance(curve, str) else curve


def most_of(curve: Curve | Mapping[str, Knots] | None) -> float:
    """Returns the highest factor that the curves of a setting give."""
    every = curve.values() if isinstance(curve, Mapping) else (knots_of(curve),)
    return math.prod(max(value for _, value in knots) for knots in every)


def evaluate(curve: Curve | Mapping[str, Knots] | None, pressure: np.ndarray) -> np.ndarray:
    """Returns the factor that a curve gives at each pressure: float64, of the shape of `pressure`."""
    inputs, outputs = np.array(knots_of(curve), np.float64).T
    out: np.ndarray = np.interp(pressure, inputs, outputs)
    return out


@lru_cache(_BRUSHES)
def response(brush: Brush) -> Response:
    """Returns what the walk along a stroke needs to know of a brush: not to be written to."""
    rows = [SETTINGS[name] for name in DYNAMIC]
    knots = [knots_of(brush.dynamics.get(name)) for name in DYNAMIC]
    table = np.zeros((2, len(knots), max(map(len, knots))))
    for i, pairs in enumerate(knots):
        table[:, i, : len(pairs)] = np.array(pairs, np.float64).T
    return Response(
        np.array([getattr(brush, name) for name in DYNAMIC], np.float64),
        np.array([row.lo for row in rows], np.float64),
        np.array([row.hi for row in rows], np.float64),
        table[0].copy(),
        table[1].copy(),
        np.array([len(pairs) for pairs in knots], np.int64),
    )


@kernel
def respond(
    values: Array, lo: Array, hi: Array, inputs: Array, outputs: Array, counts: Array, pressure: float, into: Array
) -> None:
    """Writes the settings at one pressure into `into`, float64 (5,), each clamped to its range."""
    for i in range(values.shape[0]):
        n = counts[i]
        k = 0
        while k < n and inputs[i, k] < pressure:
            k += 1
        if k == 0:
            factor = outputs[i, 0]
        elif k == n:
            factor = outputs[i, n - 1]
        else:
            part = (pressure - inputs[i, k - 1]) / (inputs[i, k] - inputs[i, k - 1])
            factor = outputs[i, k - 1] + (outputs[i, k] - outputs[i, k - 1]) * part
        into[i] = min(max(values[i] * factor, lo[i]), hi[i])
