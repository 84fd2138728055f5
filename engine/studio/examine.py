"""What a part of the painting is made of, found piece by piece while nothing else waits (Lewis 1984, figures 1, 4)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from immutables import Map

from engine.checks.owned import Owned
from engine.numeric.address import Rect
from engine.numeric.analysis import Analysis
from engine.numeric.colour import to_rgba8
from engine.studio import requests as q
from engine.studio import results
from engine.studio.easel import Easel
from engine.studio.textures import texture_results as tr

_MOST = 1 << 22  # pixels looked at; a larger rectangle is looked at from a coarser level
_STRIP = 256  # rows read in one step
_FLOOR = 60.0  # decibels below the loudest that are still told from silence
_RGB = ((18, 18, 21), (196, 92, 58), (255, 244, 214), (70, 130, 215))
_DARK, _MID, _LIGHT, _COLD = (np.array(rgb, np.float32) for rgb in _RGB)


class Examiner(Owned):
    """It belongs to the engine's thread.  One step finds one fact; a newer request drops the older."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._work: Iterator[tr.Found] | None = None
        self.handlers: dict[type, Callable[[Any], None]] = {q.Analyse: self._ask}

    @property
    def pending(self) -> bool:
        """Tells whether there is something left to find."""
        return self._work is not None

    def step(self) -> None:
        """Finds and sends the next fact."""
        found = None
        try:
            found = next(self._work) if self._work is not None else None
        finally:
            if found is None or found.done:
                self._work = None
        if found is not None:
            self._easel.send(found)

    def _ask(self, request: q.Analyse) -> None:
        self._work = None if request.area is None else self._found(request.level, request.area)

    def _found(self, level: int, area: Rect) -> Iterator[tr.Found]:
        """Everything known so far, again and again."""
        while area.area > _MOST:
            level, area = level - 1, area.zoomed(-1)
        lines = {"Size": f"{area.width:,} × {area.height:,} px", "Level": str(level)}
        pictures: list[str] = []

        def told(done: bool = False) -> tr.Found:
            return tr.Found(Map(lines), rings, tuple(pictures), done)

        rings: tuple[tuple[float, float, float], ...] = ()
        pixels = np.empty((area.height, area.width, 4), np.uint8)
        for top in range(0, area.height, _STRIP):
            strip = Rect(area.x0, area.y0 + top, area.x1, min(area.y0 + top + _STRIP, area.y1))
            pixels[top : top + _STRIP] = to_rgba8(self._easel.picture(level, strip))
            yield told()
        facts = Analysis(pixels)
        lines["Colours"] = f"{facts.colours:,}"
        yield told()
        lines["Regions"] = f"{facts.regions:,}"
        yield told()
        self._send("analysis regions", _square(facts.false_coloured[..., :3]), pictures)
        yield told()
        self._send("analysis power", _heat(_decibels(facts.power)), pictures)
        yield told()
        self._send("analysis correlation", _signed(_middle(facts.autocorrelation)), pictures)
        yield told()
        self._send("analysis poles", _heat(_decibels(facts.all_pole)), pictures)
        rings = tuple(zip(*(column.tolist() for column in facts.radial), strict=True))
        lines["Model"] = facts.predictor.verdict
        lines["Falls as"] = "—" if facts.slope is None else f"1/f^{facts.slope:.2f}"
        yield told(done=True)

    def _send(self, ident: str, rgb: np.ndarray, pictures: list[str]) -> None:
        out = np.full((*rgb.shape[:2], 4), 255, np.uint8)
        out[..., :3] = rgb
        self._easel.send(results.Picture(ident, results.frozen(out)))
        pictures.append(ident)


def _decibels(power: np.ndarray) -> np.ndarray:
    """Power as brightness, 0..1: the loudest 1, what lies _FLOOR below it 0."""
    most = float(power.max(initial=0.0))
    if most <= 0.0:
        return np.zeros(power.shape, np.float32)
    return (1.0 + 10.0 / _FLOOR * np.log10(np.maximum(power / most, 1e-30))).clip(0.0, 1.0).astype(np.float32)


def _middle(correlation: np.ndarray) -> np.ndarray:
    """Displacements of up to a quarter of the shorter side: those beyond have too little overlap to mean much."""
    height, width = correlation.shape
    reach = max(min(height, width) // 4, 1)
    y, x = height // 2, width // 2
    return correlation[max(y - reach, 0) : y + reach + 1, max(x - reach, 0) : x + reach + 1].clip(-1.0, 1.0)


def _signed(values: np.ndarray) -> np.ndarray:
    """Returns values -1..1: what is alike from dark over red to light, what is opposite from dark to blue."""
    cold = _DARK - values[..., None].astype(np.float32) * (_COLD - _DARK)
    return np.where(values[..., None] < 0.0, cold, _heat(np.maximum(values, 0.0))).astype(np.uint8)


def _square(rgb: np.ndarray) -> np.ndarray:
    """Returns a picture in the middle of a dark square, as large as it must be."""
    height, width = rgb.shape[:2]
    side = max(height, width)
    out = np.empty((side, side, 3), np.uint8)
    out[...] = _DARK
    top, left = (side - height) // 2, (side - width) // 2
    out[top : top + height, left : left + width] = rgb
    return out


def _heat(values: np.ndarray) -> np.ndarray:
    """Returns values 0..1 from dark over red to light: uint8 (h, w, 3)."""
    t = values.astype(np.float32)[..., None]
    low, high = _DARK + 2.0 * t * (_MID - _DARK), _MID + (2.0 * t - 1.0) * (_LIGHT - _MID)
    return np.where(t < 0.5, low, high).astype(np.uint8)
