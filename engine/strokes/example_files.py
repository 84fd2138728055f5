"""Example textures from files, and their analyses, kept in the user's cache folder under the hash of the content."""

from __future__ import annotations

import hashlib
import os
import zipfile
import zlib
from contextlib import suppress
from dataclasses import fields
from pathlib import Path

import numpy as np
import platformdirs

from engine.checks.field_error import FieldError
from engine.files.atomic import replacing
from engine.files.fault import FileError, WriteError
from engine.files.images import read_image
from engine.numeric.arithmetic import LIBRARY
from engine.texture.example.exemplar import ExampleLevel, Exemplar, analysed
from engine.texture.example.parameters import Parameters, map_table, read_toml

VERSION = 2  # of the analysis: another one, another hash
_KEPT = 64  # analyses at most; the ones unused for longest go first
PARAMETERS_CAP = 1 << 20  # bytes of a parameter file
# What of the parameters the analysis depends on.
_ANALYSED = ("levels", "channels", "alpha", "boundary", "smooth", "block")
_DAMAGED = (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile, zlib.error, NotImplementedError, MemoryError)


def read_parameters(path: str | os.PathLike[str], usual: Parameters | None = None) -> Parameters:
    """Returns a TOML file, `usual` parameters where it tells none; FileError names the file, the line and the field."""
    data = _parameter_bytes(path)
    try:
        return read_toml(data, usual or Parameters())
    except FieldError as error:
        raise FileError(path, str(error)) from None


def read_map_table(path: str | os.PathLike[str]) -> dict[str, object]:
    """Returns what a TOML file, which `read_parameters` reads, tells of maps."""
    try:
        return map_table(_parameter_bytes(path))
    except FieldError as error:
        raise FileError(path, str(error)) from None


def _parameter_bytes(path: str | os.PathLike[str]) -> bytes:
    try:
        with open(path, "rb") as file:
            data = file.read(PARAMETERS_CAP + 1)
    except (OSError, ValueError) as error:
        raise FileError(path, f"cannot be read: {getattr(error, 'strerror', None) or error}") from error
    if len(data) > PARAMETERS_CAP:
        raise FileError(path, f"more than {PARAMETERS_CAP} bytes; expected a file of parameters")
    return data


def read_exemplar(
    path: str | os.PathLike[str],
    mask: str | os.PathLike[str] | None = None,
    parameters: Parameters | None = None,
    folder: Path | None = None,
) -> Exemplar:
    """Returns the exemplar of a picture file, whose region is the light part of another or where it is not transparent.

    `folder`: of the analyses, instead of the user's.  FileError, one line, on any fault.
    """
    pixels, _ = read_image(path)
    inside = None if mask is None else read_mask(mask)
    try:
        return kept(pixels, inside, parameters or Parameters(), folder)
    except FieldError as error:
        at_fault = mask if error.place == "mask" and mask is not None else path
        raise FileError(at_fault, f"found {error.found}, expected {error.expected}") from None


def read_mask(path: str | os.PathLike[str]) -> np.ndarray:
    """Tells where a picture is light and not transparent: bool (h, w)."""
    pixels, _ = read_image(path)
    full = int(np.iinfo(pixels.dtype).max)
    light = pixels[..., :3].astype(np.uint32).sum(axis=-1) * pixels[..., 3].astype(np.uint64)
    out: np.ndarray = light >= 3 * full * full // 2
    return out


def kept(
    pixels: np.ndarray,
    mask: np.ndarray | None,
    parameters: Parameters,
    folder: Path | None = None,
    arithmetic: int = LIBRARY,
) -> Exemplar:
    """As `exemplar.analysed`, from the folder of analyses if it is there, else put into it."""
    folder = folder or platformdirs.user_cache_path("inkfall") / "examples"
    place = folder / f"{key(pixels, mask, parameters, arithmetic)}.npz"
    with suppress(*_DAMAGED):
        found = _read(place, pixels, parameters, arithmetic)
        os.utime(place)
        return found
    exemplar = analysed(pixels, mask, parameters, arithmetic)
    with suppress(OSError, WriteError):  # a folder that cannot be written to: analysed anew each time
        place.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        _write(place, exemplar)
        _tidy(place.parent)
    return exemplar


def key(pixels: np.ndarray, mask: np.ndarray | None, parameters: Parameters, arithmetic: int = LIBRARY) -> str:
    """Returns a hash of the content, in hexadecimal."""
    held = tuple((name, getattr(parameters, name)) for name in _ANALYSED)
    told = () if arithmetic == LIBRARY else (arithmetic,)
    about = (VERSION, pixels.shape, pixels.dtype.str, mask is None, held, *told)
    found = hashlib.sha256(repr(about).encode())
    found.update(pixels.tobytes())
    if mask is not None:
        found.update(np.packbits(mask).tobytes())
    return found.hexdigest()


def _write(place: Path, exemplar: Exemplar) -> None:
    facts = np.array([len(exemplar.levels), exemplar.block, exemplar.boundary], np.int64)
    arrays = {"facts": facts, "mask": exemplar.mask, "blocks": exemplar.blocks}
    for n, level in enumerate(exemplar.levels):
        arrays |= {f"{field.name}{n}": getattr(level, field.name) for field in fields(level)}
    with replacing(place) as file:
        np.savez(file, **arrays)  # type: ignore[arg-type]


def _read(place: Path, pixels: np.ndarray, parameters: Parameters, arithmetic: int) -> Exemplar:
    """Returns one of _DAMAGED if it is not there or not whole; its members have check sums."""
    with open(place, "rb") as file, np.load(file) as held:
        count, block, boundary = (int(n) for n in held["facts"])
        levels = [ExampleLevel(*(held[f"{field.name}{n}"] for field in fields(ExampleLevel))) for n in range(count)]
        mask, blocks = held["mask"], held["blocks"]
    if mask.shape != pixels.shape[:2] or not levels or not len(blocks):
        raise ValueError(f"{place}: another example's")
    own = pixels.copy()
    for array in (own, mask, blocks, *(getattr(lv, field.name) for lv in levels for field in fields(lv))):
        array.flags.writeable = False
    return Exemplar(own, mask, parameters, tuple(levels), blocks, block, bool(boundary), arithmetic=arithmetic)


def _tidy(folder: Path) -> None:
    held = sorted(folder.glob("*.npz"), key=lambda path: path.stat().st_mtime)
    for path in held[:-_KEPT]:
        path.unlink()
