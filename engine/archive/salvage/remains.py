"""What is whole of a damaged painting's file: manifest, recording, pictures, packs, each by itself."""

from __future__ import annotations

import hashlib
import io
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path

import numpy as np
from immutables import Map

from engine.archive import pictures
from engine.archive.implied import Coded
from engine.archive.imports import STACK
from engine.archive.manifest import FORMAT, MANIFEST, MANIFEST_AGAIN, RECORDING, Manifest, Pack, parse_manifest
from engine.archive.members import CHANGED, PIECE, Stored
from engine.archive.packing import unpack, unpack_torn
from engine.archive.salvage.damaged_layer import Rest
from engine.canvas.node_checks import LayerError
from engine.checks.field_error import FieldError
from engine.files.fault import FileError, shown
from engine.files.limits import Limits
from engine.files.png_reader import PngReader
from engine.files.stack_xml import ImageEntry, parse_stack
from engine.files.strict_json import loads
from engine.files.zip_salvage import SalvagedArchive
from engine.numeric.address import TileKey
from engine.painting.recording import Recording, torn_from
from engine.painting.rendering import Stop, check_cancelled
from engine.texture.image import ImageSource
from engine.texture.record import pictures_of
from engine.texture.table import from_key


class Remains:
    """What is whole of one damaged file; `manifest`: that of either end, None where neither is whole."""

    def __init__(self, archive: SalvagedArchive, limits: Limits, cancelled: Stop) -> None:
        self.archive = archive
        self.limits = limits
        self.cancelled = cancelled
        self.manifest, self._newer = self._found_manifest()

    def _found_manifest(self) -> tuple[Manifest | None, bool]:
        """Returns the manifest of either end, and whether a newer program wrote it."""
        for name in (MANIFEST, MANIFEST_AGAIN):
            try:
                value = loads(self.archive.read(name, self.limits.json), cap=self.limits.json)
                version = value.get("inkfall") if isinstance(value, dict) else None
                if type(version) is int and version > FORMAT:
                    return None, True
                return parse_manifest(value), False
            except (FileError, FieldError, LayerError):
                continue
        return None, False

    @cached_property
    def recording(self) -> tuple[Recording | None, FileError | None]:
        """Returns the recording, None where nothing of it is left, and what is wrong with it, None for nothing."""
        where = self.where(RECORDING)
        torn = RECORDING not in self.archive
        try:
            if self._newer or (torn and RECORDING not in self.archive.torn):
                raise FileError(where, "is missing")
            most = self.limits.log
            data = self.archive.beginning(RECORDING, most) if torn else self.archive.read(RECORDING, most)
            found, fault = torn_from(io.BytesIO(data), where, Path(self.archive.name).parent)
        except FileError as error:
            return None, error
        return found, fault or (FileError(where, "ends before it is whole") if torn else None)

    @cached_property
    def pictures(self) -> Map[str, ImageSource]:
        """Gives the pictures that inks, textures and definitions refer to, as far as they are whole, by their sha."""
        found: dict[str, ImageSource] = {}
        for sha, entry in self.manifest.pictures.items() if self.manifest is not None else ():
            try:
                tiles = [tile for pack in entry.packs for tile in self._unpacked(pack, {})]
                parts = [(key, record) for key, record, _ in tiles]
                found[sha] = pictures.assembled(entry.name, sha, entry.size, parts, self.archive.name)
            except FileError:
                continue
        return Map(found)

    @cached_property
    def overtaken(self) -> str:
        """Says what another program changed before the file was damaged; "" for nothing."""
        told = {} if self.manifest is None else self.manifest.members
        for name, (_, sha) in told.items():
            if name.startswith((STACK, "data/")) and name in self.archive and self._sum(name) != sha:
                return CHANGED.format(what=shown(name))
        return ""

    # ---- reading ----

    @cached_property
    def stack(self) -> ImageEntry | None:
        """Gives what stack.xml tells, if it is whole."""
        try:
            return parse_stack(self.archive.read(STACK, self.limits.xml), self.archive.name, self.limits)
        except FileError:
            return None

    def png(self, name: str) -> np.ndarray | None:
        """Returns the pixels of a PNG, (h, w, 4), if it is whole."""
        try:
            return PngReader(self.archive.open(name), self.where(name), self.limits).read()  # type: ignore[arg-type]
        except FileError:
            return None

    def where(self, member: str) -> str:
        """Tells how a fault names a member."""
        return f"{self.archive.name}: member {shown(member)}"

    def tiles(self, packs: tuple[Pack, ...]) -> Rest:
        """Returns what is left of the tiles of some packs."""
        found: list[Coded] = []
        gone: list[TileKey] = []
        unknown: list[int | None] = []  # before packs of which nothing is known: the finest level of the one before
        for pack in packs:
            others: list[TileKey] = []
            try:
                whole = self._unpacked(pack, self.pictures)
            except FileError:
                whole, others = self._unpacked_torn(pack)
            if not whole and not others:
                unknown.append(max((key.level for key, *_ in found), default=None))
            found += filter(_is_seen, whole)
            gone += [*others, *(tile[0] for tile in whole if not _is_seen(tile))]
        levels = [*unknown, *(key.level for key in gone)]
        first = None if None in levels else min((level for level in levels if level is not None), default=0)
        return Rest(found, gone, sum(pack.tiles for pack in packs) - len(found), first)

    def bytes_of(self, member: str) -> bytes:
        """Returns a member's bytes, those that the manifest names; else FileError."""
        assert self.manifest is not None
        size, sha = self.manifest.members.get(member, (0, ""))
        check_cancelled(self.cancelled)
        return Stored(self.archive.read(member, size), sha, self.where(member)).checked()

    def _unpacked(self, pack: Pack, sources: Mapping[str, ImageSource]) -> list[Coded]:
        data = self.bytes_of(pack.member)
        return unpack(data, self.archive.name, lambda key: from_key(key, sources), (pack.tiles, pack.plain))

    def _unpacked_torn(self, pack: Pack) -> tuple[list[Coded], list[TileKey]]:
        if pack.member not in self.archive.torn or self.manifest is None:
            return [], []
        data = self.archive.beginning(pack.member, self.manifest.members[pack.member][0])
        return unpack_torn(data, lambda key: from_key(key, self.pictures), (pack.tiles, pack.plain))

    def _sum(self, name: str) -> str:
        digest = hashlib.sha256()
        stream = self.archive.open(name)
        while piece := stream.read(PIECE):
            check_cancelled(self.cancelled)
            digest.update(piece)
        return digest.hexdigest()


def _is_seen(tile: Coded) -> bool:
    """Tells whether the pictures of all inks of a tile are there."""
    _, record, implied = tile
    inks = (*record.inks, *(() if implied is None else implied.inks))
    return all(source.there for ink in inks for source in pictures_of(ink))
