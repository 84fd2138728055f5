"""What a journal needs that lies elsewhere, kept beside it: pictures by their sha, and the file that was opened."""

from __future__ import annotations

import glob
import hashlib
import zlib
from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path

import numpy as np
from isal import isal_zlib

from engine.archive.saving import Snapshot, save
from engine.checks.field_error import FieldError
from engine.files.atomic import replacing
from engine.files.fault import FileError, WriteError
from engine.files.strict_json import Fields, dumps, loads
from engine.journal.heads import FileStamp
from engine.painting.value import Painting
from engine.texture.image import ImageSource
from engine.texture.raster import row_bands

_FOLDER, _PART = "kept", "painting.ora"
_BLOCK = 1 << 20  # bytes
_SIDE_CAP = 1 << 20  # pixels
_NAME_CAP = 4096
_DAMAGED = (OSError, ValueError, FieldError, zlib.error, MemoryError)


def keep_source(folder: Path, source: ImageSource) -> None:
    """Keeps a picture beside the journal in `folder`, once.  WriteError if it cannot be written."""
    place = _place(folder, source.sha)
    if not source.there or place.exists():
        return
    with replacing(place) as file:
        head = {"name": source.name, "size": [source.width, source.height]}
        file.write(dumps(head).encode() + b"\n")
        packed = isal_zlib.compressobj(1)
        for plane in range(4):
            for band in row_bands(source.width, source.height):
                file.write(packed.compress(np.ascontiguousarray(source.planes(band)[plane], "<f4").data))
        file.write(packed.flush())


def kept_sources(folder: Path, shas: Iterable[str]) -> dict[str, ImageSource]:
    """Returns those of some pictures that were kept and are whole, by their sha."""
    found: dict[str, ImageSource] = {}
    for sha in shas:
        with suppress(*_DAMAGED):
            found[sha] = _read(folder / _FOLDER / sha, sha)
    return found


def _read(path: Path, sha: str) -> ImageSource:
    """Returns one of _DAMAGED if it is not there or not whole."""
    head, _, body = path.read_bytes().partition(b"\n")
    members = Fields(loads(head), "kept")
    width, height = members.integers("size", 2, limit=_SIDE_CAP)
    data = np.frombuffer(zlib.decompress(body), "<f4").reshape(4, height, width).astype(np.float32)
    data.flags.writeable = False
    source = ImageSource.of(members.text("name", cap=_NAME_CAP), data)
    if source.sha != sha:
        raise ValueError("another picture")
    return source


def keep_file(folder: Path, stamp: FileStamp) -> str:
    """Keeps the bytes of a file that is as its stamp says; returns their SHA-256 in hexadecimal.  FileError if it is
    another by now, WriteError if it cannot be written."""
    try:
        sha = _sha(stamp.path)
        place = _place(folder, sha + stamp.path.suffix)
        if not place.exists():
            with open(stamp.path, "rb") as file, replacing(place) as copy:
                while block := file.read(_BLOCK):
                    copy.write(block)
    except OSError as error:
        raise FileError(stamp.path, f"cannot be read: {error.strerror or error}") from error
    if FileStamp.of(stamp.path) != stamp or _sha(place) != sha:
        with suppress(OSError):
            place.unlink()
        raise FileError(stamp.path, "has changed since it was opened")
    return sha


def keep_painting(folder: Path, painting: Painting) -> Path:
    """Keeps a painting, grown to its end, as a file that is named by its SHA-256; returns that.  WriteError if it
    cannot be written."""
    part = _place(folder, _PART)
    save(part, Snapshot(painting))
    try:
        return part.replace(_place(folder, f"{_sha(part)}.ora"))
    except OSError as error:
        raise WriteError(part, f"cannot be written: {error.strerror or error}") from error


def kept_file(folder: Path, stamp: FileStamp, sha: object) -> Path | None:
    """Returns where the bytes of a file that was opened are: kept under its `sha`, or where it was if it is as it was,
    or kept though the journal could not tell of it; None if they are nowhere."""
    if isinstance(sha, str) and _is_kept(place := folder / _FOLDER / (sha + stamp.path.suffix), stamp):
        return place
    if FileStamp.of(stamp.path) == stamp:
        return stamp.path
    places = (folder / _FOLDER).glob(f"*{glob.escape(stamp.path.suffix)}")
    return next((place for place in places if _is_kept(place, stamp)), None)


def _is_kept(place: Path, stamp: FileStamp) -> bool:
    """Tells whether a file is what its name says, and as long as the one that was opened."""
    with suppress(OSError):
        return place.stat().st_size == stamp.size and place.name == _sha(place) + stamp.path.suffix
    return False


def stamp_of(base: Mapping[str, object]) -> FileStamp:
    """Returns the stamp that a journal's head tells of the file that was opened.  FieldError if it tells none."""
    members = Fields(base, "base")
    size, changed = (members.integer(name, lo=0, hi=1 << 63) for name in ("size", "changed"))
    return FileStamp(Path(members.text("file", cap=_NAME_CAP)), size, changed)


def _place(folder: Path, name: str) -> Path:
    """Returns the place of something kept, in a folder that is there.  WriteError if it cannot be made."""
    try:
        (folder / _FOLDER).mkdir(mode=0o700, exist_ok=True)
    except OSError as error:
        raise WriteError(folder / _FOLDER, f"cannot be written: {error.strerror or error}") from error
    return folder / _FOLDER / name


def _sha(path: Path) -> str:
    found = hashlib.sha256()
    with open(path, "rb") as file:
        while block := file.read(_BLOCK):
            found.update(block)
    return found.hexdigest()
