"""Distinct colours of a picture, regions of one colour, and random false colouring (Lewis 1984, figure 1)."""

from __future__ import annotations

import numpy as np

from engine.numeric.hashing import mix64
from engine.numeric.kernel import inner, kernel

_MASK24 = np.uint32(0xFFFFFF)


def packed(pixels: np.ndarray) -> np.ndarray:
    """Returns one integer for each colour: uint32 (h, w) of uint8 RGBA (h, w, 4), uint64 of uint16.

    What is wholly transparent is one colour, whatever its other channels hold.
    """
    if pixels.ndim != 3 or pixels.shape[2] != 4 or pixels.dtype not in (np.uint8, np.uint16):
        raise ValueError(f"colours: found {pixels.dtype} {pixels.shape}, expected uint8 or uint16 (h, w, 4)")
    word, bits = (np.uint32, 8) if pixels.dtype == np.uint8 else (np.uint64, 16)
    out = np.zeros(pixels.shape[:2], word)
    for c in range(4):
        out = (out << word(bits)) | pixels[..., c]
    out[pixels[..., 3] == 0] = 0
    return out


def colour_count(colours: np.ndarray) -> int:
    """Tells how many values there are in an array."""
    ordered = np.sort(colours, axis=None)
    return int(ordered.size > 0) + int(np.count_nonzero(ordered[1:] != ordered[:-1]))


def region_count(colours: np.ndarray) -> int:
    """Tells how many regions there are: 4-connected pixels of one value, in an array (h, w) of integers.

    ValueError for 2^31 pixels or more.
    """
    if colours.size >= 1 << 31:
        raise ValueError(f"regions: found {colours.size} pixels, expected fewer than 2^31")
    return int(_regions(np.ascontiguousarray(colours), np.empty(colours.size, np.int32)))


def false_colours(colours: np.ndarray) -> np.ndarray:
    """Colours that tell nothing of the true ones but where they are equal: uint8 RGBA (h, w, 4) of `packed` ones.

    Opaque 8-bit colours all get different ones; what is wholly transparent stays so.
    """
    out = np.empty((*colours.shape, 4), np.uint8)
    _false_colours(np.ascontiguousarray(colours).reshape(-1), out.reshape(-1, 4), colours.dtype.itemsize == 4)
    return out


@inner
def _root(parents: np.ndarray, i: int) -> int:
    while parents[i] != i:
        parents[i] = parents[parents[i]]
        i = parents[i]
    return i


@kernel
def _regions(colours: np.ndarray, parents: np.ndarray) -> int:
    """Union-find over the grid; the root of a region is its first pixel."""
    height, width = colours.shape
    count = 0
    for y in range(height):
        for x in range(width):
            i = y * width + x
            parents[i] = i
            count += 1
            if x and colours[y, x] == colours[y, x - 1]:
                parents[i] = _root(parents, i - 1)
                count -= 1
            if y and colours[y, x] == colours[y - 1, x]:
                here, above = _root(parents, i), _root(parents, i - width)
                if here != above:
                    parents[max(here, above)] = min(here, above)
                    count -= 1
    return count


@kernel
def _false_colours(colours: np.ndarray, out: np.ndarray, bytes8: bool) -> None:
    """Applies a bijection of 24 bits on the high bytes of red, green and blue, turned by a hash of all else."""
    for i in range(colours.size):
        value = np.uint64(colours[i])
        if bytes8:
            rgb, rest = np.uint32(value >> np.uint64(8)), value & np.uint64(0xFF)
            clear = rest == 0
            rest = rest ^ np.uint64(0xFF)
        else:
            red, green = (value >> np.uint64(56)) << np.uint64(16), ((value >> np.uint64(40)) & np.uint64(0xFF)) << 8
            rgb = np.uint32(red | green | ((value >> np.uint64(24)) & np.uint64(0xFF)))
            rest = (value ^ np.uint64(0xFFFF)) & np.uint64(0x00FF00FF00FFFFFF)
            clear = (value & np.uint64(0xFFFF)) == 0
        for _ in range(3):
            rgb = (rgb * np.uint32(0x6B43A9)) & _MASK24
            rgb ^= rgb >> np.uint32(11)
        if rest:
            rgb ^= np.uint32(mix64(rest) & np.uint64(0xFFFFFF))
        out[i, 0] = np.uint8(0 if clear else rgb >> np.uint32(16))
        out[i, 1] = np.uint8(0 if clear else (rgb >> np.uint32(8)) & np.uint32(0xFF))
        out[i, 2] = np.uint8(0 if clear else rgb & np.uint32(0xFF))
        out[i, 3] = np.uint8(0 if clear else 255)
