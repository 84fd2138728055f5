"""Draws matched.png: examples, their matches by histograms as Heeger & Bergen 1995 has them, with objects and of large
pieces, mixtures and solid textures.

python palettes/pictures/make_matched.py

Needs scikit-image for its photographs of gravel and bricks (CC0); the other examples are those of the tests.
"""

from __future__ import annotations

import sys
from concurrent.futures import Executor, ThreadPoolExecutor
from pathlib import Path

import numpy as np
from PIL import Image

FOLDER = Path(__file__).resolve().parent
ROOT = FOLDER.parents[1]
sys.path[:0] = [str(ROOT), str(ROOT / "tests" / "engine" / "texture")]

import specimens  # noqa: E402

from app.cli.solid_command import cube  # noqa: E402
from engine.makers.with_structure import texture_steps  # noqa: E402
from engine.numeric.pyramid import reduce  # noqa: E402
from engine.texture import matching, mixing, solid  # noqa: E402
from engine.texture.matching import Pattern, Shape, matched, matched_colours  # noqa: E402
from engine.texture.mixing import Mix  # noqa: E402

SIDE, GAP = 128, 6  # px, of a texture and between them
SLICE = 80  # px, shown of a solid's slice
SOLIDS = ("granite", "moss", "gravel")
VOXELS = 128  # a side
STEPS = (0.0, 0.25, 0.5, 0.75, 1.0)
COLOURS = 256  # of the file

Picture = np.ndarray  # float32 (C, h, w) in 0..1


def examples() -> dict[str, Picture]:
    made = {name: specimens.STOCHASTIC[name]() for name in ("granite", "sand", "bark", "moss")}
    bricks = reduce(specimens.photograph("brick", (2 * SIDE, 2 * SIDE)))
    return made | {"gravel": specimens.photograph("gravel"), "brick": bricks, "wood": specimens.wood()}


def mixtures(found: dict[str, Picture]) -> list[Picture]:
    """Moss' colours with bark's pattern, gravel under bark's fine detail, and the way from granite to bark."""
    granite, bark, grey = found["granite"], found["bark"], found["bark"].mean(axis=0, keepdims=True)
    between = [structured([granite, bark], "statistics", weight) for weight in STEPS]
    coloured = mixing.palette(found["moss"], bark, Shape(), Mix())
    return [grown(coloured), grown(mixing.bands(found["gravel"], grey, Shape(), Mix())), *between]


def structured(examples: list[Picture], structure: str, weight: float = 0.0) -> Picture:
    """One example, or two averaged, with as much of their structure."""
    made = examples[0]
    for _, colours in texture_steps(examples, structure, weight, (SIDE, SIDE), seed=1):
        made = made if colours is None else colours
    return made


def grown(pattern: Pattern, seed: int = 1) -> Picture:
    start = matching.noise(pattern.colours.count, (SIDE, SIDE), seed)
    return matched_colours(pattern, matched(pattern, start))


def voxels(example: Picture, threads: Executor, side: int = VOXELS) -> np.ndarray:
    """A solid of an example: RGB (side, side, side, 3)."""
    wanted = solid.patterns(example, side, Shape())
    *_, last = solid.matching(wanted, solid.noise(wanted.oriented.colours.count, side, 1), threads=threads)
    assert last.planes is not None
    return coloured(matched_colours(wanted.oriented, last.planes))


def coloured(planes: Picture) -> np.ndarray:
    """Channels last, grey as RGB."""
    return np.broadcast_to(np.moveaxis(planes, 0, -1), (*planes.shape[1:], 3))


def shown(body: np.ndarray) -> np.ndarray:
    """Two slices of a solid, and three faces of it: RGB, on white."""
    drawn = cube(body, SIDE)
    scale = max(1, SIDE // len(body))
    out = np.ones((len(drawn), SLICE + GAP + drawn.shape[1], 3), np.float32)
    out[:, SLICE + GAP :] = drawn
    top = (len(drawn) - 2 * SLICE - GAP // 2) // 2
    for k in range(2):
        seen = body[len(body) * (1 + k) // 3].repeat(scale, axis=0).repeat(scale, axis=1)
        y = top + k * (SLICE + GAP // 2)
        out[y : y + SLICE, :SLICE] = seen[:SLICE, :SLICE]
    return out


def row(pictures: list[np.ndarray], width: int) -> np.ndarray:
    """Pictures of one height, spread over a width."""
    out = np.ones((len(pictures[0]) + GAP, width, 3), np.float32)
    gap = (width - sum(seen.shape[1] for seen in pictures)) // max(len(pictures) - 1, 1)
    x = 0
    for seen in pictures:
        out[: len(seen), x : x + seen.shape[1]] = seen
        x += seen.shape[1] + gap
    return out


def main() -> None:
    found = examples()
    flat = [matching.analysed(example, Shape()) for example in found.values()]
    width = len(flat) * (SIDE + GAP) - GAP
    laid = [[structured([example], structure) for example in found.values()] for structure in ("objects", "pieces")]
    textures = [list(found.values()), [grown(one) for one in flat], *laid, mixtures(found)]
    rows = [row([coloured(one) for one in line], width) for line in textures]
    with ThreadPoolExecutor() as threads:
        rows.append(row([shown(voxels(found[name], threads)) for name in SOLIDS], width))
    sheet = np.rint(np.concatenate(rows)[:-GAP] * 255.0).astype(np.uint8)
    few = Image.fromarray(sheet).quantize(COLOURS, dither=Image.Dither.FLOYDSTEINBERG)
    few.save(FOLDER / "matched.png", optimize=True)


if __name__ == "__main__":
    main()
