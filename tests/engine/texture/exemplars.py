"""Small examples with a rim, made here."""

from __future__ import annotations

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.arithmetic import EVERYWHERE
from engine.texture.example.control import Channel, ordered
from engine.texture.example.controlled import analysed_with
from engine.texture.example.exemplar import Exemplar, analysed
from engine.texture.example.parameters import Parameters


def blob(side: int = 64, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Dotted blue with a white, ragged, half transparent rim: uint8 RGBA (side, side, 4), and its mask."""
    random = np.random.default_rng(seed)
    y, x = np.mgrid[:side, :side] - (side - 1) / 2.0
    angle = np.arctan2(y, x)
    depth = side * (0.44 + 0.02 * np.sin(5 * angle) + 0.01 * np.sin(11 * angle)) - np.hypot(x, y)
    depth += 0.6 * random.standard_normal((side, side))
    mask = depth > 0
    dots = ((x + 0.4 * y) % 8 < 3) & ((y - 0.4 * x) % 8 < 3)
    colours = np.where(dots[..., None], (230, 200, 60), (40, 90, 150)) + random.integers(-12, 13, (side, side, 1))
    colours = np.where((depth < 4)[..., None], (240, 240, 235), colours)
    alpha = np.clip(90 + 60 * depth, 0, 255)
    pixels = np.dstack([colours, alpha]) * mask[..., None]
    return np.clip(pixels, 0, 255).astype(np.uint8), mask


def bounded(side: int = 64, **values) -> Exemplar:
    return analysed(blob(side)[0], None, Parameters(**values))


def faint(side: int = 64, **values) -> Exemplar:
    """With a rim that is all but transparent for some pixels."""
    pixels, mask = blob(side)
    y, x = np.mgrid[:side, :side] - (side - 1) / 2.0
    pixels[..., 3] = np.clip(26 * (0.44 * side - np.hypot(x, y)), 1, 255) * mask
    return analysed(pixels, None, Parameters(**values))


def unbounded(side: int = 48, **values) -> Exemplar:
    """The same without its rim: it fills its picture."""
    inner = blob(2 * side)[0][side // 2 : -side // 2, side // 2 : -side // 2].copy()
    inner[..., 3] = 255
    return analysed(inner, None, Parameters(**values))


def controlled(side: int = 48, turns: int = 8, width: int = 12, **values) -> Exemplar:
    """The same with its rim, an orientation, a map of its own and a wide rim."""
    channels = ordered([Channel("orientation", 1.0, turns), Channel("glow", 0.5), Channel("rim", 1.0, 1, width)])
    planes = np.zeros((3, side, side), np.uint8)
    planes[1] = np.arange(0, 250, 250 / side)[:side]
    return analysed_with(blob(side)[0], None, Parameters(**values), (channels, planes), EVERYWHERE)


def graded(side: int = 64, **values) -> Exemplar:
    """The same with its rim and a map from dark on the left to light on the right."""
    planes = np.broadcast_to(np.linspace(0, 255, side).astype(np.uint8), (1, side, side))
    return analysed_with(blob(side)[0], None, Parameters(**values), ((Channel("glow", 0.5),), planes), EVERYWHERE)


def told_at(exemplar: Exemplar, rect: Rect) -> np.ndarray | None:
    """What two channels tell of places, some of it alike over many pixels."""
    if exemplar.control is None or exemplar.control.stored < 2:
        return None
    y, x = np.mgrid[rect.y0 : rect.y1, rect.x0 : rect.x1]
    return np.stack([(x >> 3) * 20 & 255, (y >> 4) * 60 & 255]).astype(np.uint8)
