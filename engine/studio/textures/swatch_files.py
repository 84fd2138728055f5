"""Pictures of brushes that were painted before, in files beside the kernels: a later start shows them at once.

A file's name is the hash of all that its pixels follow from, the engine's own sources among it.  One that is damaged is
painted anew; a folder that cannot be written to is done without.
"""

from __future__ import annotations

import hashlib
import json
import os
from contextlib import suppress
from functools import cache
from pathlib import Path

import numpy as np

from engine.brush.settings import to_json as brush_to_json
from engine.files.atomic import replacing
from engine.makers import definitions
from engine.painting.value import Painting
from engine.studio.requests import Swatch

MOST_KEPT = 1024  # files; when there are more, the older half goes
_ENGINE = Path(__file__).resolve().parents[1]


def kept(request: Swatch, of: Painting) -> np.ndarray | None:
    """Returns the picture as it was painted before, uint8 (height, width, 4), premultiplied; None if it was not."""
    path = _path(request, of)
    if path is None:
        return None
    try:
        pixels = np.load(path, allow_pickle=False)
    except Exception:  # NumPy raises many kinds for damaged heads, those of Python's parser among them
        return None
    fits = isinstance(pixels, np.ndarray) and pixels.shape == (*request.size[::-1], 4) and pixels.dtype == np.uint8
    return pixels if fits else None


def keep(request: Swatch, of: Painting, pixels: np.ndarray) -> None:
    """Writes a picture, if it is one to be kept."""
    path = _path(request, of)
    if path is None:
        return
    with suppress(OSError):
        path.parent.mkdir(mode=0o700, exist_ok=True)
        with replacing(path) as file:
            np.save(file, pixels)
        _bounded(path.parent)


def _path(request: Swatch, of: Painting) -> Path | None:
    """Returns its file; None where it follows from more than its request tells, or from a picture that is gone."""
    if not request.kept or of.textures:
        return None
    try:
        files = [_age(path) for texture in request.textures for path in definitions.named_files(texture)]
    except OSError:
        return None
    textures = definitions.to_json(request.textures)
    told = [brush_to_json(request.brush), textures, files, request.size, request.kind, request.zoom, of.seed, _stamp()]
    name = hashlib.sha256(json.dumps(told, sort_keys=True).encode()).hexdigest()[:32]
    return Path(os.environ["NUMBA_CACHE_DIR"]) / "swatches" / f"{name}.npy"


@cache
def _stamp() -> str:
    """Returns a hash of the engine's sources, and of the places, sizes and ages of the examples that come along."""
    total = hashlib.sha256(np.__version__.encode())
    for path in sorted(_ENGINE.rglob("*.py")):
        total.update(path.read_bytes())
    for path in sorted((_ENGINE.parent / "palettes" / "examples").glob("*")):
        total.update(repr((path, _age(path))).encode())
    return total.hexdigest()


def _age(path: str | Path) -> tuple[int, int]:
    """Returns a file's size and when it was written: when they are as before, it is taken to hold what it held."""
    status = os.stat(path)
    return status.st_size, status.st_mtime_ns


def _bounded(folder: Path) -> None:
    files = list(folder.glob("*.npy"))
    if len(files) > MOST_KEPT:
        for path in sorted(files, key=lambda path: path.stat().st_mtime)[: len(files) // 2]:
            path.unlink(missing_ok=True)
