"""Getting ready for painting with examples: its kernels are loaded, or compiled where the program is new, which takes
longer than anybody holds a pen still; so that is done on a thread of its own, before the first stroke.

Everything runs once on a small painting that nobody sees.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import asdict, replace
from typing import Any

import numpy as np
from immutables import Map

from engine.brush.parts import BY_STROKE
from engine.brush.settings import Brush
from engine.canvas.composite import composite
from engine.canvas.growth import settling
from engine.canvas.reading import layer_planes
from engine.numeric.address import Rect
from engine.painting.textures import Texture
from engine.painting.value import Painting
from engine.strokes.example_maps import channels_to_json, made, read_maps
from engine.strokes.example_stroke import kind_of
from engine.strokes.example_textures import KIND
from engine.studio import faults, results
from engine.studio import requests as q
from engine.texture.example.parameters import NEW, ORIENTATION, RIM_CHANNEL
from engine.texture.image import ImageSource

_SIDE = 96  # pixels along the example: enough for several levels
_FAR = 150.0  # pixels that the stroke is long


class Warming:
    """The engine's side of `GetReady`.  `send` is called from a thread of its own."""

    def __init__(self, send: Callable[[results.Result], None]) -> None:
        self._send = send
        self._thread: threading.Thread | None = None
        self.handlers: dict[type, Callable[[Any], None]] = {q.GetReady: self._begin}

    def _begin(self, request: q.GetReady) -> None:
        if self._thread is None:  # once
            self._thread = threading.Thread(target=self._run, name="inkfall warming", daemon=True)
            self._thread.start()

    def _run(self) -> None:
        try:
            paint_once()
        except Exception as error:
            self._send(faults.told(error, "while painting with examples was made ready"))
        finally:
            self._send(results.GotReady())


def paint_once() -> None:
    """Paints with an example, looks at it from all sides, and takes some away."""
    painting = Painting(seed=1, textures=Map({"a": _texture(), "b": _told_texture()}))
    grows = Brush(radius=28.0, mode="example", example="a", hardness=1.0, example_detail=1)
    takes = replace(grows, mode="erase", depth=0.0, radius=6.0)
    follows = replace(grows, example="b", depth=1.0, control=Map({ORIENTATION: BY_STROKE}))
    for brush, x in ((grows, 0), (grows, 400), (takes, 0), (follows, 0)):  # also where no coordinate changes its sign
        painting = _drawn(painting, brush, (x, x))


def _drawn(painting: Painting, brush: Brush, origin: tuple[int, int]) -> Painting:
    live = kind_of(brush)(painting, 0, origin, brush)
    assert live.bed is not None
    points = np.zeros((2, 6))
    points[:, 0], points[:, 2] = (0.0, _FAR), 1.0
    for row in points:
        live.add(row[None])
        live.bed.follow()
    # On this thread alone: one more could not be begun any longer while the program ends.
    for growth in settling(live.bed.growth, (0, Rect.at(0, 0, 64, 64))):
        live.bed.follow(growth)
    done = live.commit()
    for level in (-1, 0, 1, 2):
        composite(done.root, level, Rect.at(-32, -32, 64, 64), layer_planes)
    return done


def _told_texture() -> Texture:
    """Returns the same with control channels."""
    maps = {ORIENTATION: {"strokes": [{"points": [[9, 48], [87, 48]]}], "turns": 8}, RIM_CHANNEL: {"width": 12}}
    channels, planes = made("b", read_maps(maps), None, np.ones((_SIDE, _SIDE), np.bool_))
    plain = _texture()
    return replace(plain, parameters=plain.parameters.set("controls", channels_to_json(channels)), control=planes)


def _texture() -> Texture:
    random = np.random.default_rng(1)
    y, x = np.mgrid[:_SIDE, :_SIDE] - (_SIDE - 1) / 2.0
    depth = _SIDE * 0.46 - np.hypot(x, y)
    alpha = np.clip(0.2 + depth / 8.0, 0.0, 1.0) * (depth > 0)  # faint at the rim: narrow strokes are widened
    planes = np.concatenate([random.random((3, _SIDE, _SIDE)) * alpha, alpha[None]]).astype(np.float32)
    return Texture(KIND, Map(asdict(NEW)), ImageSource.of("a", planes))
