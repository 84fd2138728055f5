"""Five textures that touch each other, in the kind of figure 6 of Ritter et al. 2006, by texture-by-numbers and by
painting with examples: in the example each lies alone on paper, so that no interface of two of them is in it.

PYTHONPATH=tests python -m bench.five_textures    writes palettes/pictures/numbers.png
"""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import NamedTuple

import numpy as np
from PIL import Image
from scipy import ndimage

from bench import by_numbers
from bench.likeness import rim
from engine.numeric.address import Rect
from engine.texture.example import show
from engine.texture.example.exemplar import PAD, Exemplar, analysed, premultiplied
from engine.texture.example.parameters import Parameters, with_values
from engine.texture.example.region import empty, painted, refined

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "palettes" / "examples"
PICTURE = ROOT / "palettes" / "pictures" / "numbers.png"
NAMES = ("orange-peel", "bread", "torn-sugar-paper", "mossy-gravel", "felt")
PAPER = np.array([0.93, 0.91, 0.87], np.float32)
LABELS = np.array(
    [[1, 1, 1], [0.9, 0.2, 0.2], [0.95, 0.8, 0.1], [0.3, 0.6, 1], [0.2, 0.7, 0.3], [0.5, 0.2, 0.6]], np.float32
)
PANEL, GAP = 400, 12  # of the sheet
NEAR = 3.0  # pixels from an interface
BAND = 4.0  # pixels from the outline of an example: its rim; one more, as no outline is quite like another


class Scene(NamedTuple):
    """Labels are numbers of LABELS, 0 the paper: int (h, w); `labels`, `texture` (h, w, 3): the examples side by side;
    `wanted`: what is to be filled."""

    exemplars: tuple[Exemplar, ...]
    labels: np.ndarray
    texture: np.ndarray
    wanted: np.ndarray


class Made(NamedTuple):
    """`picture` (h, w, 3), over paper; `sources` int (h, w, 2), row and column in the examples side by side."""

    picture: np.ndarray
    sources: np.ndarray


def scene(size: int, side: int) -> Scene:
    """A map of `size` pixels along, examples of `side`."""
    exemplars = tuple(exemplar(name, side) for name in NAMES)
    labels = np.hstack([(k + 1) * exemplar.mask for k, exemplar in enumerate(exemplars)])
    texture = np.hstack([over_paper(premultiplied(exemplar.pixels)) for exemplar in exemplars])
    return Scene(exemplars, labels, texture, drawn(size))


def exemplar(name: str, side: int) -> Exemplar:
    """A bundled example reduced, with as many levels as its size asks for."""
    size = side, side
    small = Image.open(FOLDER / f"{name}.png").convert("RGBa").resize(size, Image.Resampling.BOX).convert("RGBA")
    mask = Image.open(FOLDER / f"{name}.mask.png").convert("L").resize(size, Image.Resampling.BOX)
    told = tomllib.loads((FOLDER / f"{name}.toml").read_text("utf-8"))
    told = {field: value for field, value in told.items() if field not in ("group", "levels")}
    return analysed(np.asarray(small), np.asarray(mask) >= 128, with_values(Parameters(), told))


def drawn(size: int) -> np.ndarray:
    """One region in the middle and four about it, all of them smooth, on paper."""
    y, x = (np.mgrid[:size, :size] + 0.5) / size - 0.5
    y, x = y + 0.03 * np.sin(9 * x + 1), x + 0.03 * np.sin(10 * y)
    places = [(-0.24, -0.19), (-0.17, 0.23), (0.02, 0.02), (0.22, -0.22), (0.24, 0.19)]
    apart = [np.hypot(y - row, x - column) for row, column in places]
    apart[2] -= 0.04
    return np.where(np.hypot(y, 0.97 * x) < 0.46, 1 + np.argmin(apart, axis=0), 0)


def over_paper(rgba: np.ndarray) -> np.ndarray:
    """Premultiplied (h, w, 4) as (h, w, 3)."""
    return rgba[..., :3] + (1.0 - rgba[..., 3:]) * PAPER


def theirs(place: Scene) -> Made:
    sources = by_numbers.sources(LABELS[place.labels], place.texture, LABELS[place.wanted])
    return Made(place.texture[sources[..., 0], sources[..., 1]], sources)


def ours(place: Scene) -> Made:
    """Each label a region of its own, as painting them over one another in REPLACE mode leaves them."""
    height, width = place.wanted.shape
    rect = Rect.at(0, 0, width, height)
    picture = np.broadcast_to(PAPER, (height, width, 3)).copy()
    sources = np.full((height, width, 2), -1, np.int32)
    for k, exemplar in enumerate(place.exemplars):
        inside = place.wanted == k + 1
        region = refined(painted(empty(exemplar, k), rect, inside))
        names = show.sources(region, rect)[inside]
        first = k * exemplar.mask.shape[1]
        sources[inside] = np.stack([(names >> 16) - PAD, (names & 0xFFFF) - PAD + first], -1)
        picture[inside] = over_paper(show.picture(region, rect).transpose(1, 2, 0))[inside]
    return Made(picture, sources)


def depth(labels: np.ndarray, label: int) -> np.ndarray:
    """How far from the outline each pixel of a label lies, 0 outside it."""
    return ndimage.distance_transform_edt(np.pad(labels == label, 1))[1:-1, 1:-1]


def interfaces(wanted: np.ndarray) -> dict[tuple[int, int], np.ndarray]:
    """The pixels of a label within NEAR of another, bool (h, w), by the numbers of the two; where they only touch with
    a corner they have no interface."""
    found = {}
    for other in range(len(LABELS)):
        near = ndimage.distance_transform_edt(wanted != other) <= NEAR
        for label in range(1, len(LABELS)):
            both = near & (wanted == label)
            if other != label and both.sum() >= 100:
                found[label, other] = both
    return found


def from_rim(place: Scene, made: Made, label: int, where: np.ndarray) -> float:
    """The part of some pixels of a label whose sources lie in the rim of that label's example."""
    from_depth = depth(place.labels, label)[tuple(made.sources[where].T)]
    return float(((from_depth > 0) & (from_depth <= BAND)).mean())


def rim_score(place: Scene, made: Made, label: int, paper: bool) -> float:
    """Of what lies nearest to other textures, or nearest to the paper: 0 for the example itself."""
    inside = place.wanted == label
    row, column = ndimage.distance_transform_edt(inside, return_distances=False, return_indices=True)
    part = (place.wanted[row, column] == 0) == paper
    return rim(place.texture, place.labels == label, made.picture, inside, part)


def sheet(place: Scene, *made: Made) -> Image.Image:
    """The labels and what was made of them; below, the examples and their labels."""
    wide = (3 * PANEL + GAP) // 2
    tall = wide // len(NAMES)
    page = Image.new("RGB", (3 * PANEL + 2 * GAP, PANEL + GAP + tall), "white")
    for k, picture in enumerate((LABELS[place.wanted], *(each.picture for each in made))):
        page.paste(_image(picture, (PANEL, PANEL)), (k * (PANEL + GAP), 0))
    for k, picture in enumerate((LABELS[place.labels], place.texture)):
        page.paste(_image(picture, (wide, tall)), (k * (wide + GAP), PANEL + GAP))
    return page


def _image(picture: np.ndarray, size: tuple[int, int]) -> Image.Image:
    whole = Image.fromarray((np.clip(picture, 0.0, 1.0) * 255 + 0.5).astype(np.uint8))
    return whole.resize(size, Image.Resampling.LANCZOS)


def main() -> None:
    place = scene(PANEL, 250)
    page = sheet(place, theirs(place), ours(place))
    page.quantize(256, dither=Image.Dither.FLOYDSTEINBERG).save(PICTURE, optimize=True)


if __name__ == "__main__":
    main()
