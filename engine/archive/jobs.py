"""Members of a painting's file that are yet to be made, and those with its tiles."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import IO

from engine.archive.implied import Tile, without
from engine.archive.manifest import Pack
from engine.archive.packing import grouped, pack
from engine.archive.shelf import as_filed
from engine.numeric.arithmetic import COARSE
from engine.painting.cascade import Cascade


@dataclass(frozen=True)
class Job:
    """One member: its name, and what makes its bytes, or a file of them; `deflate`: text."""

    name: str
    make: Callable[[], bytes | IO[bytes]]
    deflate: bool = False


def pack_jobs(stem: str, tiles: list[Tile], packs: list[Pack], values: Cascade | None = None) -> Iterator[Job]:
    """Yields the packs of some tiles; `values` of their pyramid, if what ink implies of them may be left out."""
    for number, group in enumerate(grouped(tiles)):
        name = f"{stem}/{number}.tiles"
        packs.append(Pack(name, len(group), sum(record.plain_size for _, record in group)))
        yield Job(name, partial(_packed, group, values))


def _packed(group: Sequence[Tile], values: Cascade | None) -> bytes:
    if values is None:
        return pack([(key, record, None) for key, record in group])
    pyramid = values.pyramid
    return pack(as_filed(pyramid, group) or without(values, group), closely=pyramid.grid == COARSE)
