"""Learnt detail: pictures at half size made finer by one octave, beside the true one; against codes and expansion.

`PSNR`: of what is foretold, without noise.  The yardstick is that of joint statistics, of all that is added.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from bench import Figure, Skipped, predicted_codes
from bench.clock import processor
from bench.joint_statistics import yardstick
from bench.structured import pictures
from engine.makers.learning import Finer, maps_for
from engine.numeric.address import TILE, Rect
from engine.numeric.grid import snapped
from engine.numeric.pyramid import reduce
from engine.texture.image import ImageSource
from engine.texture.learnt.maps import as_picture, maps_of
from engine.texture.learnt.refinement import Learning
from engine.texture.table import instance

BOUND = 250.0  # ns for a pixel with its colours and an octave
SLOWEST = 0.5  # seconds to learn from 512 x 512 pixels
BETTER = 1.0  # dB above expansion, on average


def measure(small: bool = False) -> Iterator[Figure | Skipped]:
    examples = pictures(64 if small else 256)
    examples = {"bread": examples["bread"]} if small else examples
    rows = {name: _row(_even(example)) for name, example in examples.items()}
    gains, codes = (np.array([row[k] for row in rows.values()]) for k in (0, 1))
    far, peers, blurred = (np.array([row[k] for row in rows.values()]) for k in (2, 3, 4))
    told = ", ".join(f"{name} {row[0]:+.1f} ({row[1]:+.1f})" for name, row in rows.items())
    yield Figure(
        "foretold, PSNR above expansion", float(gains.mean()), "dB", "1 dB", float(gains.mean()) / BETTER, 1.0, True,
        note=f"(codes: {codes.mean():+.2f}) {told}",
    )  # fmt: skip
    told = ", ".join(f"{name} {row[2]:.2f} ({row[3]:.2f})" for name, row in rows.items())
    yield Figure(
        "octave, yardstick", float(far.mean()), "", "that of codes", float(far.mean() / peers.mean()), 1.0,
        note=f"(codes; expansion has {blurred.mean():.2f}) {told}",
    )  # fmt: skip
    yield from _times(1 if small else 5, 64 if small else 512)


def _even(picture: np.ndarray) -> np.ndarray:
    _, height, width = picture.shape
    return np.ascontiguousarray(picture[:, : height // 2 * 2, : width // 2 * 2])


def _row(picture: np.ndarray) -> tuple[float, ...]:
    """Returns dB above expansion, of maps and of codes, and the yardsticks of both and of expansion."""
    half = reduce(picture)
    source = _source(half)
    kept = maps_for("", source)
    maps = maps_of(kept)
    assert maps is not None
    silent = as_picture("", replace(maps, loud=np.zeros(2, np.float32)))
    soft, foretold, made = (
        _octave(source, Learning(one, strength, 1), len(picture))
        for one, strength in ((kept, 0.0), (silent, 1.0), (kept, 1.0))
    )
    mean, vectors = _axes(half)
    planes = np.einsum("cr,chw->rhw", vectors, half - mean)
    book = predicted_codes.trained(planes)
    coded, drawn = (
        np.einsum("cr,rhw->chw", vectors, predicted_codes.finer(planes, book, by_chance)) + mean
        for by_chance in (False, True)
    )
    base = _decibels(soft, picture)
    gains = [_decibels(one, picture) - base for one in (foretold, coded)]
    last = [np.moveaxis(np.clip(one, 0.0, 1.0), 0, -1) for one in (picture, made, drawn, soft)]
    return (*gains, *(yardstick(last[0], one) for one in last[1:]))


def _axes(picture: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    flat = picture.reshape(len(picture), -1).astype(np.float64)
    return flat.mean(axis=1)[:, None, None], np.linalg.eigh(np.atleast_2d(np.cov(flat)))[1][:, ::-1]


def _decibels(found: np.ndarray, wanted: np.ndarray) -> float:
    return float(-10 * np.log10(np.mean(np.square(found - wanted))))


def _source(picture: np.ndarray) -> ImageSource:
    planes = np.ones((4, *picture.shape[1:]), np.float32)
    planes[:3] = picture
    return ImageSource.of("", snapped(planes))


def _octave(source: ImageSource, learning: Learning, channels: int) -> np.ndarray:
    finer = Finer(source, learning, tiles=True)
    width, height = finer.size
    return finer.planes(Rect(0, 0, width, height))[:channels]


def _times(repeats: int, side: int) -> Iterator[Figure]:
    rock = [
        instance("rock", {"period": 24, "seed": n}, 0, 0).appearance(0, Rect.at(0, 0, side, side)) for n in range(3)
    ]
    source = _source(np.clip(0.5 + 0.5 * np.concatenate(rock), 0.0, 1.0))
    learning = min(processor(lambda: maps_for("", source)) for _ in range(repeats))
    note = "seconds of the processor"
    yield Figure(f"learning from {side} x {side}", learning * 1e3, "ms", "0.5 s", learning / SLOWEST, 1.0, note=note)
    maps = maps_for("", source)
    texture = instance("image", {"detail": "learnt"}, 0, 0, source, 2, maps)
    for octave in (1, 2):
        tiles = [Rect.at(x * TILE, 0, TILE, TILE) for x in range(4)]

        def make(level: int = octave, tiles: list[Rect] = tiles) -> None:
            for tile in tiles:
                texture.bandpass(level, tile)

        make()
        taken = min(processor(make) for _ in range(repeats)) / (len(tiles) * TILE * TILE) * 1e9
        note = "with the margin; the second with the first below it, a quarter of an octave more"
        each = taken if octave == 1 else taken / 1.25
        yield Figure(f"octave {octave}, a tile", each, "ns", "250 ns a pixel and octave", each / BOUND, 1.0, note=note)
