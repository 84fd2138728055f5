"""Twenty pictures whose masks are known: bundled examples and painted shapes laid over grounds, ten of them plain, ten
textured (scikit-image's photographs)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
from PIL import Image
from scipy import ndimage

PALETTES = Path(__file__).parents[2] / "palettes" / "examples"
SIDE = 512
NOISE = 0.008  # of a camera: deviation of each channel


class Composite(NamedTuple):
    """`pixels`: uint8 RGBA (h, w, 4), opaque; `alpha`: float32 (h, w), what was laid over the ground."""

    name: str
    plain: bool
    pixels: np.ndarray
    alpha: np.ndarray

    @property
    def mask(self) -> np.ndarray:
        return self.alpha >= 0.5


def composites(side: int = SIDE, names: tuple[str, ...] | None = None) -> Iterator[Composite]:
    """All, or those of some names."""
    for number, (name, plain, ground, laid) in enumerate(_rows()):
        if names is not None and name not in names:
            continue
        rng = np.random.default_rng(number)
        under, over = ground(side, rng), laid(side, rng)
        alpha = over[..., 3:]
        noise = NOISE * rng.standard_normal((side, side, 3))
        seen = over[..., :3] * alpha + under * (1 - alpha) + noise
        pixels = np.full((side, side, 4), 255, np.uint8)
        pixels[..., :3] = np.clip(np.rint(seen * 255), 0, 255)
        yield Composite(name, plain, pixels, alpha[..., 0].astype(np.float32))


Painter = Callable[[int, np.random.Generator], np.ndarray]


def _rows() -> list[tuple[str, bool, Painter, Painter]]:
    return [
        ("bread on white", True, _flat(0.97, 0.97, 0.96), _example("bread")),
        ("torn paper on grey", True, _lit(0.55, 0.56, 0.58), _example("torn-brown-paper")),
        ("leaves on sand", True, _grained(0.86, 0.80, 0.68), _example("leaves")),
        ("orange on black", True, _lit(0.08, 0.08, 0.09), _example("orange-segment")),
        ("felt on blue", True, _lit(0.30, 0.42, 0.66), _example("felt")),
        ("lava on paper", True, _shadowed(_grained(0.93, 0.92, 0.88), "lava"), _example("lava")),
        ("newsprint on table", True, _grained(0.45, 0.33, 0.22), _example("torn-newsprint")),
        ("soft shape on green", True, _lit(0.45, 0.62, 0.40), _shape("blob", (0.80, 0.25, 0.22), 4.0)),
        ("hairs on cream", True, _lit(0.93, 0.90, 0.82), _shape("hairs", (0.25, 0.18, 0.15), 0.7)),
        ("three shapes on white", True, _flat(0.95, 0.95, 0.95), _shape("three", (0.2, 0.45, 0.55), 1.0)),
        ("headlines on grass", False, _photograph("grass"), _example("torn-headlines")),
        ("torn paper on brick", False, _photograph("brick"), _example("torn-blue-tissue", solid=True)),
        ("leaves on gravel", False, _photograph("gravel"), _example("leaves")),
        ("orange on table", False, _photograph("coffee", (0, 330)), _example("orange-peel")),
        ("rust on tissue", False, _photograph("immunohistochemistry"), _example("rust-and-paint")),
        ("red paper on moon", False, _photograph("moon"), _example("torn-red-paper")),
        ("moss on fur", False, _photograph("chelsea", (60, 100)), _example("mossy-gravel")),
        ("ring on stars", False, _photograph("hubble_deep_field"), _shape("ring", (0.85, 0.7, 0.3), 1.5)),
        ("soft shape on grass", False, _photograph("grass"), _shape("blob", (0.75, 0.72, 0.8), 4.0)),
        ("hairs on moon", False, _photograph("moon"), _shape("hairs", (0.7, 0.3, 0.2), 0.8)),
    ]


# --- grounds ---------------------------------------------------------------------------------------------------------


def _flat(*colour: float) -> Painter:
    return lambda side, rng: np.broadcast_to(np.array(colour), (side, side, 3)).copy()


def _lit(*colour: float) -> Painter:
    """Lighter towards one corner, darker towards the others."""

    def paint(side: int, rng: np.random.Generator) -> np.ndarray:
        y, x = np.mgrid[:side, :side] / side
        light = 1.12 - 0.35 * np.hypot(x - 0.3, y - 0.25)
        return np.clip(np.array(colour) * light[..., None], 0, 1)

    return paint


def _grained(*colour: float) -> Painter:
    """Paper, cloth, a wooden board: grain of one colour."""

    def paint(side: int, rng: np.random.Generator) -> np.ndarray:
        fine, coarse = (ndimage.gaussian_filter(rng.standard_normal((side, side)), sigma) for sigma in (0.8, 20))
        light = 1 + 0.04 * fine / fine.std() + 0.04 * coarse / coarse.std()
        return np.clip(np.array(colour) * light[..., None], 0, 1)

    return paint


def _shadowed(ground: Painter, name: str) -> Painter:
    """What lies on it throws a soft shadow."""

    def paint(side: int, rng: np.random.Generator) -> np.ndarray:
        under, alpha = ground(side, rng), _example(name)(side, rng)[..., 3]
        shade = ndimage.gaussian_filter(ndimage.shift(alpha, (side / 60, side / 60), order=1), side / 90)
        return under * (1 - 0.25 * shade[..., None])

    return paint


def _photograph(name: str, corner: tuple[int, int] = (0, 0)) -> Painter:
    def paint(side: int, rng: np.random.Generator) -> np.ndarray:
        from skimage import data

        picture = np.asarray(getattr(data, name)())
        picture = np.stack([picture] * 3, -1) if picture.ndim == 2 else picture[..., :3]
        y, x = corner
        whole = min(picture.shape[0] - y, picture.shape[1] - x, 512)
        piece = Image.fromarray(np.ascontiguousarray(picture[y : y + whole, x : x + whole]))
        return np.asarray(piece.resize((side, side), Image.Resampling.BICUBIC), float) / 255

    return paint


# --- what lies on them -----------------------------------------------------------------------------------------------


def _example(name: str, solid: bool = False) -> Painter:
    """A bundled example, a tenth of the side from the edges; `solid`: not as thin as it is."""

    def paint(side: int, rng: np.random.Generator) -> np.ndarray:
        inner = round(0.8 * side)
        small = Image.open(PALETTES / f"{name}.png").convert("RGBa").resize((inner, inner), Image.Resampling.BICUBIC)
        placed = Image.new("RGBa", (side, side))
        placed.paste(small, (side // 10, side // 10))
        found = np.asarray(placed.convert("RGBA"), float) / 255
        if solid:
            found[..., 3] = np.clip(found[..., 3] / np.quantile(found[..., 3], 0.7), 0, 1)
        return found

    return paint


def _shape(kind: str, colour: tuple[float, float, float], soft: float) -> Painter:
    """A painted one, mottled, with a rim so many pixels soft."""

    def paint(side: int, rng: np.random.Generator) -> np.ndarray:
        fine, coarse = (ndimage.gaussian_filter(rng.standard_normal((side, side)), side / n) for n in (250, 30))
        light = 1 + 0.05 * fine / fine.std() + 0.10 * coarse / coarse.std()
        over = np.empty((side, side, 4))
        over[..., :3] = np.clip(np.array(colour) * light[..., None], 0, 1)
        over[..., 3] = np.clip(0.5 + _inside(kind, side) / (soft * side / SIDE), 0, 1)
        return over

    return paint


def _inside(kind: str, side: int) -> np.ndarray:
    """How far within a shape each pixel lies, in pixels, about: float (h, w)."""
    y, x = (np.mgrid[:side, :side] + 0.5) / side - 0.5
    if kind == "ring":
        return (0.09 - np.abs(np.hypot(x, y) - 0.26)) * side
    if kind == "three":
        places = ((-0.24, -0.2, 0.17), (0.22, -0.16, 0.13), (0.02, 0.25, 0.16))
        return np.max([r - np.hypot(x - a, y - b) for a, b, r in places], axis=0) * side
    angle, radius = np.arctan2(y, x), np.hypot(x, y)
    if kind == "hairs":
        spread = np.abs(np.sin(30 * angle)) ** 14 * (0.10 + 0.03 * np.sin(7 * angle))
        return (0.24 + 0.03 * np.sin(3 * angle) + spread - radius) * side / 2.5
    return (0.28 + 0.05 * np.sin(3 * angle + 1) + 0.03 * np.sin(5 * angle) - radius) * side
