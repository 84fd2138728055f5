"""Textures with a structure: how far from their example's joint statistics, how much is copied, and what they take.

On pictures that nothing was tuned on: crops of scikit-image's photographs, and what the project paints.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import numpy as np

from bench import Figure, Skipped
from bench.clock import processor
from bench.joint_statistics import yardstick
from bench.matching import plain
from engine.makers import with_structure
from engine.numeric.address import Rect
from engine.numeric.colour import from_rgba8
from engine.texture import matching
from engine.texture.structure.copied import copied_share
from engine.texture.table import instance

SIDE = 256
YARDSTICK = 0.20  # at most, on average
GREY, COLOUR = 0.35, 0.8  # seconds at 256 x 256
PALETTES = Path(__file__).parents[2] / "palettes" / "examples"
# Of photographs: the upper left corner of what is cut out.
CROPS = {
    "gravel": (200, 250),
    "grass": (230, 20),
    "brick": (250, 240),
    "moon": (200, 120),
    "immunohistochemistry": (40, 200),
    "hubble_deep_field": (400, 500),
}
WOOD = (16, 0)  # of scikit-image's coffee: the table
INNER = 144  # pixels along the sides of smaller ones
PAINTED = ("bread", "felt", "mossy-gravel", "leaves", "rust-and-paint", "old-snow", "embroidery", "orange-pulp")


def measure(small: bool = False) -> Iterator[Figure | Skipped]:
    side, repeats = (64, 1) if small else (SIDE, 5)
    examples = pictures(side)
    examples = {"bread": examples["bread"]} if small else examples
    for structure in ("objects",) if small else with_structure.ALL[1:]:
        made = {name: textured(example, structure, side) for name, example in examples.items()}
        far = {name: yardstick(*map(_last, (examples[name], texture))) for name, texture in made.items()}
        copied = {name: copied_share(examples[name], texture) for name, texture in made.items()}
        told = ", ".join(f"{name} {value:.2f} ({copied[name]:.0%})" for name, value in far.items())
        mean = float(np.mean(list(far.values())))
        yield Figure(f"{structure}, yardstick", mean, "", "0.20", mean / YARDSTICK, 1.0, note=f"copied: {told}")
        for kind, bound in (("grey", GREY), ("colour", COLOUR)):
            example = np.concatenate([_rock(side, seed) for seed in range(1 if kind == "grey" else 3)])
            work, note = partial(textured, example, structure, side), "seconds of the processor"
            taken = min(processor(work) for _ in range(repeats))
            yield Figure(f"{structure}, {kind} {side}", taken * 1e3, "ms", f"{bound} s", taken / bound, 1.0, note=note)
    if not small:
        yield _compared("histograms alone", histograms, examples, side)
        yield _compared("pyrtools and skimage", _plainly, examples, side)


def histograms(example: np.ndarray, side: int) -> np.ndarray:
    """The old method, from picture to picture."""
    pattern = matching.analysed(example, matching.Shape().within((side, side), example.shape[1:]))
    planes = matching.matched(pattern, matching.noise(pattern.colours.count, (side, side), 1))
    return matching.matched_colours(pattern, planes)


def _plainly(example: np.ndarray, side: int) -> np.ndarray:
    """The old method as one would write it down with other libraries."""
    return np.asarray(plain(example, side)())


def _compared(
    name: str, make: Callable[[np.ndarray, int], np.ndarray], examples: dict[str, np.ndarray], side: int
) -> Figure | Skipped:
    """Another method, on the same pictures."""
    name, found = f"{name}, yardstick", {}
    try:
        for one, example in examples.items():
            found[one] = yardstick(*map(_last, (example, make(example, side))))
    except ImportError as error:
        return Skipped(name, f"{error.name} is not installed")
    mean = float(np.mean(list(found.values())))
    told = ", ".join(f"{one} {value:.2f}" for one, value in found.items())
    return Figure(name, mean, "", "0.20", mean / YARDSTICK, 1e9, note=f"for comparison: {told}")


def textured(example: np.ndarray, structure: str, side: int, seed: int = 1) -> np.ndarray:
    """From picture to picture, (C, h, w)."""
    for _, colours in with_structure.texture_steps([example], structure, 0.0, (side, side), seed):
        made = colours
    assert made is not None
    return made


def pictures(side: int) -> dict[str, np.ndarray]:
    """Examples by name, float32 (1 or 3, side, side) in 0..1; photographs only where scikit-image is installed."""
    found = {}
    try:
        from skimage import data

        for name, (top, left) in CROPS.items():
            values = np.atleast_3d(getattr(data, name)()[top : top + side, left : left + side, ...])
            found[name] = np.ascontiguousarray(np.moveaxis(values, -1, 0) / np.float32(255), np.float32)
        table = data.coffee()[WOOD[0] : WOOD[0] + INNER, WOOD[1] : WOOD[1] + INNER]
        found["wood"] = np.ascontiguousarray(np.moveaxis(table, -1, 0) / np.float32(255), np.float32)
    except ImportError:
        pass
    for name in PAINTED:
        found[name] = _painted(name, min(side, INNER))
    return found | {"rock": _rock(side, 3)}


def _rock(side: int, seed: int) -> np.ndarray:
    found = instance("rock", {"period": 24, "seed": seed}, 0, 0).appearance(0, Rect.at(0, 0, side, side))
    return np.clip(0.5 + 0.5 * found, 0.0, 1.0).astype(np.float32)


def _painted(name: str, side: int) -> np.ndarray:
    """The middle of an example of the palette, where it is opaque."""
    from engine.files.images import read_image

    planes = from_rgba8(read_image(PALETTES / f"{name}.png")[0])
    top, left = ((n - side) // 2 for n in planes.shape[1:])
    return np.ascontiguousarray(planes[:3, top : top + side, left : left + side])


def _last(picture: np.ndarray) -> np.ndarray:
    return np.moveaxis(picture, 0, -1)
