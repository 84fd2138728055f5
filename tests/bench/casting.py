"""Rays over land: a picture's, from where their block has nothing before it, against each from the eye; CPU time."""

from __future__ import annotations

import os
from collections.abc import Iterator
from fractions import Fraction

import numpy as np

from bench import Figure
from bench.clock import processor
from engine.numeric.address import Rect
from engine.numeric.kernel import kernel
from engine.painting.value import Painting
from engine.terrain import daylight
from engine.terrain.beams import clear_until
from engine.terrain.camera import Camera, Windows, windows_of
from engine.terrain.caster import cast, nearest_land
from engine.terrain.drape import Cover
from engine.terrain.land_picture import Shot, exposed, eye_of, numbers_of
from engine.terrain.plane import Land

SAMPLES = 9
BLOCK = 8


class Ridges(Land):
    """Land of a formula that never ends: each octave half as long, and .55 as high."""

    def height(self, level: int, rect: Rect, about: object = None) -> np.ndarray:
        x, y = ((np.arange(a, b) + 0.5) / 2.0**level for a, b in ((rect.x0, rect.x1), (rect.y0, rect.y1)))
        x, y = x[None], y[:, None]
        out = np.zeros((rect.height, rect.width))
        for k in range(9 + level):
            turn, by = 2.4 * k, 2.0**k / 97.0
            u, v = x * np.cos(turn) + y * np.sin(turn), y * np.cos(turn) - x * np.sin(turn)
            out += 70.0 * 0.55**k * (1.0 - np.abs(np.sin(u * by + k + 0.7 * np.sin(v * by))))
        return out


@kernel
def primary(
    heights: np.ndarray,
    tops: np.ndarray,
    mips: np.ndarray,
    places: np.ndarray,
    eye: np.ndarray,
    numbers: np.ndarray,
    hits: np.ndarray,
) -> None:
    """Distances (h, w) at which a ray of each pixel meets land, -1 where none does."""
    corners, d, box = np.empty((4, 3)), np.empty(3), np.empty(5)
    cone, highest, far = numbers[daylight.CONE], numbers[daylight.TOP_HEIGHT], numbers[daylight.FARTHEST]
    for top in range(0, hits.shape[0], BLOCK):
        for left in range(0, hits.shape[1], BLOCK):
            daylight.beam_corners(eye, left, top, BLOCK, corners)
            begin = clear_until(heights, tops, mips, places, eye[0], corners, cone, highest, 0.0, far, box)
            for y in range(top, min(top + BLOCK, hits.shape[0])):
                for x in range(left, min(left + BLOCK, hits.shape[1])):
                    size = 0.0
                    for c in range(3):
                        d[c] = eye[3, c] + x * eye[1, c] - y * eye[2, c]
                        size += d[c] * d[c]
                    size = np.sqrt(size)
                    for c in range(3):
                        d[c] /= size
                    hits[y, x] = nearest_land(
                        heights, tops, mips, places, eye[0], d, begin * size, far, cone, daylight.NEAR
                    )[0]


def _rays(eye: np.ndarray, size: tuple[int, int]) -> np.ndarray:
    """One of each pixel, from the eye."""
    y, x = np.mgrid[: size[1], : size[0]][:, :, :, None]
    d = eye[3] + x * eye[1] - y * eye[2]
    d /= np.linalg.norm(d, axis=2, keepdims=True)
    return np.concatenate([np.broadcast_to(eye[0], d.shape), d], 2).reshape(-1, 6).copy()


def _windows(cells: int, size: tuple[int, int]) -> tuple[Windows, Shot]:
    land = Ridges(Painting(Rect.at(0, 0, 1024, 768), 1), "composite", 1.0, 0.0, 0.0)
    shot = Shot(Camera(0, Fraction(512), Fraction(700), 60.0, 0.0, -9.0, 60.0), size, SAMPLES)
    return windows_of(land, shot.camera, Cover(None, 0.0, 160.0), shot.camera.finest(size), cells=cells), shot


def measure(small: bool) -> Iterator[Figure]:
    size = (96, 64) if small else (1280, 800)
    windows, shot = _windows(64 if small else 1024, size)
    tables = windows.heights, windows.tops, windows.mips, windows.places
    numbers, eye = numbers_of(windows, shot, 1024, (0, SAMPLES)), eye_of(windows, shot, 1)
    rays, met, hits = _rays(eye, size), np.empty((size[0] * size[1], 2)), np.empty(size[::-1])
    works = (
        lambda: cast(*tables, rays, met),
        lambda: primary(*tables, eye, numbers, hits),
        lambda: exposed(windows, shot, 1024),
    )
    for work in works:
        work()
    turns = [[processor(work) for work in works] for _ in range(1 if small else 3)]
    plain, blocks, picture = (min(column) for column in zip(*turns, strict=True))
    speed, slow = len(rays) / blocks / 1e6, len(rays) / plain / 1e6
    note = f"{slow:.3g} Mrays/s one by one; {(hits >= 0).mean():.0%} meet land"
    yield Figure("primary rays, on a core", speed, "Mrays/s", "each from the eye", speed / slow, 1.3, True, note)
    name = f"{size[0]} x {size[1]}, {SAMPLES} samples, shadows"
    each = picture / (SAMPLES * plain)
    note = f"CPU time: divided by cores, of which there are {os.cpu_count()}, what one waits"
    yield Figure(name, picture, "s", "its primary rays, each from the eye", each, 2.0, note=note)
