"""The picture of land by rays while the eye rests: worked out on threads of its own, so that no stroke waits for it."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from fractions import Fraction

from engine.canvas.tile_cache import TileCache
from engine.checks.owned import Owned
from engine.files.fault import Cancelled
from engine.numeric.address import Rect
from engine.painting.value import Painting
from engine.studio.easel import Easel
from engine.studio.land.land_records import AskStill, StillCome
from engine.studio.requests import Handlers
from engine.studio.results import frozen
from engine.terrain.camera import Camera, Windows, windows_of
from engine.terrain.drape import cover_of
from engine.terrain.land_picture import Shot, refinement
from engine.terrain.plane import Land, land

_SAMPLES = 16
_CACHE = 32 << 20  # bytes
_FADES = 0.28  # of half a window, in which it becomes the next coarser one
_CELLS_PER_PIXEL = 1.2  # of a window, from which on the next coarser one may be seen


class StillPictures(Owned):
    """It belongs to the engine's thread.  The newest `AskStill` counts: one thread at a time works, and looks every
    some milliseconds whether its picture is still wanted."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._gone = threading.Event()  # set: the picture that was asked for last is not wanted any more
        self._turn = threading.Lock()
        self.handlers: Handlers = {AskStill: self._ask}

    def _ask(self, request: AskStill) -> None:
        self._gone.set()
        if request.eye is None:
            return
        gone = self._gone = threading.Event()
        painting, send, turn = self._easel.session.painting, self._easel.send, self._turn

        def work() -> None:
            with turn, suppress(Cancelled):
                if not gone.is_set():
                    _take(painting, request, gone.is_set, send)

        threading.Thread(target=work, name="inkfall land", daemon=True).start()


def _take(painting: Painting, request: AskStill, gone: Callable[[], bool], send: Callable[[StillCome], None]) -> None:
    """Sends a picture that becomes sharper; Cancelled as soon as it is not wanted any more."""
    eye = request.eye
    assert eye is not None
    seen = land(painting, cache=TileCache(_CACHE))
    wet = seen.sea != 0.0
    cover = cover_of(seen, wet)
    camera = Camera(0, eye.x, eye.y, request.clear, eye.azimuth, eye.tilt, eye.fov)
    finest = camera.finest(request.size)
    by = Fraction(2) ** finest
    foot = Rect.at(math.floor(eye.x * by), math.floor(eye.y * by), 1, 1)
    ground = float(seen.height(finest, foot)[0, 0])
    camera = replace(camera, height=max(eye.z - (max(ground, 0.0) if wet else ground), 2.0**-finest))
    shot = Shot(camera, request.size, _SAMPLES, wet=wet)
    windows = windows_of(seen, camera, cover, camera.finest(shot.size), wet)
    error = _error(seen, windows, camera, request.size[0])
    for stage in refinement(windows, shot, painting.frame.width, gone):
        if gone():
            raise Cancelled
        last = stage.samples == _SAMPLES
        send(StillCome(request.number, frozen(stage.picture), stage.by, last, error))


def _error(seen: Land, windows: Windows, camera: Camera, width: int) -> float | None:
    """Returns by how many pixels of the picture the land may lie elsewhere than its windows have it, at most: each
    window is seen no nearer than where the next finer one ends."""
    finest, cells = windows.levels[-1], windows.heights.shape[1] - 1
    cone = 2.0 * math.tan(math.radians(camera.fov) / 2) / width
    nearest = max(windows.eye, 1e-9)
    worst = 0.0
    by = Fraction(2) ** finest
    for level, (x, y, side) in list(zip(windows.levels, windows.places.tolist(), strict=True))[::-1]:
        first = [
            round((Fraction(at) + place * by) / Fraction(side) - Fraction(1, 2))
            for at, place in ((x, camera.x), (y, camera.y))
        ]
        found = seen.bound(level, Rect.at(first[0], first[1], cells + 1, cells + 1))
        if found is None:
            return None
        worst = max(worst, math.ldexp(found.hard, finest) / (nearest * cone))
        ends = cells * side * (1.0 - _FADES)
        nearest = max(nearest, min(_inside((x, y), ends, camera), _CELLS_PER_PIXEL * side / cone))
    return worst


def _inside(first: tuple[float, float], side: float, camera: Camera) -> float:
    """Returns how far one looks within a window, from the foot, in the direction in which it ends soonest."""
    found = math.inf
    for part in (-1.0, -0.5, 0.0, 0.5, 1.0):
        turn = math.radians(camera.azimuth + part * camera.fov / 2)
        for at, d in zip(first, (math.sin(turn), -math.cos(turn)), strict=True):
            if d:
                found = min(found, max(0.0, at / d, (at + side) / d))
    return found
