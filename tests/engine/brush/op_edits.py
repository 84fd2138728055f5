"""Raster-ops on tiles of random pixels: one painted, and what it makes of them."""

import numpy as np

from engine.brush import edits, ops
from engine.brush.checks import rgb
from engine.brush.covered import Scene
from engine.brush.mask import StrokeMask
from engine.brush.mixture import mixture
from engine.brush.settings import from_json
from engine.brush.tints import turning
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.curves import smooth_curve
from engine.numeric.grid import snapped
from engine.texture.planes import Planes

KEY = TileKey(0, 0, 0)
WIDE = 3 * TILE
FULL = np.array([[64.0, 64, 400, 1, 1, 1]])
SOFT = np.array([[40.0, 50, 45, 0.8, 0.7, 0.3], [90, 70, 30, 1, 1, 0.9]])
COLOUR = "#c06020"
P = np.array(rgb(COLOUR))[:, None, None]
LUMA = np.array([0.3, 0.59, 0.11])[:, None, None]
GIVEN = {"clone": {"name": "clone", "layer": "x"}}


def around(seed=1, opaque=False):
    """Random pixels of 3 x 3 tiles, KEY in the middle: parts of them empty and parts opaque."""
    rng = np.random.default_rng(seed)
    alpha = np.ones((WIDE, WIDE)) if opaque else np.clip(rng.uniform(-0.3, 1.3, (WIDE, WIDE)), 0, 1)
    return Planes(snapped(np.concatenate([rng.uniform(0, 1, (3, WIDE, WIDE)) * alpha, alpha[None]])))


def reader(planes):
    return lambda rect: planes.cut(*rect.slices(Rect(-TILE, -TILE, 2 * TILE, 2 * TILE)))


def old_of(planes):
    return Planes(np.ascontiguousarray(reader(planes)(KEY.rect).data), planes.inks)


def edited(op, planes, dabs=FULL, locked=False, **members):
    brush = from_json({"mode": "raster", "op": op, "colour": COLOUR, "radius": 60, **members})
    mask = StrokeMask(0, (0, 0))
    mask.paint(dabs)
    read = reader(planes)
    made = edits.edit(brush, mask, mixture(brush, {}, 0, 7), locked, read, scene=Scene(read))
    return made, mask.coverage().on_grid(KEY)


def after(made, old):
    stamp = made.stamp(KEY, old)
    if stamp is None:
        return old.data[:4]
    new = snapped(stamp.keep * old.data[:4]) + stamp.add[:4]
    if made.spares_alpha:
        new[3] = old.data[3]
    new[3] = np.clip(new[3], 0, 1)
    return new


def grey(c):
    return (LUMA * c).sum(axis=0)[None]


def wash(c):
    places = [0.0, 0.5, 1.0]
    colours = np.array([rgb("#1b1033"), rgb("#c8553d"), rgb("#ffe9b0")])
    return np.stack([np.interp(grey(c)[0], places, column) for column in colours.T])


def _recoloured(c):
    turned = np.einsum("ij,jhw->ihw", turning(20), c)
    return grey(turned) + 1.2 * (turned - grey(turned))


TARGETS = {
    "toward": lambda c: P + 0 * c,
    "multiply": lambda c: c * P,
    "screen": lambda c: 1 - (1 - c) * (1 - P),
    "overlay": lambda c: np.where(c <= 0.5, 2 * c * P, 1 - 2 * (1 - c) * (1 - P)),
    "dodge": lambda c: c / (1 - P),
    "burn": lambda c: 1 - (1 - c) / P,
    "add": lambda c: c + P,
    "subtract": lambda c: c - P,
    "difference": lambda c: np.abs(c - P),
    "invert": lambda c: 1 - c,
    "lighten": lambda c: (1 + c) / 2,
    "darken": lambda c: c / 2,
    "gamma": np.sqrt,
    "contrast": lambda c: 0.5 + 1.5 * (c - 0.5),
    "posterise": lambda c: np.floor(np.minimum(c * 4, 3.5)) / 3,
    "saturate": lambda c: grey(c) + 1.5 * (c - grey(c)),
    "hue": lambda c: np.einsum("ij,jhw->ihw", turning(60), c),
    "tone": lambda c: 0.5 + 1.2 * (c - 0.5) + 0.1,
    "curves": lambda c: smooth_curve(ops.OPS["curves"].parameters[0].default, c),
    "levels": lambda c: np.clip((c - 0.05) / 0.9, 0, 1) ** 0.9,
    "recolour": lambda c: 0.9 * np.clip(_recoloured(c), 0, 1) + 0.1,
    "gradient": wash,
}
