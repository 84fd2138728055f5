"""ICC profiles (ICC.1:2010) as files and pictures hold them: nothing is believed before it is checked."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from engine.files.big_endian import BigEndian
from engine.files.fault import FileError, reason_of, shown

LARGEST_PROFILE = 1 << 24  # bytes
SPACES = {b"RGB ": "RGB", b"GRAY": "L", b"CMYK": "CMYK"}  # of colours (7.2.6), and Pillow's modes of them
_HEAD, _MOST_TAGS, _MOST_NAME = 128, 100, 80
_KINDS = (b"scnr", b"mntr", b"prtr", b"spac")  # 7.2.5
_TABLES = (b"A2B0", b"A2B1", b"A2B2", b"B2A0", b"B2A1", b"B2A2")


@dataclass(frozen=True)
class Profile:
    """A profile whose directory is sound: its bytes, Pillow's mode of its colours, what it calls itself, whether its
    connection space is XYZ, and where its tags lie: (first byte, bytes)."""

    file: str
    data: bytes
    mode: str
    title: str
    by_xyz: bool
    tags: Mapping[bytes, tuple[int, int]]

    @property
    def is_srgb(self) -> bool:
        """Tells whether it says that its colours are sRGB."""
        return "sRGB" in self.title

    @property
    def has_tables(self) -> bool:
        """Tells whether it goes by tables, not by three curves and a matrix."""
        return any(tag in self.tags for tag in _TABLES)

    def tag(self, name: bytes) -> BigEndian:
        """Returns a tag to be read, its type first; FileError where there is none."""
        if name not in self.tags:
            raise FileError(self.file, f"found no tag {shown(name)}, expected a profile with one")
        at, size = self.tags[name]
        return BigEndian(self.data, self.file, at, at + size)


def read_profile(path: Path) -> Profile:
    """Returns the profile in a file; FileError where there is none."""
    try:
        if path.exists() and not path.is_file():
            raise FileError(path, "not a regular file, expected an ICC profile")
        with path.open("rb") as file:
            data = file.read(LARGEST_PROFILE + 1)
    except (OSError, ValueError) as error:
        raise FileError(path, f"cannot be read: {reason_of(error)}") from error
    return profile_of(data, str(path))


@functools.lru_cache(maxsize=4)
def profile_of(data: bytes, file: str) -> Profile:
    """Returns the profile that some bytes are; FileError, by the name of their file, where they are none."""
    if len(data) > LARGEST_PROFILE:
        raise FileError(file, f"found more than {LARGEST_PROFILE} bytes, expected an ICC profile")
    if len(data) < _HEAD + 4 or data[36:40] != b"acsp":
        raise FileError(file, f"byte 36: found {shown(data[36:40])}, expected 'acsp', as ICC profiles have")
    head = BigEndian(data, file)
    size = head.number("I", "its size")
    if not _HEAD + 4 <= size <= len(data):
        raise FileError(file, f"it says that it has {size} bytes, found {len(data)}")
    if data[12:16] not in _KINDS:
        raise FileError(file, f"byte 12: a profile of kind {shown(data[12:16])}, expected that of a screen or printer")
    if data[16:20] not in SPACES:
        raise FileError(file, f"byte 16: colours {shown(data[16:20])}, expected 'RGB ', 'GRAY' or 'CMYK'")
    tags = _directory(data, file, size)
    found = Profile(file, data[:size], SPACES[data[16:20]], "", data[20:24] == b"XYZ ", tags)
    return Profile(file, found.data, found.mode, _title(found), found.by_xyz, tags)


def _directory(data: bytes, file: str, size: int) -> dict[bytes, tuple[int, int]]:
    table = BigEndian(data, file, _HEAD, size)
    count = table.number("I", "the number of its tags")
    if not 0 < count <= _MOST_TAGS:
        raise FileError(file, f"byte 128: found {count} tags, expected 1 to {_MOST_TAGS}")
    tags: dict[bytes, tuple[int, int]] = {}
    for number in range(count):
        name = table.raw(4, f"tag {number + 1}")
        at, length = table.number("I", f"tag {number + 1}"), table.number("I", f"tag {number + 1}")
        if at < _HEAD or length < 8 or at + length > size:
            raise FileError(file, f"tag {shown(name)}: bytes {at} to {at + length}, expected some of {size}")
        tags[name] = at, length
    return tags


def _title(profile: Profile) -> str:
    """Returns what a profile calls itself; nothing where that cannot be read."""
    try:
        tag = profile.tag(b"desc")
        kind = tag.raw(8, "its name")[:4]
        if kind == b"desc":
            text = tag.raw(tag.number("I", "its name"), "its name").decode("latin-1")
        else:
            count, _ = tag.number("I", "its names"), tag.number("I", "its names")
            if kind != b"mluc" or count < 1:
                return ""
            tag.raw(4, "a language")
            length, at = tag.number("I", "its name"), tag.number("I", "its name")
            start = profile.tags[b"desc"][0] + at
            text = BigEndian(profile.data, profile.file, start, tag.end).raw(length, "its name").decode("utf-16-be")
    except (FileError, UnicodeError):
        return ""
    words = " ".join(text.partition("\0")[0].split())
    return "".join(letter for letter in words if letter.isprintable())[:_MOST_NAME]
