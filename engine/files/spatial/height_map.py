"""Height maps as other programs write them: pictures of 8 or 16 bits, TIFF of floats or whole numbers, GeoTIFF with its
scale and its pixels without data, EXR."""

from __future__ import annotations

import io
import math
from dataclasses import dataclass, replace

import numpy as np

from engine.files.fault import FileError
from engine.files.images import read_image
from engine.files.limits import LIMITS
from engine.files.spatial.exr_reader import EXR_MAGIC, read_exr
from engine.files.tiff_reader import read_channel, read_layout

MOST_MAPPED = 1 << 24  # pixels of a map
_LIMITS = replace(LIMITS, pixels=MOST_MAPPED)
_BRIGHTNESS = (0.2126, 0.7152, 0.0722)
_TIFF = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
_SCALE, _KEYS, _NO_DATA = 33550, 34735, 42113  # tags of GeoTIFF, and of GDAL
_MODEL, _PROJECTED, _GEOGRAPHIC, _UNITS, _METRE = 1024, 1, 2, 3076, 9001  # keys of GeoTIFF, and their values
_A_DEGREE = 111_320.0  # metres from north to south
_VOID = -32768  # what whole numbers below 0 say where nothing was measured
_AT_ONCE = 1 << 8  # rows
_BEYOND = 1e30  # floats from which on there is no height
_ALONE = ("Y", "Z", "height", "R", "G", "B", "V", "A")  # the channel of an EXR that tells heights, by preference


@dataclass(frozen=True)
class HeightMap:
    """Heights (h, w), float64, top row first, in the file's own units, NaN where the file has none; `pixel`: how wide
    a pixel is in these units, None where it does not tell."""

    heights: np.ndarray
    pixel: float | None = None

    @property
    def voids(self) -> int:
        """Counts the pixels without a height."""
        return int(np.isnan(self.heights).sum())

    @property
    def ends(self) -> tuple[float, float]:
        """Gives the lowest and the highest height."""
        return float(np.nanmin(self.heights)), float(np.nanmax(self.heights))

    @property
    def told(self) -> str:
        """Tells it in a few words."""
        height, width = self.heights.shape
        low, high = self.ends
        words = f"{width} x {height} heights from {low:g} to {high:g}"
        return words + (
            f", {self.voids / self.heights.size:.2g} of them missing, closed from around" if self.voids else ""
        )


def read_height_map(data: bytes, name: str) -> HeightMap:
    """Returns the map in a file's bytes.  FileError, one line, if it cannot be read, or tells no height at all."""
    if data[:4] == EXR_MAGIC:
        found = HeightMap(_of_exr(data, name))
    elif data[:4] in _TIFF:
        found = _of_tiff(data, name)
    else:
        found = HeightMap(_of_picture(data, name))
    heights = found.heights
    for top in range(0, len(heights), _AT_ONCE):
        part = heights[top : top + _AT_ONCE]
        part[~(np.abs(part) < _BEYOND)] = np.nan  # NaN, infinity, and what stands for them
    if found.voids == heights.size:
        raise FileError(name, "found no height in it, expected some")
    return found


def _of_picture(data: bytes, name: str) -> np.ndarray:
    """Returns brightness in whole steps of the picture, nothing where it is transparent."""
    pixels = read_image(data, name, _LIMITS)[0]
    red, green, blue, alpha = (pixels[:, :, i] for i in range(4))
    heights = red.astype(np.float64)
    if not (np.array_equal(red, green) and np.array_equal(red, blue)):
        heights = (_BRIGHTNESS[0] * red + _BRIGHTNESS[1] * green) + _BRIGHTNESS[2] * blue
    heights[alpha == 0] = np.nan
    return heights


def _of_exr(data: bytes, name: str) -> np.ndarray:
    channels = read_exr(data, name, _LIMITS)
    red, green, blue = (channels.get(one) for one in "RGB")
    if red is not None and green is not None and blue is not None and not np.array_equal(red, green, equal_nan=True):
        return (_BRIGHTNESS[0] * red.astype(np.float64) + _BRIGHTNESS[1] * green) + _BRIGHTNESS[2] * blue
    chosen = next((one for one in _ALONE if one in channels), next(iter(channels)))
    return channels[chosen].astype(np.float64)


def _of_tiff(data: bytes, name: str) -> HeightMap:
    layout = read_layout(io.BytesIO(data), name, _LIMITS)
    if layout.one_channel:
        tags, heights = _by_pillow(data, name, True)[0], read_channel(io.BytesIO(data), layout).astype(np.float64)
    else:
        tags, found = _by_pillow(data, name, layout.ours)
        heights = _of_picture(data, name) if found is None else found
    lowest = _number(tags.get(_NO_DATA))
    signed = set(layout.tags.get("SampleFormat", (1,))) == {2}
    for void in (lowest, float(_VOID) if signed and layout.bits[0] == 16 else None):
        if void is not None:
            heights[heights == np.float64(void)] = np.nan
            heights[heights == np.float64(np.float32(void))] = np.nan
    return HeightMap(heights, _pixel(tags))


def _by_pillow(data: bytes, name: str, ours: bool) -> tuple[dict[int, object], np.ndarray | None]:
    """Returns the tags, and heights unless our own reader has them (`ours`)."""
    from PIL import Image

    try:
        with Image.open(io.BytesIO(data), formats=["TIFF"]) as picture:
            tags = {tag: picture.tag_v2.get(tag) for tag in (_SCALE, _KEYS, _NO_DATA)}  # type: ignore[attr-defined]
            if ours or picture.mode not in ("F", "I", "I;16", "I;16B"):
                return tags, None
            return tags, np.array(picture).astype(np.float64)
    except Exception as error:  # a decoder of hostile bytes may raise anything
        if ours:
            return {}, None
        raise FileError(name, f"damaged TIFF, or of several channels: {error or type(error).__name__}") from error


def _number(told: object) -> float | None:
    try:
        return None if told is None else float(str(told).strip("\0 "))
    except ValueError:
        return None


def _pixel(tags: dict[int, object]) -> float | None:
    """Returns metres along a pixel's side from north to south, as far as scale and keys tell them."""
    scale, keys = tags.get(_SCALE), tags.get(_KEYS)
    if not isinstance(scale, tuple) or len(scale) < 2 or not isinstance(keys, tuple):
        return None
    told = {keys[i]: keys[i + 3] for i in range(4, len(keys) - 3, 4) if keys[i + 1] == 0}
    side = abs(float(scale[1]))
    if not (math.isfinite(side) and side > 0.0):
        return None
    if told.get(_MODEL) == _GEOGRAPHIC:
        return side * _A_DEGREE
    return side if told.get(_MODEL) == _PROJECTED and told.get(_UNITS, _METRE) == _METRE else None
