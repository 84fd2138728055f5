"""Raster-ops that change the colour of a pixel, each by name: straight colours to targets, and their slopes.

A kernel gives the colour T that an op aims at and how steeply it changes with the colour c that is there, T'(c).  A
stroke of weight w makes c + w (T - c) of it and keeps the part A = 1 + w (T' - 1) of finer levels' detail, T' being how
a small grey change of c changes the mean of T.  Alpha stays.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from engine.brush import coat, tints, tones
from engine.brush.mixture import LUMA, ONES
from engine.brush.operand import Operand, Operating, plane, planes_of, straight
from engine.brush.stamp import Stamp
from engine.numeric import formula_kernel
from engine.numeric.address import TILE
from engine.texture.planes import COLOURS, merged

_STEP = np.float32(1.0 / 255.0)  # to each side, for the slope of a formula
_TINY = np.float32(1e-6)

Targets = tuple[np.ndarray, np.ndarray]  # colours aimed at and slopes, float32 (3, n) each
_Kernel = Callable[[Operating, Operand, np.ndarray], Targets]  # of straight colours, float32 (3, n)


def change(edit: Operating, at: Operand) -> Stamp:
    """Returns the stamp of the edit's op over a tile; its textures go on at finer levels as ink, of the amplitude
    that the op has there."""
    row = edit.op.row
    kernel = _formula if row is None else KERNELS[row.kernel]
    inks = merged(at.old.inks, edit.mixture.inks)
    keep = np.empty_like(ONES)
    add = np.empty((COLOURS + 3 * len(inks), TILE, TILE), np.float32)
    before, shape = np.ascontiguousarray(at.old.data), (3, TILE, TILE)
    c = np.empty((3, TILE * TILE), np.float32)
    tones.straight(before[:COLOURS].reshape(COLOURS, -1), c)
    t, s = kernel(edit, at, c)
    tones.change(
        before, planes_of(at.old.inks, inks), at.weight, at.free, c.reshape(shape), t.reshape(shape), s.reshape(shape),
        edit.op.by_texture, edit.mixture.gains(inks), keep, add,
    )  # fmt: skip
    return Stamp(keep, add, inks)


def _channel(loop: tones.Loop, edit: Operating, at: Operand, c: np.ndarray) -> Targets:
    """Each channel for itself."""
    t, s = np.empty_like(c), np.empty_like(c)
    loop(c, edit.colour, edit.numbers, t, s)
    return t, s


def _gamma(edit: Operating, at: Operand, c: np.ndarray) -> Targets:
    """Each channel to a power."""
    return _channel(tones.GAMMAS[edit.scene.arithmetic], edit, at, c)


def _saturate(edit: Operating, at: Operand, c: np.ndarray) -> Targets:
    return _mixed(c, tints.saturating(edit.op.parameters["amount"]))


def _hue(edit: Operating, at: Operand, c: np.ndarray) -> Targets:
    return _mixed(c, tints.turning(edit.op.parameters["turn"], edit.scene.arithmetic))


def _mixed(c: np.ndarray, matrix: np.ndarray) -> Targets:
    t, s = np.empty_like(c), np.empty_like(c)
    tones.mixed(c, np.ascontiguousarray(matrix.reshape(-1), np.float32), t, s)
    return t, s


def _recoloured(edit: Operating, at: Operand, c: np.ndarray) -> Targets:
    """Turned about the grey axis, more or less of what differs from grey, then part of the way to white or black."""
    given, light = edit.op.parameters, np.float32(edit.op.parameters["light"])
    t, s = _mixed(c, tints.recolouring(given["turn"], given["amount"], edit.scene.arithmetic))
    left = np.float32(1) - abs(light)
    return t * left + max(light, np.float32(0)), s * left


def _levels(edit: Operating, at: Operand, c: np.ndarray) -> Targets:
    """Each channel from between two tones spread over all of them, and to a power."""
    black, white, gamma = edit.numbers[:3]
    steep = np.float32(1) / max(white - black, _STEP)
    spread = (c - black) * steep
    inside = np.clip(spread, np.float32(0), np.float32(1))
    t, s, numbers = np.empty_like(c), np.empty_like(c), np.zeros_like(edit.numbers)
    numbers[0] = gamma
    tones.GAMMAS[edit.scene.arithmetic](inside, edit.colour, numbers, t, s)
    return t, np.where(inside == spread, s * steep, np.float32(0))


def _curves(edit: Operating, at: Operand, c: np.ndarray) -> Targets:
    """Each channel along its own curve, then along that of all."""
    given = edit.op.parameters
    t, s = np.empty_like(c), np.empty_like(c)
    for channel, name in enumerate(("red", "green", "blue")):
        own, slope = _along(tints.tone_table(given[name]), c[channel])
        t[channel], s[channel] = _along(tints.tone_table(given["all"]), own)
        s[channel] *= slope
    return t, s


def _along(table: np.ndarray, c: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the values of a table at tones, and how steeply it rises there."""
    places = np.clip(c, np.float32(0), np.float32(1)) * np.float32(tones.STEPS)
    i = np.minimum(places.astype(np.int32), tones.STEPS - 1)
    low, high = table[i], table[i + 1]
    return low + (high - low) * (places - i.astype(np.float32)), (high - low) * np.float32(tones.STEPS)


def _gradient(edit: Operating, at: Operand, c: np.ndarray) -> Targets:
    """Returns a ramp's colours, by the pixel's brightness or along the brush's texture."""
    t, s = np.empty_like(c), np.empty_like(c)
    if edit.op.by_texture:
        index = np.ascontiguousarray(at.texture).reshape(-1)
    else:
        index = np.empty(c.shape[1], np.float32)
        tones.luma(c, index)
    tones.ramp(index, tints.ramp(edit.op.parameters["ramp"]), t, s)
    return t, s


def _smooth(edit: Operating, at: Operand, c: np.ndarray) -> Targets:
    return _mean(edit, at), np.zeros_like(c)


def _sharpen(edit: Operating, at: Operand, c: np.ndarray) -> Targets:
    t, s = np.empty_like(c), np.empty_like(c)
    tones.sharpen(c, _mean(edit, at), edit.numbers[0], t, s)
    return t, s


def _mean(edit: Operating, at: Operand) -> np.ndarray:
    """Returns the straight colours around each pixel, float32 (3, n): its own where nothing lies around."""
    assert edit.read is not None
    reach = round(edit.op.parameters["reach"])
    around = edit.read(at.key.rect.grown(2 * reach)).data[:COLOURS]
    mean = coat.local_mean(np.ascontiguousarray(around), reach)
    return straight(mean, at.old).reshape(3, -1)


def _formula(edit: Operating, at: Operand, c: np.ndarray) -> Targets:
    """The artist's own formula gives f; the slope is a difference over 1/255 to each side."""
    assert edit.op.tree is not None
    scene = edit.scene
    run = formula_kernel.kernel(edit.op.tree, scene.arithmetic)
    pressure = at.covered if scene.pressure is None else plane(scene.pressure, at.key)
    pressure = np.zeros_like(ONES) if pressure is None else pressure
    x = np.arange(TILE, dtype=np.float32) + np.float32(at.key.rect.x0 - scene.origin[0] + 0.5)
    y = np.arange(TILE, dtype=np.float32) + np.float32(at.key.rect.y0 - scene.origin[1] + 0.5)
    tex = np.clip(at.texture, 0.0, 1.0)
    across, down = np.tile(x, TILE), np.repeat(y, TILE)
    rows = [np.ascontiguousarray(part).reshape(-1) for part in (tex, at.covered, pressure, across, down)]
    colours = straight(at.old.data[:COLOURS], at.old)
    bright = np.einsum("chw,c->hw", colours, LUMA).reshape(-1)
    flat, f = at.weight.reshape(-1), np.empty(TILE * TILE, np.float32)
    t, s = np.empty_like(c), np.empty_like(c)
    over = 1.0 / np.maximum(flat, _TINY)

    def made(pic: np.ndarray, luma: np.ndarray, channel: int) -> np.ndarray:
        run(pic, luma, *rows, float(edit.colour[channel]), float(edit.level), f)
        return np.clip(pic + flat * f, 0.0, 1.0)

    for channel in range(3):
        pic = colours[channel].reshape(-1)
        t[channel] = pic + (made(pic, bright, channel) - pic) * over
        low, high = np.maximum(pic - _STEP, 0.0), np.minimum(pic + _STEP, 1.0)
        up = made(high, np.minimum(bright + _STEP, 1.0), channel)
        slope = (up - made(low, np.maximum(bright - _STEP, 0.0), channel)) / (high - low)
        s[channel] = 1.0 + (np.clip(slope, -4.0, 4.0) - 1.0) * over
    return t, s


KERNELS: dict[str, _Kernel] = {name: partial(_channel, loop) for name, loop in tones.CHANNELS.items()} | {
    "gamma": _gamma,
    "saturate": _saturate,
    "hue": _hue,
    "recolour": _recoloured,
    "levels": _levels,
    "curves": _curves,
    "gradient": _gradient,
    "smooth": _smooth,
    "sharpen": _sharpen,
}
