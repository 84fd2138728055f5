"""Shapes to begin a spectrum with: ring, wedge, grid of points, 1/f noise (Lewis 1984, section 5.1).

Each is drawn as a centred amplitude spectrum, 0..1; frequencies are parts of the highest, half a cycle per pixel, so
that a shape means the same texture on samples of any size.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from engine.numeric.arithmetic import LIBRARY
from engine.numeric.array_functions import ArrayFunctions, array_functions
from engine.numeric.spectra import frequencies, symmetric

Numbers = Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Quantity:
    """A number of a shape: `lo` <= value <= `hi`."""

    name: str
    default: float
    lo: float
    hi: float
    unit: str
    tooltip: str


@dataclass(frozen=True, slots=True)
class Shape:
    """A row: `draw` makes the amplitudes, float32 (h, w), of ((h, w), the numbers by name, the functions
    of an arithmetic)."""

    name: str
    label: str
    tooltip: str
    parameters: tuple[Quantity, ...]
    draw: Callable[[tuple[int, int], Numbers, ArrayFunctions], np.ndarray]


def _polar(size: tuple[int, int], own: ArrayFunctions) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Frequency, 0..1.41, and the horizontal and vertical part of it."""
    v, u = frequencies(*size)
    return own.distance(u, v), u, v


def _bell(distance: np.ndarray, width: float, own: ArrayFunctions) -> np.ndarray:
    return own.exp(-0.5 * np.square(distance / np.float32(max(width, 1e-6))))


def _step(size: tuple[int, int]) -> float:
    """Returns the width of one pixel of a spectrum: nothing narrower can be drawn."""
    return 2.0 / max(*size, 1)


def _direction(degrees: float, own: ArrayFunctions) -> tuple[np.float64, np.float64]:
    """Returns the cosine and the sine of an angle."""
    turn = np.array([np.radians(degrees)])
    return own.cos(turn)[0], own.sin(turn)[0]


def _ring(size: tuple[int, int], given: Numbers, own: ArrayFunctions) -> np.ndarray:
    f, _, _ = _polar(size, own)
    return _bell(f - given["frequency"], max(given["width"], 0.4 * _step(size)), own)


def _wedge(size: tuple[int, int], given: Numbers, own: ArrayFunctions) -> np.ndarray:
    f, u, v = _polar(size, own)
    cos, sin = _direction(given["angle"], own)
    along, across = u * cos + v * sin, v * cos - u * sin
    off = np.degrees(own.arctan2(np.abs(across), np.abs(along)))
    soft = 0.5 * _step(size)
    inside = 1.0 / (1.0 + own.exp(np.clip((np.abs(f - given["from"]) - (f - given["from"])) / soft, 0.0, 60.0)))
    beyond = np.maximum(f - given["to"], 0.0)
    fall = own.powers(np.maximum(f, _step(size)) / _step(size), -given["slope"])
    out: np.ndarray = 2.0 * inside * _bell(off, given["spread"], own) * _bell(beyond, 2.0 * soft, own) * fall
    return out


def _points(size: tuple[int, int], given: Numbers, own: ArrayFunctions) -> np.ndarray:
    v, u = frequencies(*size)
    (cos, sin), spacing = _direction(given["angle"], own), given["spacing"]
    total = np.zeros(size, np.float32)
    reach = int(1.5 / spacing)
    # Bells wider than two spacings would leave no pattern of the points, and take long: that is as wide as they get.
    width = max(min(given["width"], 2.0 * spacing * max(1.0, given["aspect"])), 0.4 * _step(size))
    for j in range(reach + 1):  # `drawn` adds the other half
        for i in range(-reach, reach + 1):
            if (j, i) <= (0, 0):
                continue
            x = (i * cos - j * sin) * spacing
            y = (i * sin + j * cos) * spacing * given["aspect"]
            if max(abs(x), abs(y)) > 1.0:
                continue
            far = own.distance(np.array([float(i)]), np.array([float(j)]))[0]
            strength = own.single.power(far, -given["fall"])
            _add_bell(total, u[0], v[:, 0], (x, y, width, strength), own)
            if max(abs(x), abs(y)) > 1.0 - 5.0 * width:  # cut off at the highest frequency, unlike its opposite
                _add_bell(total, u[0], v[:, 0], (-x, -y, width, strength), own)
    return total


def _add_bell(
    total: np.ndarray, u: np.ndarray, v: np.ndarray, bell: tuple[float, float, float, float], own: ArrayFunctions
) -> None:
    """Lays a bell (x, y, width, height) where it is not zero; the larger value stays."""
    x, y, width, height = bell
    rows = slice(*np.searchsorted(v, (y - 5.0 * width, y + 5.0 * width)))
    columns = slice(*np.searchsorted(u, (x - 5.0 * width, x + 5.0 * width)))
    part = total[rows, columns]
    drawn = np.outer(_bell(v[rows] - y, width, own), _bell(u[columns] - x, width, own)) * height
    np.maximum(part, drawn, out=part, casting="same_kind")


def _noise(size: tuple[int, int], given: Numbers, own: ArrayFunctions) -> np.ndarray:
    f, _, _ = _polar(size, own)
    low = max(given["from"], _step(size))
    fall = own.powers(np.maximum(f, low) / low, -given["b"])
    below = _bell(np.maximum(given["from"] - f, 0.0), 0.5 * max(given["from"], _step(size)), own)
    out: np.ndarray = fall * below * _bell(np.maximum(f - given["to"], 0.0), 2.0 * _step(size), own)
    return out


_STRENGTH = Quantity("strength", 1.0, 0.0, 1.0, "", "How strongly the shape is laid into the spectrum")
_ANGLE = Quantity("angle", 0.0, -180.0, 180.0, "degrees", "Direction of the frequencies, clockwise from rightwards")
_LOW = Quantity("from", 0.02, 0.0, 1.0, "of the highest", "Frequencies below are left out: the largest features")
_HIGH = Quantity("to", 1.0, 0.0, 1.5, "of the highest", "Frequencies above are left out: the finest features")
_WIDTH = Quantity("width", 0.05, 0.0, 1.0, "of the highest", "Breadth: narrow is regular, wide is loose")

_ROWS = (
    Shape(
        "ring",
        "Ring",
        "One size of feature in all directions: pebbles, sponge, orange peel",
        (Quantity("frequency", 0.25, 0.0, 1.4, "of the highest", "Fineness of the features"), _WIDTH, _STRENGTH),
        _ring,
    ),
    Shape(
        "wedge",
        "Wedge",
        "Features drawn out across one direction: fur, wood, water, brushed metal",
        (
            _ANGLE,
            Quantity("spread", 12.0, 0.5, 90.0, "degrees", "Opening: narrow is straight, wide is tousled"),
            _LOW,
            _HIGH,
            Quantity("slope", 0.5, 0.0, 4.0, "", "How fast finer features fade"),
            _STRENGTH,
        ),
        _wedge,
    ),
    Shape(
        "points",
        "Grid of points",
        "A pattern that repeats: cloth, canvas, tiles, scales",
        (
            Quantity("spacing", 0.2, 0.02, 1.0, "of the highest", "Distance of the points: fineness of the pattern"),
            _ANGLE,
            Quantity("aspect", 1.0, 0.25, 4.0, "", "Vertical distance of the points to the horizontal"),
            Quantity("fall", 1.0, 0.0, 4.0, "", "How fast the further points fade"),
            Quantity("width", 0.0, 0.0, 0.5, "of the highest", "Breadth: narrow is regular, wide is loose"),
            _STRENGTH,
        ),
        _points,
    ),
    Shape(
        "noise",
        "1/f noise",
        "Features of all sizes: cloud, stone, smoke",
        (Quantity("b", 1.5, 0.0, 4.0, "", "Amplitude falls as 1/f^b: 0 is white, 2 is smooth"), _LOW, _HIGH, _STRENGTH),
        _noise,
    ),
)
SHAPES: dict[str, Shape] = {row.name: row for row in _ROWS}


def drawn(name: str, size: tuple[int, int], parameters: Numbers, arithmetic: int = LIBRARY) -> np.ndarray:
    """Returns a shape's amplitudes, symmetric, 0 at zero frequency: float32 (h, w), 0..its strength.

    Parameters that are missing take the row's default; values beyond their range its nearest end.
    """
    row = SHAPES[name]
    given = {q.name: min(max(float(parameters.get(q.name, q.default)), q.lo), q.hi) for q in row.parameters}
    out = symmetric(row.draw(size, given, array_functions(arithmetic)).astype(np.float32))
    out[size[0] // 2, size[1] // 2] = 0.0
    most = float(out.max())
    return out * np.float32(given["strength"] / most) if most > 0.0 else out
