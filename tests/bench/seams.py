"""Examples grown without seams, against the method that definitions had before: whether rims are like the example's,
how often a level stroke shows what it showed before, and how much a narrow one shows at all.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from bench import Figure
from bench.five_textures import FOLDER
from bench.likeness import premultiplied, rim
from engine.numeric.address import Rect
from engine.strokes.example_files import read_exemplar, read_parameters
from engine.texture.example import show
from engine.texture.example.exemplar import Exemplar, analysed
from engine.texture.example.parameters import NEW, Parameters
from engine.texture.example.region import empty, painted, refined
from engine.texture.table import instance

BUNDLED = ("torn-newsprint", "torn-rag-paper", "wash-indigo", "embroidery", "mossy-gravel", "felt")
SEEDS = 3
WIDE, NARROW = 48, 8  # pixels across strokes
LENGTH = 700
Grown = tuple[np.ndarray, np.ndarray]  # sources, pixels in 0..1


def measure(small: bool = False) -> Iterator[Figure]:
    names, length = (BUNDLED[:1], 120) if small else (BUNDLED, LENGTH)
    curved, level, narrow = _wave(WIDE, length), _wave(WIDE, length, 0.0), _wave(NARROW, length)
    pairs = {name: (bundled(name, "correction"), bundled(name, NEW.method)) for name in names}
    pairs["ragged"] = (ragged(Parameters()), ragged(NEW))
    seeds = range(1 if small else SEEDS)
    for what, stroke, tell, more in (
        ("rims of a curved stroke", curved, rims, False),
        ("rims of a level stroke", level, rims, False),
        ("what a level stroke shows again", level, again, False),
        ("how opaque a stroke of 8 px is", narrow, opaque, True),
    ):
        found = {name: [_mean(tell, one, stroke, seeds) for one in pair] for name, pair in pairs.items()}
        told = ", ".join(f"{name} {now:.3g} ({before:.3g})" for name, (before, now) in found.items())
        before, now = np.mean(list(found.values()), axis=0)
        yield Figure(what, float(now), "", "the method before", float(now / before), 1.0, more, told)


def _mean(tell, exemplar: Exemplar, stroke: np.ndarray, seeds: range) -> float:
    return float(np.mean([tell(exemplar, stroke, _grown(exemplar, stroke, seed)) for seed in seeds]))


def _grown(exemplar: Exemplar, stroke: np.ndarray, seed: int) -> Grown:
    rect = Rect.at(0, 0, stroke.shape[1], stroke.shape[0])
    region = refined(painted(empty(exemplar, seed + 1), rect, stroke))
    made = show.pixels(region, rect)
    return show.sources(region, rect), made / float(np.iinfo(made.dtype).max)


def rims(exemplar: Exemplar, stroke: np.ndarray, grown: Grown) -> float:
    example = exemplar.pixels / float(np.iinfo(exemplar.pixels.dtype).max)
    return rim(premultiplied(example), exemplar.mask, premultiplied(grown[1]), stroke)


def again(exemplar: Exemplar, stroke: np.ndarray, grown: Grown) -> float:
    """The part of a stroke that comes from where what lies some way along it comes from, at the worst distance."""
    names = grown[0][:, WIDE:-WIDE]
    same = ((names[:, lag:] == names[:, :-lag])[names[:, lag:] >= 0].mean() for lag in range(6, 100))
    return max(map(float, same))


def opaque(exemplar: Exemplar, stroke: np.ndarray, grown: Grown) -> float:
    """In parts of how opaque the example is."""
    own = exemplar.pixels[exemplar.mask][:, 3].mean() / np.iinfo(exemplar.pixels.dtype).max
    return float(grown[1][stroke][:, 3].mean() / own)


def bundled(name: str, method: str | int) -> Exemplar:
    at = FOLDER / name
    return read_exemplar(f"{at}.png", f"{at}.mask.png", replace(read_parameters(f"{at}.toml"), method=method))


def ragged(parameters: Parameters, side: int = 200) -> Exemplar:
    """Pebbles with a dark, ragged rim of uneven alpha."""
    stone, moss = (
        0.5 + 0.5 * instance("rock", {"period": period, "seed": seed}, 0, 0).appearance(0, Rect.at(0, 0, side, side))[0]
        for period, seed in ((16, 4), (10, 9))
    )
    y, x = np.mgrid[:side, :side] - (side - 1) / 2.0
    depth = side * 0.43 + 16.0 * (moss - 0.5) - np.hypot(x, 1.1 * y)
    dark = np.clip(1.0 - depth / 8.0, 0.0, 1.0)[..., None]
    colours = stone[..., None] * (1.0, 0.93, 0.8) * (1.0 - dark) + dark * (0.2, 0.35, 0.1) * (0.6 + stone[..., None])
    alpha = np.clip((depth + 3.0 * (stone - 0.5)) / 3.0, 0.1, 1.0) * (depth > 0)
    pixels = np.dstack([colours * (depth > 0)[..., None], alpha])
    return analysed((255.0 * np.clip(pixels, 0.0, 1.0) + 0.5).astype(np.uint8), None, parameters)


def _wave(width: int, length: int, height: float = 60.0) -> np.ndarray:
    """A stroke with round ends, level or in waves: bool (h, length)."""
    rows = 2 * int(height) + width + 20
    y, x = np.mgrid[:rows, :length]
    found = np.zeros((rows, length), bool)
    for at in range(width, length - width):
        found |= (y - rows / 2 - height * np.sin(at / 60.0)) ** 2 + (x - at) ** 2 < (width / 2) ** 2
    return found
