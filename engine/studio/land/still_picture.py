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
from engine.keeping.giving_way import give_way
from engine.keeping.memory import give_back
from engine.numeric.address import Rect
from engine.painting.value import Painting
from engine.studio.easel import Easel
from engine.studio.land.land_records import AskStill, StillCome
from engine.studio.requests import Handlers
from engine.studio.results import frozen
from engine.terrain.camera import CELLS, Camera, Windows, windows_of
from engine.terrain.drape import cover_of
from engine.terrain.finer_land import FinerPicture, roomy
from engine.terrain.land_picture import Shot, refinement
from engine.terrain.picture_error import picture_error
from engine.terrain.plane import land
from engine.terrain.seen_parts import PART_WINDOWS

_SAMPLES = 16
_FINE = 0.3  # pixels by which land may lie elsewhere, as a rule, in the last picture
STILL_CACHE = 16 << 20  # bytes of evaluated tiles
_COARSER_FIRST = 4  # pixels to one of the picture that comes first


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
            with turn:
                with suppress(Cancelled):
                    if not gone.is_set():
                        _take(painting, request, gone.is_set, send)
                give_back()

        threading.Thread(target=work, name="inkfall land", daemon=True).start()


def _take(painting: Painting, request: AskStill, gone: Callable[[], bool], send: Callable[[StillCome], None]) -> None:
    """Sends a picture that becomes sharper; Cancelled as soon as it is not wanted any more."""
    eye = request.eye
    assert eye is not None
    seen = land(painting, cache=TileCache(STILL_CACHE))
    wet = seen.sea != 0.0
    cover = cover_of(seen, wet)
    camera = Camera(0, eye.x, eye.y, request.clear, eye.azimuth, eye.tilt, eye.fov)
    finest = camera.finest(request.size)
    by = Fraction(2) ** finest
    foot = Rect.at(math.floor(eye.x * by), math.floor(eye.y * by), 1, 1)
    ground = float(seen.height(finest, foot)[0, 0])
    camera = replace(camera, height=max(eye.z - (max(ground, 0.0) if wet else ground), 2.0**-finest))
    wide = painting.frame.width

    def shown(by: int, cells: int) -> tuple[Shot, Windows]:
        size = -(-request.size[0] // by), -(-request.size[1] // by)
        shot = Shot(camera, size, _SAMPLES, wet=wet)
        room = PART_WINDOWS if by == 1 else 0
        return shot, windows_of(seen, camera, cover, camera.finest(size), wet, cells, by == 1, gone, room)

    def first() -> StillCome:
        shot, windows = shown(_COARSER_FIRST, CELLS // _COARSER_FIRST)
        stage = next(iter(refinement(windows, replace(shot, samples=1), wide, gone, quarter=False)))
        return StillCome(request.number, frozen(stage.picture), _COARSER_FIRST, last=False)

    send(first())  # whose windows are gone before those of the whole picture are made
    shot, windows = shown(1, CELLS)
    found = picture_error(seen, windows, camera, request.size, gone)
    give_back()  # what came and went while heights and their error were worked out: as much again, and more
    error = None if found is None else (found.rms, found.hard)
    for stage in refinement(windows, shot, wide, gone, quarter=False):
        last = stage.samples == _SAMPLES and (found is None or found.rms <= _FINE)
        send(StillCome(request.number, frozen(stage.picture), stage.by, last, error))
    if found is not None and not last:
        give_way()
        give_back()
        windows = roomy(windows)
        picture, found = FinerPicture(seen, windows, shot, wide, gone).over(stage.picture, found)
        error = None if found is None else (found.rms, found.hard)
        send(StillCome(request.number, frozen(picture), stage.by, True, error))
