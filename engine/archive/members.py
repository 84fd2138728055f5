"""The members of an archive as several threads read them, each held against what its manifest says of it."""

from __future__ import annotations

import hashlib
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

from engine.archive.manifest import MANIFEST, MANIFEST_AGAIN, Manifest
from engine.files.fault import FileError, shown
from engine.files.zip_reader import ZipArchive
from engine.painting.rendering import Stop, check_cancelled

WORKERS = 2
PIECE = 1 << 20
UNREAD = ("mergedimage", "Thumbnails", MANIFEST_AGAIN)  # members that an undamaged file is opened without
LOST = "deep detail is missing: this file was saved by another program"
CHANGED = "another program changed {what}: its pictures are shown, the deep detail that no longer fits is left out"


@dataclass(frozen=True, slots=True)
class Stored:
    """A member's bytes as the archive holds them; `sha`: what their SHA-256 must be; `where`: how a fault names it."""

    data: bytes
    sha: str
    where: str

    def checked(self) -> bytes:
        """Returns the bytes, if they are those that the manifest names; else FileError."""
        if hashlib.sha256(self.data).hexdigest() != self.sha:
            raise FileError(self.where, "its bytes are not those that the manifest names")
        return self.data


class Members:
    """The members of an archive.  Any thread may read them: a lock guards the file, which has one position."""

    def __init__(self, archive: ZipArchive, manifest: Manifest, cancelled: Stop) -> None:
        self._archive, self._manifest, self._cancelled = archive, manifest, cancelled
        self._reading = threading.Lock()
        self._grounds = {found.member for found in manifest.grounds.values()}
        self._kept: dict[str, bytes] = {}  # pictures that layers began with

    def overtaken(self) -> str:
        """Says what another program changed or left out; "" for nothing.

        A member that differs from the manifest but is whole, as its own checksum tells, was put there on purpose.
        """
        told, archive = self._manifest.members, self._archive
        if any(name not in archive for name in told if name.startswith("inkfall/")):
            return LOST
        read = {name: entry for name, entry in told.items() if not name.startswith(UNREAD)}
        for name, (size, _) in read.items():
            if name not in archive or archive.members[name].size != size:
                return CHANGED.format(what=shown(name))
        summed = [name for name in read if not name.endswith(".tiles")]
        with ThreadPoolExecutor(WORKERS, "sum") as pool:
            for name, sha in zip(summed, pool.map(self._sum, summed), strict=True):
                if sha != read[name][1]:
                    return CHANGED.format(what=shown(name))
        return ""

    def stored(self, member: str) -> Stored:
        """Returns a member that the manifest names; FileError if it does not."""
        size, sha = self._told(member)
        with self._reading:
            return Stored(self._archive.read(member, size), sha, self.where(member))

    def ground(self, member: str) -> bytes:
        """Returns the picture that a layer began with; FileError if the manifest does not name it."""
        size, _ = self._told(member)
        if member not in self._kept:
            with self._reading:
                return self._archive.read(member, size)
        return self._kept[member]

    def where(self, member: str) -> str:
        """Tells how a fault names a member."""
        return f"{self._archive.name}: member {shown(member)}"

    def _told(self, member: str) -> tuple[int, str]:
        """Returns a member's size in bytes and its SHA-256, as the manifest has them."""
        if member not in self._manifest.members:
            raise FileError(self._archive.name, f"{MANIFEST}: {shown(member)} is not among the members")
        return self._manifest.members[member]

    def _sum(self, name: str) -> str:
        """Returns the SHA-256 of a member, which is kept in memory where it will be needed."""
        if name in self._grounds:
            check_cancelled(self._cancelled)
            with self._reading:
                self._kept[name] = self._archive.read(name, self._archive.members[name].size)
            return hashlib.sha256(self._kept[name]).hexdigest()
        digest = hashlib.sha256()
        with self._reading:
            stream = self._archive.open(name)
        while True:
            check_cancelled(self._cancelled)
            with self._reading:
                piece = stream.read(PIECE)
            if not piece:
                break
            digest.update(piece)
        with self._reading:
            stream.finish()
        return digest.hexdigest()
