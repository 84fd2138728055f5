"""The layers of a Photoshop file (PSD, PSB), read by psd-tools: their pixels, masks laid on them.

What has no pixels (adjustments, effects) cannot be shown; it is told in the notes.
"""

from __future__ import annotations

import logging
import struct
import warnings
from collections.abc import Iterator
from typing import BinaryIO

import numpy as np
from psd_tools import ParseLimits, PSDImage
from psd_tools.api.layers import Group, Layer
from psd_tools.compression import PSDDecompressionWarning
from psd_tools.constants import BlendMode, ColorMode

from engine.files.fault import FileError, TooMuch, reason_of, shown
from engine.files.layered.layer_sheet import FoundGroup, FoundLayers, FoundPicture
from engine.files.limits import LIMITS, memory_cap

_FILE = 1 << 31  # bytes of a file, which is read as a whole
_HEAD = struct.Struct(">4s8xHII")  # channels, height, width
_SIDE, _CHANNELS = 300_000, 56  # as the format has them
_PLAIN = (ColorMode.RGB, ColorMode.GRAYSCALE)
_BLENDS = {
    BlendMode.PASS_THROUGH: "src-over",
    BlendMode.NORMAL: "src-over",
    BlendMode.DARKEN: "darken",
    BlendMode.MULTIPLY: "multiply",
    BlendMode.COLOR_BURN: "color-burn",
    BlendMode.LIGHTEN: "lighten",
    BlendMode.SCREEN: "screen",
    BlendMode.COLOR_DODGE: "color-dodge",
    BlendMode.LINEAR_DODGE: "plus",
    BlendMode.OVERLAY: "overlay",
    BlendMode.SOFT_LIGHT: "soft-light",
    BlendMode.HARD_LIGHT: "hard-light",
    BlendMode.DIFFERENCE: "difference",
    BlendMode.HUE: "hue",
    BlendMode.SATURATION: "saturation",
    BlendMode.COLOR: "color",
    BlendMode.LUMINOSITY: "luminosity",
}
# A channel that cannot be unpacked would be black: it is a damaged file.  What is wrong is told in our own line.
warnings.filterwarnings("error", category=PSDDecompressionWarning)
logging.getLogger("psd_tools").setLevel(logging.CRITICAL)


def _check_head(file: BinaryIO, name: str) -> None:
    """Raises FileError if a head tells a size that none has; whatever else is wrong, the library finds."""
    head = file.read(_HEAD.size)
    file.seek(0)
    if len(head) < _HEAD.size:
        return
    sign, channels, height, width = _HEAD.unpack(head)
    if sign == b"8BPS" and not (0 < width <= _SIDE and 0 < height <= _SIDE and 0 < channels <= _CHANNELS):
        found = f"{width} x {height} pixels in {channels} channels"
        raise FileError(name, f"{found}; expected 1 to {_SIDE} each way, 1 to {_CHANNELS}")


class PsdLayers:
    """A Photoshop file as a `LayeredReader`.  Whatever its numbers make the library say is a FileError."""

    def __init__(self, file: BinaryIO, name: str) -> None:
        self._name = name
        self._notes: list[str] = []
        self._layers: list[Layer | PSDImage] = []
        self._image = self._opened(file)
        try:
            self.found = self._all()
        except (FileError, MemoryError):
            raise
        except Exception as error:  # of any kind: the library trusts what it has parsed
            raise self._fault("its layers", error) from error

    def bands(self, number: int) -> Iterator[np.ndarray]:
        """Yields a picture as one band."""
        layer = self._layers[number]
        try:
            yield _pixels(layer, self._image)
        except MemoryError as error:
            raise TooMuch(self._name, f"layer {shown(layer.name, 30)} takes more memory than there is") from error
        except Exception as error:  # likewise
            raise self._fault(f"layer {shown(layer.name, 30)}", error) from error

    def _opened(self, file: BinaryIO) -> PSDImage:
        _check_head(file, self._name)
        most = min(_FILE, memory_cap() // 4)
        try:
            return PSDImage.open(file, memory_cap() // 2, ParseLimits(most, 2 * most, max_nesting_depth=LIMITS.depth))
        except MemoryError as error:
            raise TooMuch(self._name, "takes more memory than there is") from error
        except Exception as error:  # struct.error, AssertionError, KeyError ...: as its bytes have it
            raise self._fault("its structure", error) from error

    def _fault(self, where: str, error: Exception) -> FileError:
        found = shown(reason_of(error), 100)
        return FileError(self._name, f"{where}: found {found}; expected a whole Photoshop file")

    def _all(self) -> FoundLayers:
        image = self._image
        children = self._children(image, 0)
        if not self._layers and image.width and image.height:
            self._layers.append(image)
            children = (FoundPicture("Picture", 0, (0, 0), (image.width, image.height)),)
        return FoundLayers((image.width, image.height), FoundGroup("", children), tuple(self._notes))

    def _children(self, group: PSDImage | Group, depth: int) -> tuple[FoundPicture | FoundGroup, ...]:
        if depth > LIMITS.depth:
            raise FileError(self._name, f"groups nested {depth} deep; expected at most {LIMITS.depth}")
        found = (self._group(one, depth) if isinstance(one, Group) else self._picture(one) for one in group)
        return tuple(one for one in found if one is not None)

    def _group(self, group: Group, depth: int) -> FoundGroup:
        if group.has_mask():
            self._note(group, "its mask is left out")
        inside = self._children(group, depth + 1)
        isolated = group.blend_mode != BlendMode.PASS_THROUGH
        return FoundGroup(group.name, inside, _opacity(group), group.visible, self._blend(group), isolated)

    def _picture(self, layer: Layer) -> FoundPicture | None:
        if not layer.has_pixels() or layer.width < 1 or layer.height < 1:
            self._note(layer, "has no pixels; left out")
            return None
        if layer.width > LIMITS.side or layer.height > LIMITS.side or len(self._layers) >= LIMITS.layers:
            found = f"{len(self._layers) + 1} layers, this one of {layer.width} x {layer.height}"
            most = f"{LIMITS.layers} of {LIMITS.side} along a side"
            raise TooMuch(self._name, f"layer {shown(layer.name, 30)}: found {found} pixels; expected at most {most}")
        if layer.has_vector_mask():
            self._note(layer, "its path mask is left out")
        if layer.has_effects():
            self._note(layer, "its effects are left out")
        self._layers.append(layer)
        number, at, size = len(self._layers) - 1, (layer.left, layer.top), (layer.width, layer.height)
        blend = self._blend(layer)
        return FoundPicture(layer.name, number, at, size, _opacity(layer), layer.visible, blend, layer.clipping)

    def _blend(self, layer: Layer) -> str:
        blend = _BLENDS.get(layer.blend_mode)
        if blend is None:
            mode = layer.blend_mode.name.lower().replace("_", " ")
            self._note(layer, f"mode {shown(mode)} is not known; shown as normal")
        return blend or "src-over"

    def _note(self, layer: Layer, what: str) -> None:
        self._notes.append(f"layer {shown(layer.name, 30)}: {what}")


def _opacity(layer: Layer) -> float:
    """Returns a layer's opacity times that of its paint, 0..1."""
    return layer.opacity * min(layer.fill_opacity, 255) / (255.0 * 255.0)


def _pixels(layer: Layer | PSDImage, image: PSDImage) -> np.ndarray:
    """Returns a picture, uint8 or uint16 RGBA (h, w, 4), through its mask."""
    if image.color_mode in _PLAIN and not isinstance(layer, PSDImage):
        planes = layer.numpy()
    else:
        found = layer.topil()
        planes = None if found is None else np.asarray(found.convert("RGBA"), np.float32) / np.float32(255)
    if planes is None or planes.shape[:2] != (layer.height, layer.width):
        raise ValueError("no pixels")
    most, kind = (65535, np.uint16) if image.depth > 8 else (255, np.uint8)
    colours, alpha = (planes[..., :-1], planes[..., -1:]) if planes.shape[2] in (2, 4) else (planes, np.float32(1))
    alpha = np.broadcast_to(alpha, (*planes.shape[:2], 1))
    if not isinstance(layer, PSDImage):
        alpha = alpha * _shown(layer)
    out = np.concatenate([np.broadcast_to(colours, (*planes.shape[:2], 3)), alpha], axis=2)
    pixels: np.ndarray = np.rint(np.clip(np.nan_to_num(out), 0, 1) * np.float32(most)).astype(kind)
    return pixels


def _shown(layer: Layer) -> np.ndarray:
    """Returns what a layer's mask shows of it, float32 (h, w, 1)."""
    mask = layer.mask if layer.has_mask() else None
    if mask is None or mask.disabled:
        return np.ones((1, 1, 1), np.float32)
    out = np.full((layer.height, layer.width, 1), mask.background_color / 255, np.float32)
    found = layer.numpy("mask")
    if found is None:
        return out
    left, top = mask.left - layer.left, mask.top - layer.top
    x0, y0 = max(left, 0), max(top, 0)
    x1, y1 = min(left + mask.width, layer.width), min(top + mask.height, layer.height)
    if x0 < x1 and y0 < y1:
        out[y0:y1, x0:x1] = found[y0 - top : y1 - top, x0 - left : x1 - left, :1]
    return out
