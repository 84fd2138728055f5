"""What a file looks like from outside, so that one sees later whether somebody has changed it."""

from __future__ import annotations

import hashlib
import os
import stat
from dataclasses import dataclass
from pathlib import Path

TAIL = 1 << 16  # bytes at the end of a file that are looked at: of an .ora, the sums of all that is in it


@dataclass(frozen=True, slots=True)
class Fingerprint:
    """`size`: bytes; `changed`: when, nanoseconds since 1970; `tail`: SHA-256 of the last TAIL bytes; `place`: device
    and inode, which name the file whatever its path."""

    size: int
    changed: int
    tail: bytes
    place: tuple[int, int]

    def same_bytes(self, other: Fingerprint) -> bool:
        """Tells whether both are of the same content, whenever it was written."""
        return (self.size, self.tail) == (other.size, other.tail)

    def same_file(self, other: Fingerprint) -> bool:
        """Tells whether nobody wrote in between.

        A file whose size, time and tail are the same counts as the same under another inode: memory sticks and folders
        of other machines number their files anew when they are mounted, or even while they are.
        """
        return self.same_bytes(other) and self.changed == other.changed


def fingerprint(path: Path) -> Fingerprint | None:
    """Returns that of the regular file at a path, None if there is none.  OSError if it cannot be read."""
    try:
        if not stat.S_ISREG(os.stat(path).st_mode):
            return None
        file = path.open("rb")
    except (FileNotFoundError, NotADirectoryError):
        return None
    with file:
        about = os.fstat(file.fileno())
        file.seek(max(0, about.st_size - TAIL))
        tail = hashlib.sha256(file.read(TAIL)).digest()
    return Fingerprint(about.st_size, about.st_mtime_ns, tail, (about.st_dev, about.st_ino))
