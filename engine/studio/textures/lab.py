"""The texture lab: a spectrum under the artist's brush, and the texture it makes while it is painted.

Strokes and settings only mark the pictures as old; they are made once when nothing else waits, so whatever is newest is
seen first.  What the lab hands to the painting is a texture command, from which anyone makes the same sample.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from engine.brush.parts import Component
from engine.checks.owned import Owned
from engine.makers import spectrum
from engine.makers.definitions import FIELDS
from engine.makers.spectrum import Sheets
from engine.numeric import shapes
from engine.numeric.address import Rect
from engine.numeric.colour import to_premul8
from engine.painting import commands as c
from engine.painting.textures import Texture
from engine.studio import requests as q
from engine.studio import results
from engine.studio.easel import Easel
from engine.studio.textures import swatches, texture_requests, texture_results
from engine.studio.textures.lab_spectrum import LabSpectrum
from engine.texture.image import ImageSource

FIELD = Rect(0, 0, 360, 360)  # the part of an endless field that is shown
NEARER = 4  # levels that the picture "lab near" is zoomed in
_TRIED = "lab"  # the texture's name in the pictures of strokes
_DARK, _COLD, _WARM = (np.array(rgb, np.float32) / 255 for rgb in ((18, 18, 21), (90, 150, 235), (245, 165, 75)))


class Lab(Owned):
    """The pictures of the spectrum, and the texture that the painting uses.  It belongs to the engine's thread."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._spectrum = LabSpectrum(easel)
        self._texture: np.ndarray | None = None
        self._used: tuple[str, c.DefineTexture | None] = ("", None)
        self._version = 0
        self.handlers: dict[type, Callable[[Any], None]] = {
            **self._spectrum.handlers,
            texture_requests.LabRest: self._rest,
            texture_requests.LabUse: self._use,
        }

    @property
    def pending(self) -> bool:
        """Tells whether there is work to do."""
        return self._spectrum.stale

    def step(self) -> None:
        """Does the next piece of work: lays a stroke anew, or makes the pictures."""
        try:
            if self._spectrum.live is None and not self._spectrum.ready:
                self._spectrum.build()
            else:
                self._show()
        except Exception:
            self._spectrum.stale = False  # it would fail again
            raise

    def settle(self) -> None:
        """Brings the texture in use up to date before it is painted with."""
        name, defined = self._used
        if name and self._spectrum.live is None and name in self._easel.session.painting.textures:
            self._spectrum.finish_building()
            if self._spectrum.stale:
                self._show()
            command = self._command(name)
            if command != defined:
                self._define(command)

    def _rest(self, request: texture_requests.LabRest) -> None:
        """Sends pictures of strokes, once nothing moves; the texture in use follows."""
        self._spectrum.finish_building()
        if self._spectrum.stale:
            self._show()
        self.settle()
        painting = self._easel.session.painting
        painting = replace(painting, textures=painting.textures.set(_TRIED, self._tried()))
        brush = replace(request.brush, ink=(Component(_TRIED, 1.0, "#f4f1ea"),), mode="paint")
        for ident, kind, zoom in (("lab stroke", "stroke", 0), ("lab near", "fill", NEARER)):
            pixels = swatches.painted(q.Swatch(ident, brush, request.size, kind, zoom), painting)
            self._easel.send(results.Picture(ident, results.frozen(to_premul8(pixels))))

    def _use(self, request: texture_requests.LabUse) -> None:
        self._used = request.name, None
        if request.name:
            self._spectrum.finish_building()
            self._show()
            self._define(self._command(request.name))
        self._tell()

    def _show(self) -> None:
        """Sends pictures of the spectrum and its texture as they are now."""
        sheets, asked = self._spectrum.sheets, self._spectrum.asked
        self._texture = spectrum.sample(sheets, self._spectrum.design)
        self._spectrum.stale = False
        self._easel.send(results.Picture("lab spectrum", _shown(sheets, asked.sheet)))
        shown = self._texture
        if asked.field.get("field") == "sparse":
            shown = self._tried().instance({}, 0, 0).appearance(0, FIELD)
        self._easel.send(results.Picture("lab texture", _pixels(0.5 + 0.5 * shown)))
        self._tell()

    def _tell(self) -> None:
        silent = self._texture is None or not self._texture.any()
        rows = tuple(shapes.SHAPES.values())
        known = self._spectrum.steps
        self._easel.send(texture_results.LabScene(rows, *known, silent, self._used[0], self._version))

    # --- the texture -------------------------------------------------------------------------------------------------

    def _command(self, name: str) -> c.DefineTexture:
        arguments = self._spectrum.design.to_arguments()
        return c.DefineTexture(name, "spectrum", arguments.update(self._spectrum.asked.field))

    def _tried(self) -> Texture:
        """Returns the texture as the command would make it, without making it again."""
        command, own = self._command(_TRIED), self._easel.session.painting.arithmetic
        return Texture(
            FIELDS[command.arguments.get("field", "tile")], command.arguments, self._source(_TRIED), None, own
        )

    def _source(self, name: str) -> ImageSource:
        assert self._texture is not None
        return ImageSource.of(name, spectrum.spectrum_picture(self._texture))

    def _define(self, command: c.DefineTexture) -> None:
        """Defines the texture in the painting; its sample is here already, and is not made of the strokes again."""
        self._used = command.name, command
        self._version += 1
        source = self._source(command.name)
        self._easel.carry_out(replace(command, arguments=command.arguments.set("sha", source.sha)), source)
        self._tell()


def _shown(sheets: Sheets, sheet: str) -> np.ndarray:
    """Returns a sheet as the panel shows it: amplitudes from dark to light, phases from cold over dark to warm."""
    if sheet == "amplitude":
        return _pixels(_DARK[:, None, None] + sheets.amplitude * (1.0 - _DARK[:, None, None]))
    turn = 2.0 * sheets.phase - 1.0
    ends = np.where(turn < 0.0, _COLD[:, None, None], _WARM[:, None, None])
    return _pixels(_DARK[:, None, None] + np.abs(turn) * (ends - _DARK[:, None, None]))


def _pixels(planes: np.ndarray) -> np.ndarray:
    """Opaque uint8 (h, w, 4) of planes (1 or 3, h, w), 0..1."""
    out = np.full((*planes.shape[1:], 4), 255, np.uint8)
    scaled = np.clip(planes, 0.0, 1.0) * np.float32(255) + np.float32(0.5)
    out[..., :3] = scaled.astype(np.uint8).transpose(1, 2, 0)
    return results.frozen(out)
