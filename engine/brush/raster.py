"""Edits of mode "raster": pic += d tex f(pic, ...), the painter's raster-op (Lewis 1984, section 6.1).

With the stroke's coverage M' and the brush's textures mixed to t, 0..1, the weight is w = M' t.  An op that gives a
colour c the target T makes c + w (T - c) of it, in straight, encoded colours; alpha stays.  Finer levels keep the part
A = 1 + w (T'(c) - 1) of their detail, T' being how a small grey change of c changes the mean of T; where a formula
gives f, T' is a difference over 1/255 to each side.  Detail of the texture itself goes on at finer levels as ink, of
the amplitude that the op has there.  `toward`, `clone`, `displace`, `predict` and `erase` lay or take paint:
A = 1 - w.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import Any, cast

import numpy as np

from engine.brush import coat, ops, sway, tones
from engine.brush.covered import Covered, Read
from engine.brush.foretell import Foretold, foretell, predictor
from engine.brush.ink import Ink, Texture, resolve
from engine.brush.mask import Coverage
from engine.brush.settings import Brush
from engine.brush.stamp import Stamp
from engine.brush.tints import constants
from engine.numeric import formula_kernel
from engine.numeric.address import TILE, Rect, TileKey
from engine.numeric.prediction import Predictor
from engine.texture.image import ImageSource
from engine.texture.planes import COLOURS, Planes, merged
from engine.texture.record import Instance

_ALPHA = 3
_STEP = np.float32(1.0 / 255.0)  # to each side, for the slope of a formula
_TINY = np.float32(1e-6)
_SPAN = 4  # px to each side over which the texture's slope is taken
_LUMA = np.array(tones.LUMA, np.float32)
_ONES = np.ones((TILE, TILE), np.float32)
_NONE = np.zeros((6, 1, 1), np.float32)


@dataclass(frozen=True, eq=False, slots=True)
class Scene:
    """What an op may look at besides the pixels under the stroke.

    `source`: reads the layer that the op names, at the stroke's level; `origin`: the stroke's, in pixels of its level;
    `pressure`: the stroke's coverage laid with the pen's pressure as opacity: the strongest that went over a pixel.
    `start`: the pixel where the stroke begins; `seed`: of what is random; `memo`: what was learnt there, kept for the
    whole stroke.
    """

    source: Read | None = None
    origin: tuple[int, int] = (0, 0)
    pressure: Coverage | None = None
    start: tuple[int, int] = (0, 0)
    seed: int = 0
    memo: dict[str, Predictor | None] = field(default_factory=dict)


def mixture(brush: Brush, textures: Mapping[str, Texture | ImageSource], level: int, seed: int) -> Ink:
    """The brush's textures mixed to one number, sum a_i s_i: the ink that they would be in white over black; those that
    go with the pressure are as at full pressure."""
    ink = tuple(replace(sway.still(part), colour="#ffffff") for part in brush.ink)
    return resolve(replace(brush, colour="#000000", ink=ink), textures, level, seed)


@dataclass(frozen=True, eq=False)
class Raster(Covered):
    """The edit that a stroke of mode "raster" makes; `ink` is its `mixture`, None for a brush without textures."""

    scene: Scene = field(default_factory=Scene)

    @cached_property
    def op(self) -> ops.Chosen:
        return ops.chosen(self.brush.op)

    @cached_property
    def spares_alpha(self) -> bool:
        return self.locked or self.op.row is None or self.op.row.name not in _LAID

    @cached_property
    def _colour(self) -> np.ndarray:
        return np.array(self.brush.rgb, np.float32)

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        covered = _plane(self.coverage, key)
        if covered is None:
            return None
        texture = self._texture(key)
        weight, free = np.empty_like(_ONES), np.empty_like(_ONES)
        if not tones.weigh(covered, _ONES if self.op.by_texture else texture, weight, free):
            return None
        if self.op.row is not None and self.op.row.name in _LAID:
            return _LAID[self.op.row.name](self, key, old, weight, free)
        return self._change(key, old, covered, texture, weight, free)

    def _texture(self, key: TileKey) -> np.ndarray:
        """The textures mixed over a tile, not cut off: float32 (128, 128), not to be written to."""
        if self.ink is None or not self.brush.ink:
            return _ONES
        seen = self.ink.field(key)
        if self._grey:
            return seen[0]
        return np.einsum("chw,c->hw", seen, _LUMA)

    @cached_property
    def _grey(self) -> bool:
        assert self.ink is not None
        return all(_single(cast(Hashable, part.instance), self.level) for part in self.ink.loaded)

    def _over(self, rect: Rect) -> np.ndarray:
        """As `_texture`, cut to 0..1, over any rectangle."""
        if self.ink is None or not self.brush.ink:
            return np.ones((rect.height, rect.width), np.float32)
        out = np.broadcast_to(self.ink.base[:, None, None], (3, rect.height, rect.width)).copy()
        for part in self.ink.loaded:
            out += part.amplitude[:, None, None] * part.instance.appearance(self.level, rect)[:3]
        return np.clip(np.einsum("chw,c->hw", out, _LUMA), 0.0, 1.0)

    def _gains(self, inks: tuple) -> np.ndarray:
        """What one unit of each ink adds to the texture; 0 for those that are not the brush's, or are coloured."""
        own = {part.instance: part.amplitude[0] for part in self.ink.loaded} if self.ink is not None else {}
        # Others may have been painted finer: they have no appearance at this level.
        gains = [own[made] if made in own and _single(made, self.level) else 0.0 for made in inks]
        return np.array(gains, np.float32)

    def _change(
        self,
        key: TileKey,
        old: Planes,
        covered: np.ndarray,
        texture: np.ndarray,
        weight: np.ndarray,
        free: np.ndarray,
    ) -> Stamp:
        """The stamp of an op that changes colours and spares alpha."""
        inks = merged(old.inks, () if self.ink is None else self.ink.inks)
        code, parameters, table = self._constants
        if code == tones.FORMULA:
            given = self._formula(key, old, covered, texture, weight)
        elif code in (tones.GIVEN, tones.SHARPEN):
            given = self._mean(key, old)
        else:
            given = _NONE
        keep = np.empty_like(_ONES)
        add = np.empty((COLOURS + 3 * len(inks), TILE, TILE), np.float32)
        before, shape = np.ascontiguousarray(old.data), (3, TILE, TILE)
        c = np.empty((3, TILE * TILE), np.float32)
        tones.straight(before[:COLOURS].reshape(COLOURS, -1), c)
        along = np.ascontiguousarray(texture).reshape(-1)
        t, s = tones.targets(code, c, self._colour, parameters, table, along, given.reshape(len(given), -1))
        tones.change(
            before, _where(old.inks, inks), weight, free, c.reshape(shape), t.reshape(shape), s.reshape(shape),
            code == tones.TEXTURE_RAMP, self._gains(inks), keep, add,
        )  # fmt: skip
        return Stamp(keep, add, inks)

    @cached_property
    def _constants(self) -> tuple[int, np.ndarray, np.ndarray]:
        return constants(self.op)

    def _mean(self, key: TileKey, old: Planes) -> np.ndarray:
        """The straight colours around each pixel, float32 (3, 128, 128): its own where nothing lies around."""
        assert self.read is not None
        reach = round(self.op.parameters["reach"])
        around = self.read(key.rect.grown(2 * reach)).data[:COLOURS]
        mean = coat.local_mean(np.ascontiguousarray(around), reach)
        return _straight(mean, old)

    def _formula(
        self, key: TileKey, old: Planes, covered: np.ndarray, texture: np.ndarray, weight: np.ndarray
    ) -> np.ndarray:
        """Targets and slopes of the artist's formula, float32 (6, 128, 128)."""
        assert self.op.tree is not None
        run = formula_kernel.kernel(self.op.tree)
        pressure = covered if self.scene.pressure is None else _plane(self.scene.pressure, key)
        pressure = np.zeros_like(_ONES) if pressure is None else pressure
        x = np.arange(TILE, dtype=np.float32) + np.float32(key.rect.x0 - self.scene.origin[0] + 0.5)
        y = np.arange(TILE, dtype=np.float32) + np.float32(key.rect.y0 - self.scene.origin[1] + 0.5)
        tex = np.clip(texture, 0.0, 1.0)
        across, down = np.tile(x, TILE), np.repeat(y, TILE)
        rows = [np.ascontiguousarray(plane).reshape(-1) for plane in (tex, covered, pressure, across, down)]
        colours = _straight(old.data[:COLOURS], old)
        bright = np.einsum("chw,c->hw", colours, _LUMA).reshape(-1)
        flat, f = weight.reshape(-1), np.empty(TILE * TILE, np.float32)
        out = np.empty((6, TILE * TILE), np.float32)
        over = 1.0 / np.maximum(flat, _TINY)

        def made(pic: np.ndarray, luma: np.ndarray, channel: int) -> np.ndarray:
            run(pic, luma, *rows, float(self._colour[channel]), float(self.level), f)
            return np.clip(pic + flat * f, 0.0, 1.0)

        for channel in range(3):
            pic = colours[channel].reshape(-1)
            out[channel] = pic + (made(pic, bright, channel) - pic) * over
            low, high = np.maximum(pic - _STEP, 0.0), np.minimum(pic + _STEP, 1.0)
            up = made(high, np.minimum(bright + _STEP, 1.0), channel)
            slope = (up - made(low, np.maximum(bright - _STEP, 0.0), channel)) / (high - low)
            out[3 + channel] = 1.0 + (np.clip(slope, -4.0, 4.0) - 1.0) * over
        return out.reshape(6, TILE, TILE)

    # ---- ops that lay or take paint ---------------------------------------------------------------------------------

    def _toward(self, key: TileKey, old: Planes, weight: np.ndarray, free: np.ndarray) -> Stamp | None:
        keep = np.empty_like(_ONES)
        if not coat.keep_of(weight, keep):
            return None
        inks = () if self.ink is None else self.ink.inks
        add = np.empty((COLOURS + 3 * len(inks), TILE, TILE), np.float32)
        coat.wash(coat.weigh(keep, old.data[_ALPHA], self.locked, add[_ALPHA]), self._colour, add[:_ALPHA])
        if inks:
            below = np.ascontiguousarray(old.data)
            tones.spray(keep, free, self._colour, below, _where(old.inks, inks), self._gains(inks), add)
        return Stamp(keep, add, inks)

    def _clone(self, key: TileKey, old: Planes, weight: np.ndarray, free: np.ndarray) -> Stamp | None:
        assert self.scene.source is not None
        dx, dy = self.op.parameters["offset"]
        rect = key.rect
        found = self.scene.source(Rect(rect.x0 + dx, rect.y0 + dy, rect.x1 + dx, rect.y1 + dy))
        return self._lay(found.data.copy(), found.inks, old, weight)

    def _displace(self, key: TileKey, old: Planes, weight: np.ndarray, free: np.ndarray) -> Stamp | None:
        assert self.read is not None
        distance, angle = self.op.parameters["distance"], math.radians(self.op.parameters["angle"])
        along, aside = distance * math.cos(angle), distance * math.sin(angle)
        if self.op.by_texture:
            t = self._over(key.rect.grown(_SPAN))
            middle = slice(_SPAN, -_SPAN)
            slopes = t[middle, : -2 * _SPAN] - t[middle, 2 * _SPAN :], t[: -2 * _SPAN, middle] - t[2 * _SPAN :, middle]
            right = along * slopes[0] - aside * slopes[1]
            down = aside * slopes[0] + along * slopes[1]
        else:
            right, down = np.full_like(_ONES, along), np.full_like(_ONES, aside)
        reach = 2 * (math.ceil(distance * math.sqrt(2.0)) // 2 + 2)
        around = np.ascontiguousarray(self.read(key.rect.grown(reach)).data[:COLOURS])
        paint = np.empty((COLOURS, TILE, TILE), np.float32)
        tones.moved(around, (-right).astype(np.float32), (-down).astype(np.float32), paint)
        return self._lay(paint, (), old, weight)

    def _predict(self, key: TileKey, old: Planes, weight: np.ndarray, free: np.ndarray) -> Stamp | None:
        return None if self._foretold is None else self._lay(self._foretold.over(key.rect), (), old, weight)

    @cached_property
    def _foretold(self) -> Foretold | None:
        """None where nothing is painted that could be continued."""
        assert self.read is not None
        memo = self.scene.memo
        if "predictor" not in memo:
            window, reach = (round(self.op.parameters[name]) for name in ("window", "reach"))
            memo["predictor"] = predictor(self.read, self.scene.start, window, reach)
        found = memo["predictor"]
        return None if found is None else foretell(self.coverage, self.read, found, self.scene.seed)

    def _erase(self, key: TileKey, old: Planes, weight: np.ndarray, free: np.ndarray) -> Stamp | None:
        keep = np.empty_like(_ONES)
        if self.locked or not coat.keep_of(weight, keep):
            return None
        return Stamp(keep, np.zeros((COLOURS, TILE, TILE), np.float32), plain=True)

    def _lay(self, paint: np.ndarray, inks: tuple, old: Planes, weight: np.ndarray) -> Stamp | None:
        """A = 1 - w, B = w times `paint`, premultiplied float32 (4 + 3n, 128, 128), which is used up; under alpha
        lock, its straight colour times the alpha that lies there, and w times its alpha."""
        keep = np.empty_like(_ONES)
        if self.locked:
            weight = weight * paint[_ALPHA]
            np.divide(paint, paint[_ALPHA].copy(), out=paint, where=paint[_ALPHA] > 0.0)
        if not coat.keep_of(weight, keep):
            return None
        add = np.empty_like(paint)
        kept = coat.weigh(keep, old.data[_ALPHA], self.locked, add[_ALPHA])
        coat.glaze(kept, paint[:_ALPHA], add[:_ALPHA])
        coat.glaze(kept, paint[COLOURS:], add[COLOURS:])
        if not self.locked:
            coat.glaze(kept, paint[_ALPHA : _ALPHA + 1], add[_ALPHA : _ALPHA + 1])
        return Stamp(keep, add, inks, plain=True)


_LAID: dict[str, Callable[..., Stamp | None]] = {
    "toward": Raster._toward,
    "clone": Raster._clone,
    "displace": Raster._displace,
    "predict": Raster._predict,
    "erase": Raster._erase,
}


def _plane(coverage: Coverage, key: TileKey) -> np.ndarray | None:
    """M of a tile as float32 (128, 128), None where it is nothing."""
    covered: Any = coverage.tiles.get(key)
    if covered is None or isinstance(covered, np.ndarray):
        return covered
    return np.full((TILE, TILE), covered, np.float32) if covered > 0.0 else None


def _straight(planes: np.ndarray, old: Planes) -> np.ndarray:
    """Straight colours (3, h, w) of premultiplied `planes`; those of `old` where there are none."""
    alpha = planes[_ALPHA]
    below = np.clip(old.data[:_ALPHA] / np.maximum(old.data[_ALPHA], _TINY), 0.0, 1.0)
    return np.where(alpha > 0.0, np.clip(planes[:_ALPHA] / np.maximum(alpha, _TINY), 0.0, 1.0), below)


@lru_cache(256)
def _single(made: Hashable, level: int) -> bool:
    """Whether a texture has one number a pixel."""
    return len(cast(Instance, made).appearance(level, Rect(0, 0, 1, 1))) == 1


def _where(inks: tuple, into: tuple) -> np.ndarray:
    """For each of the 3n planes of the inks `into`, its place among the planes of a stack with `inks`, -1 for none."""
    places = {made: COLOURS + 3 * i for i, made in enumerate(inks)}
    return np.array([places[m] + c if m in places else -1 for m in into for c in range(3)], np.int64)
