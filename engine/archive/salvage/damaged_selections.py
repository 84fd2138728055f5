"""Selections, masks and heaps of a damaged painting: each as far as it is whole, from the coarsest level down to where
the first of its tiles is missing."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from immutables import Map

from engine.archive.grounds import with_tiles
from engine.archive.salvage.remains import Remains
from engine.archive.selected.selection_files import Chosen, SelectionEntry
from engine.canvas import layers
from engine.canvas.heaps.heaps import NO_HEAPS, Heaps
from engine.canvas.layers import Group
from engine.canvas.selecting.selection import Selection
from engine.canvas.store import Pyramid, Record
from engine.files.fault import shown
from engine.numeric.arithmetic import FINE

MISSING_TILES = "{what}: {missing} of {count} tiles are missing; it is coarser than it was"
MISSING_ALL = "{what} is missing"


class FoundSelections(NamedTuple):
    """What is had of them, and what is to be said."""

    chosen: Chosen
    notes: tuple[str, ...]


def found_selections(entries: Sequence[SelectionEntry], remains: Remains, root: Group, grid: int) -> FoundSelections:
    """Returns what is selected, what is kept, and the masks of nodes of a tree, as far as they can be had."""
    chosen, saved, masks, notes = None, dict[str, Selection](), dict[int, Selection](), list[str]()
    heaps = dict[int, Heaps]()
    names = {node.id: node.name for node in layers.walk(root)}
    for entry in entries:
        found, missing = _pyramid(entry, remains, grid if entry.heaps is None else FINE)
        if missing:
            count = sum(pack.tiles for pack in entry.packs)
            told = MISSING_ALL if found is None else MISSING_TILES
            notes.append(told.format(what=_what(entry, names), missing=missing, count=count))
        if found is None:
            continue
        selection = Selection(found, entry.inverse, entry.off)
        if entry.heaps is not None:
            heaps[entry.heaps] = heaps.get(entry.heaps, NO_HEAPS).set(entry.unit, found)
        elif entry.masks is not None:
            masks[entry.masks] = selection
        elif entry.name is None:
            chosen = selection
        else:
            saved[entry.name] = selection
    return FoundSelections(Chosen(chosen, Map(saved), masks, heaps), tuple(notes))


def _pyramid(entry: SelectionEntry, remains: Remains, grid: int) -> tuple[Pyramid | None, int]:
    """Returns the levels that are whole, None where none is, and how many tiles are missing."""
    rest = remains.tiles(tuple(entry.packs))
    plain = [
        (key, record) for key, record, implied in rest.tiles if entry.heaps is not None or not (record.inks or implied)
    ]
    missing = rest.missing + len(rest.tiles) - len(plain)
    if missing:
        plain = [] if rest.first is None else [(key, record) for key, record in plain if key.level < rest.first]
        if not plain:
            return None, missing
    levels: dict[int, dict[tuple[int, int], Record]] = {}
    for key, record in plain:
        levels.setdefault(key.level, {})[key.x, key.y] = record
    return with_tiles(Pyramid(grid=grid, commits=entry.commits), levels), missing


def _what(entry: SelectionEntry, names: dict[int, str]) -> str:
    if entry.heaps is not None:
        return f"what is heaped on layer {shown(names.get(entry.heaps, '?'), 30)}"
    if entry.masks is not None:
        return f"the mask of layer {shown(names.get(entry.masks, '?'), 30)}"
    return "what was selected" if entry.name is None else f"the selection {shown(entry.name, 30)}"
