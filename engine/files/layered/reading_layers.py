"""Files of layers by their names: what is in them, and their pictures on one sheet."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

import numpy as np

from engine.files.fault import FileError, reason_of
from engine.files.layered.layer_sheet import FoundLayers, LayeredReader, sheet_of, with_places
from engine.files.layered.ora_layers import OraLayers
from engine.files.zip_reader import ZipArchive

_ORA, _PHOTOSHOP = ".ora", (".psd", ".psb")


def has_layers(path: str | os.PathLike[str]) -> bool:
    """Tells whether a file is one of layers, by its name."""
    return Path(path).suffix.lower() in (_ORA, *_PHOTOSHOP)


def read_layers(path: Path) -> FoundLayers:
    """Returns what a file of layers holds; its pixels are not unpacked.  FileError if it cannot be read."""
    with _open(path, os.fspath(path)) as reader:
        return with_places(reader.found, os.fspath(path))


def read_sheet(path: Path, name: str) -> np.ndarray:
    """Returns the pictures of a file of layers side by side, uint8 or uint16 RGBA (h, w, 4), as `read_layers` tells
    their places.  FileError if it cannot be read; `name` stands in it."""
    with _open(path, name) as reader:
        return sheet_of(reader, name)


@contextmanager
def _open(path: Path, name: str) -> Iterator[LayeredReader]:
    if not path.is_file():  # also so that no pipe or device is opened
        raise FileError(name, "found no file there, expected one of layers")
    try:
        with open(path, "rb") as file:
            yield _reader(file, path, name)
    except OSError as error:
        raise FileError(name, f"cannot be read: {reason_of(error)}") from error


def _reader(file: BinaryIO, path: Path, name: str) -> LayeredReader:
    if path.suffix.lower() == _ORA:
        return OraLayers(ZipArchive(file, name))
    from engine.files.layered.psd_layers import PsdLayers  # here: it loads a library that nothing else needs

    return PsdLayers(file, name)
