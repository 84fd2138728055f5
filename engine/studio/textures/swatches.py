"""Small pictures that a brush paints of itself: thumbnails of presets, and the ink mixer's patch (feature A5)."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from engine.brush.felt import steadied
from engine.brush.follow_curves import magnified
from engine.brush.settings import MOST_DETAIL, Brush
from engine.canvas.composite import composite
from engine.canvas.reading import layer_planes
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.grown import settled_root
from engine.painting.value import Painting
from engine.session.apply import apply
from engine.studio.requests import Swatch

_GROUND = "#5b6470"
_LEANING, _SECONDS = 55.0, 0.6  # of the pen: degrees at the end of the stroke, and how long that takes
_SMALLER = 2  # octaves by which an example is made smaller for a thumbnail, at most: finer ones leave nothing to see
_BARS = 8  # of paint on the ground
_COLOURS = ("#23262e", "#7c2f3b", "#c8643c", "#e2b04a", "#6f9a4c", "#3d8f93", "#41609f", "#b9bfc9")  # to be changed


def painted(request: Swatch, of: Painting) -> np.ndarray:
    """Returns the picture: float32 (4, height, width), premultiplied.  `of`: whose textures the brush may name."""
    painting = Painting(seed=of.seed, textures=of.textures, arithmetic=of.arithmetic)
    for definition in request.textures:
        painting = apply(painting, definition)
    width, height = request.size
    strokes = (
        _fill(request.brush, width, height) if request.kind == "fill" else _thumbnail(request.brush, width, height)
    )
    for stroke in strokes:
        painting = apply(painting, replace(stroke, brush=_at_home(stroke.brush, painting, width)))
    level = request.zoom
    middle = Rect.at((width << level) // 2 - width // 2, (height << level) // 2 - height // 2, width, height)
    return composite(settled_root(painting.root, 1), level, middle, layer_planes)


def _fill(brush: Brush, width: int, height: int) -> list[c.Stroke]:
    """Returns the whole patch covered."""
    cover = replace(steadied(brush), radius=float(height), hardness=1.0, opacity=1.0, flow=1.0, spacing=0.5)
    points = _points([[0.0, height / 2, 1.0], [float(width), height / 2, 1.0]])
    return [c.Stroke(0, (0, 0), points, cover)]


def _thumbnail(brush: Brush, width: int, height: int) -> list[c.Stroke]:
    """Returns a wave whose pressure rises and falls; over the ground that the brush's mode asks for."""
    t = np.linspace(0.0, 1.0, 40)
    x = width * (0.12 + 0.76 * t)
    y = height * (0.5 + 0.2 * np.sin(t * math.tau))
    pressure = np.sin(np.pi * (0.06 + 0.9 * t)) ** 0.8
    radius = min(max(brush.radius, 2.0), height * 0.24)
    leaning = np.stack([_LEANING * t, np.zeros(len(t)), _SECONDS * t], axis=1)  # ever more, as the pen goes along
    points = _points(np.concatenate([np.stack([x, y, pressure], axis=1), leaning], axis=1))
    dynamics = magnified(brush.dynamics, radius / max(brush.radius, 0.5))
    wave = c.Stroke(0, (0, 0), points, replace(brush, radius=radius, dynamics=dynamics))
    if brush.row.grows:
        smaller = min(_SMALLER, max(0, round(math.log2(brush.radius / radius))))  # its texture, as the stroke is
        detail = min(brush.example_detail + smaller, MOST_DETAIL)
        return [replace(wave, brush=replace(wave.brush, example_detail=detail))]
    wet = brush.wet is not None and brush.row.lays_ink
    bars, colours = [], wet or brush.row.ground == "colours"
    if not brush.row.ground and not wet:
        return [wave]
    for k in range(_BARS):
        across = width * (0.1 + 0.8 * k / (_BARS - 1))
        ground = Brush(
            radius=width * (0.055 if colours else 0.035), hardness=0.9, colour=_COLOURS[k] if colours else _GROUND
        )
        bars.append(c.Stroke(0, (0, 0), _points([[across, height * 0.14, 1.0], [across, height * 0.86, 1.0]]), ground))
    return [*bars, wave]


def _at_home(brush: Brush, painting: Painting, width: int) -> Brush:
    """Returns a brush that copies from a layer copies from this picture's own, half a bar away."""
    if isinstance(brush.op, str) or "layer" not in brush.op or painting.active is None:
        return brush
    return replace(brush, op=brush.op.set("layer", painting.active).set("offset", (width // 9, 0)))


def _points(rows: object) -> np.ndarray:
    """x, y, pressure, and perhaps the rest, as a stroke's points."""
    given = np.asarray(rows, np.float64)
    points = np.zeros((len(given), 6))
    points[:, : given.shape[1]] = given
    points.flags.writeable = False
    return points
