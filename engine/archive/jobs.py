"""Members of a painting's file that are yet to be made, and those with its tiles."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import IO

import numpy as np

from engine.archive.implied import Tile, without
from engine.archive.manifest import Pack
from engine.archive.packing import grouped, pack
from engine.archive.shelves.shelf import as_filed
from engine.numeric.address import TileKey
from engine.numeric.arithmetic import COARSE
from engine.painting.cascade import Cascade


@dataclass(frozen=True)
class Job:
    """One member: its name, and what makes its bytes, or a file of them; `deflate`: text."""

    name: str
    make: Callable[[], bytes | IO[bytes]]
    deflate: bool = False


def pack_jobs(stem: str, tiles: Iterable[Tile], packs: list[Pack], values: Cascade | None = None) -> Iterator[Job]:
    """Yields the packs of some tiles; `values` of their pyramid, if what ink implies of them may be left out: its tiles
    may lie on disk, and are asked for again when a pack is made."""
    for number, group in enumerate(grouped(tiles)):
        name = f"{stem}/{number}.tiles"
        packs.append(Pack(name, len(group), sum(record.plain_size for _, record in group)))
        make = partial(_plain_pack, group) if values is None else partial(_packed, _places(group), values)
        yield Job(name, make)


def _plain_pack(group: Sequence[Tile]) -> bytes:
    return pack([(key, record, None) for key, record in group])


def _places(group: Sequence[Tile]) -> np.ndarray:
    """Returns level, column and row of some tiles (n, 3): there may be millions."""
    places = [tuple(key) for key, _ in group]
    try:
        return np.array(places, np.int64)
    except OverflowError:
        return np.array(places, object)


def _packed(places: np.ndarray, values: Cascade) -> bytes:
    pyramid = values.pyramid
    group = [(TileKey(level, x, y), pyramid.levels[level][x, y]) for level, x, y in places.tolist()]
    return pack(as_filed(pyramid, group) or without(values, group), closely=pyramid.grid == COARSE)
