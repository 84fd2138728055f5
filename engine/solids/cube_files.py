"""Cubes of voxels from files, as `inkfall texture solid` writes them, and as pictures of all slices, which travel like
any other picture."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import numpy as np

from engine.files.atomic import replacing
from engine.files.fault import FileError, TooMuch, reason_of
from engine.files.images import picture_size, read_image
from engine.files.limits import LIMITS
from engine.files.png_writer import write_png

_MOST = 1 << 30  # bytes
_SIDES = 2, 1024
_FEWEST = 8  # slices of a picture that is a column of them: a smaller one is a picture like others
MOST_SLICES = 256  # voxels along a cube that a picture holds
_SLICES = "slice-*.png"


def read_cube(path: str) -> np.ndarray:
    """Returns the colours of a cube: float32 (z, y, x, 3).  `path` is a folder of slices, a picture of all of them one
    below the other, or an array.  FileError says what is wrong with it."""
    if os.path.isdir(path):
        return _stacked(Path(path))
    return _array(path) if path.lower().endswith(".npy") else _column(path)


def is_column(path: str) -> bool:
    """Tells whether a picture is a column of as many square slices as each has rows."""
    width, height = picture_size(path)
    return width >= _FEWEST and height == width * width


def write_cube(path: Path, voxels: np.ndarray) -> None:
    """Writes the colours of a cube, float32 (n, n, n, 3), as a picture: its slices one below the other."""
    side = voxels.shape[0]
    if voxels.shape[:3] != (side,) * 3 or not _FEWEST <= side <= MOST_SLICES:
        found = " x ".join(str(count) for count in voxels.shape[2::-1])
        raise FileError(path.name, f"found {found} voxels, expected as many each way, {_FEWEST} to {MOST_SLICES}")
    pixels = np.rint(255.0 * np.clip(voxels, 0.0, 1.0)).astype(np.uint8).reshape(side * side, side, 3)
    with replacing(path) as file:
        write_png(file, np.ascontiguousarray(pixels))


def _column(path: str) -> np.ndarray:
    if not is_column(path):
        raise FileError(path, "found one picture, expected as many square slices in a column as each has rows")
    colours = _coloured(path)
    side = colours.shape[1]
    return colours.reshape(side, side, side, 3)


def _stacked(folder: Path) -> np.ndarray:
    """The slices that lie in a folder, in the order of their names."""
    names = sorted(folder.glob(_SLICES))
    if not _SIDES[0] <= len(names) <= _SIDES[1]:
        expected = f"{_SIDES[0]} to {_SIDES[1]} named {_SLICES}"
        raise FileError(str(folder), f"found {len(names)} slices, expected {expected}")
    width, height = picture_size(names[0])
    if len(names) * width * height * 12 > _MOST:
        raise TooMuch(str(folder), f"found {len(names)} slices of {width} x {height}, expected at most 1 GiB of them")
    out = np.empty((len(names), height, width, 3), np.float32)
    for z, name in enumerate(names):
        if picture_size(name) != (width, height):
            raise FileError(str(name), f"found another size, expected {width} x {height} as the first slice")
        out[z] = _coloured(str(name))
    return out


def _coloured(path: str) -> np.ndarray:
    pixels, _ = read_image(path, limits=replace(LIMITS, pixels=MOST_SLICES**3))
    full = np.float32(np.iinfo(pixels.dtype).max)
    return opaque(pixels.astype(np.float32) / full, premultiplied=False)


def _array(path: str) -> np.ndarray:
    """(z, y, x) or (z, y, x, channels), of 8 or 16 bits or floats in 0..1."""
    try:
        if os.path.getsize(path) > _MOST:
            raise TooMuch(path, f"found {os.path.getsize(path):,} bytes, expected at most {_MOST:,}")
        found = np.load(path, allow_pickle=False)
    except OSError as error:
        raise FileError(path, f"cannot be read: {reason_of(error)}") from error
    except (ValueError, EOFError, SyntaxError, KeyError, TypeError, MemoryError, OverflowError) as error:
        raise FileError(path, f"found no array of numbers ({str(error)[:80]}), expected one of NumPy") from None
    if not isinstance(found, np.ndarray):
        raise FileError(path, "found several arrays, expected one cube")
    if found.ndim not in (3, 4) or not all(_SIDES[0] <= side <= _SIDES[1] for side in found.shape[:3]):
        raise FileError(path, f"found an array of {found.shape}, expected (z, y, x, channels), each 2 to 1024")
    cube = found[..., None] if found.ndim == 3 else found
    if cube.shape[-1] not in (1, 3, 4) or cube.dtype.kind not in "uf" or cube.dtype.itemsize > 8:
        raise FileError(path, f"found {cube.shape[-1]} channels of {cube.dtype}, expected 1, 3 or 4 of 8 bits")
    if cube.dtype.kind == "f" and not np.isfinite(cube).all():
        raise FileError(path, "found what is no number, expected colours from 0 to 1")
    full = np.float32(1.0 if cube.dtype.kind == "f" else np.iinfo(cube.dtype).max)
    return opaque(cube.astype(np.float32) / full, premultiplied=False)


def opaque(colours: np.ndarray, premultiplied: bool = True) -> np.ndarray:
    """Colours (..., 1, 3 or 4) as RGB, float32 in 0..1; what is transparent over grey."""
    out = np.clip(colours, 0.0, 1.0).astype(np.float32)
    if out.shape[-1] == 4:
        alpha = out[..., 3:]
        out = out[..., :3] * (np.float32(1.0) if premultiplied else alpha) + np.float32(0.5) * (1.0 - alpha)
    return np.ascontiguousarray(np.repeat(out, 3, axis=-1) if out.shape[-1] == 1 else out)
