"""Cubes of voxels from files, as `inkfall texture solid` writes them."""

from __future__ import annotations

import os

import numpy as np

from engine.files.fault import FileError, TooMuch, reason_of

_MOST = 1 << 30  # bytes
_SIDES = 2, 1024


def read_cube(path: str) -> np.ndarray:
    """Returns an array (z, y, x) or (z, y, x, channels), of 8 or 16 bits or floats in 0..1, as colours: float32
    (z, y, x, 3).  FileError says what is wrong with it."""
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
