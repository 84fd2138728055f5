"""What a painting began with, as the first record of its journal tells it."""

from __future__ import annotations

import os
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from engine.journal.records import Members
from engine.painting.recording import DEFAULT_FRAME, Header, parse_header

VERSION_TOLD = 1


@dataclass(frozen=True, slots=True)
class FileStamp:
    """A file as it was: its path, bytes and time of change (ns)."""

    path: Path
    size: int
    changed: int

    @classmethod
    def of(cls, path: Path) -> FileStamp | None:
        """Returns the stamp of a file as it is now; None if there is none."""
        try:
            found = os.stat(path)
        except OSError:
            return None
        return cls(Path(os.path.abspath(path)), found.st_size, found.st_mtime_ns)


def head_of_new(header: Header | None = None, name: str = "", folder: Path | None = None) -> Members:
    """Tells of a new painting; `folder`: what paths in its commands are relative to."""
    told = (header or Header(DEFAULT_FRAME)).to_json()
    return _head(name, None, {"header": told, "folder": None if folder is None else os.path.abspath(folder)})


def head_of_file(stamp: FileStamp, native: bool, header: Header) -> Members:
    """Tells of a painting opened from a file; `native`: whether it is to be saved there."""
    base = {"file": os.fspath(stamp.path), "size": stamp.size, "changed": stamp.changed, "header": header.to_json()}
    return _head(stamp.path.name, stamp.path if native else None, base)


def renamed_head(head: Mapping[str, object], name: str) -> Members:
    """Tells of the same painting under another name, without a file of its own."""
    return {**head, "name": name, "path": None, "clock": time.time()}


def head_again(name: str, path: Path | None, header: Header, folder: Path | None, base: Path | None) -> Members:
    """Tells of a painting that is in the middle of being made: as of a new one, or, if nobody knows how it was made, as
    of one of a file that lies nowhere but among what is kept, `base`."""
    told = head_of_new(header, name, folder)
    if base is not None:
        stays = os.path.join(folder or base.parent, base.name)
        about = {"file": stays, "size": os.path.getsize(base), "changed": 0, "header": header.to_json()}
        told = _head(name, None, about)
    return {**told, "path": None if path is None else os.path.abspath(path)}


def header_of(base: Mapping[str, object]) -> Header:
    """Returns the header of the recording that a painting began with.  FieldError if it is none."""
    return parse_header(base.get("header"))


def _head(name: str, path: Path | None, base: Mapping[str, object]) -> Members:
    own = None if path is None else os.fspath(path)
    return {"journal": VERSION_TOLD, "name": name, "path": own, "clock": time.time(), "base": dict(base)}
