"""Selections and heaps in a painting's file: their packs, and how the manifest tells of them."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any, NamedTuple, TypeVar

from immutables import Map

from engine.archive.grounds import with_tiles
from engine.archive.implied import Coded, ordered
from engine.canvas import layers
from engine.canvas.attenuate import fold
from engine.canvas.heaps.heaps import NO_HEAPS, Heaps
from engine.canvas.layers import Group, Layer
from engine.canvas.placing.pose import Pose
from engine.canvas.selecting.selection import NONE_SAVED, Saved, Selection
from engine.canvas.store import Pyramid, Record
from engine.checks.field_error import FieldError
from engine.files.strict_json import Fields, is_name
from engine.numeric.address import TileKey
from engine.numeric.arithmetic import FINE
from engine.painting.layering.placing_members import Members, Placing, Same, read_placing, write_placing
from engine.painting.value import Painting

Packs = list[Any]  # of `manifest.Pack`s
MOST_SELECTIONS = 4096  # of one painting
MOST_UNIT = 1 << 17  # of a heap's exponents


@dataclass(frozen=True)
class SelectionEntry:
    """A selection kept under a name; None: what is selected; `masks`: it is the mask of the node of that id instead,
    `off` if it is put aside, made when that was at a `pose`; `heaps`: it is a heap of the layer of that id, in `unit`s.
    `packs`: where its tiles are."""

    name: str | None
    inverse: bool
    packs: Packs
    commits: int = 0
    masks: int | None = None
    off: bool = False
    pose: Pose | None = None
    heaps: int | None = None
    unit: int = 0


class Chosen(NamedTuple):
    """What is selected, what is kept by name, and the masks and heaps of nodes, by their ids."""

    selection: Selection | None = None
    saved: Saved = NONE_SAVED
    masks: Mapping[int, Selection] = MappingProxyType({})
    heaps: Mapping[int, Heaps] = MappingProxyType({})


J = TypeVar("J")


def entries_of(
    painting: Painting, packed: Callable[[str, list[tuple[TileKey, Record]], Packs], Iterator[J]]
) -> tuple[list[SelectionEntry], list[J]]:
    """Returns the selections of a painting, and what makes their members: `packed`, of the stem of their names and of
    tiles, which notes the packs."""
    named: list[tuple[str | None, int | None, Selection]] = [
        (name, None, one) for name, one in sorted(painting.selections.items())
    ]
    if painting.selection is not None:
        named.append((None, None, painting.selection))
    named += [(None, number, mask) for number, mask in masks_of(painting.root)]
    entries, jobs = list[SelectionEntry](), list[J]()
    for number, (name, masks, selection) in enumerate(named):
        pyramid = fold(selection.pyramid)
        entries.append(
            SelectionEntry(name, selection.inverse, [], pyramid.commits, masks, selection.off, selection.pose)
        )
        tiles = ordered(list(pyramid.all_records()))
        jobs += packed(f"inkfall/selections/{number}", tiles, entries[-1].packs)
    for layer in layers.layers(painting.root):
        for unit, heap in sorted(layer.heaps.items()):
            pyramid = fold(heap)
            entries.append(SelectionEntry(None, False, [], pyramid.commits, heaps=layer.id, unit=unit))
            tiles = ordered(list(pyramid.all_records()))
            jobs += packed(f"inkfall/heaps/{layer.id}/{unit}", tiles, entries[-1].packs)
    return entries, jobs


def selections_told(entries: Sequence[SelectionEntry], packs: Callable[..., Packs]) -> Members:
    """Tells selections and heaps as members of the manifest; nothing where there is none.  `packs` tells of one
    pack."""
    heaped: Members = {
        "heaps": [
            {
                "layer": entry.heaps,
                "unit": entry.unit,
                "commits": entry.commits,
                "packs": [packs(pack) for pack in entry.packs],
            }
            for entry in entries
            if entry.heaps is not None
        ]
    }
    entries = [entry for entry in entries if entry.heaps is None]
    heaped = heaped if heaped["heaps"] else {}
    if not entries:
        return heaped
    return {
        **heaped,
        "selections": [
            {
                **({"name": entry.name} if entry.name is not None else {}),
                **({"masks": entry.masks} if entry.masks is not None else {}),
                "inverse": entry.inverse,
                **({"off": True} if entry.off else {}),
                **({} if entry.pose is None else {"pose": write_placing(Placing.at_pose(entry.pose))}),
                "commits": entry.commits,
                "packs": [packs(pack) for pack in entry.packs],
            }
            for entry in entries
        ],
    }


def read_selections(members: Fields, packs: Callable[[Fields], Sequence[object]]) -> tuple[SelectionEntry, ...]:
    """Reads the members; FieldError names what is wrong.  `packs` reads those of one."""
    heaped = _read_heaps(members.take("heaps", []), packs)
    return (*_read_selections(members.take("selections", []), packs), *heaped)


def _read_heaps(value: object, packs: Callable[[Fields], Sequence[object]]) -> list[SelectionEntry]:
    if not isinstance(value, list) or len(value) > MOST_SELECTIONS:
        raise FieldError("manifest.heaps", "another form", f"a list of at most {MOST_SELECTIONS}")
    out, seen = [], set[tuple[int, int]]()
    for i, one in enumerate(value):
        members = Fields(one, f"heaps[{i}]")
        layer, unit = members.integer("layer", lo=1, hi=1 << 62), members.integer("unit", lo=-MOST_UNIT, hi=MOST_UNIT)
        if (layer, unit) in seen:
            raise members.fault("unit", "one that no other heap of the layer has")
        seen.add((layer, unit))
        commits = members.integer("commits", lo=0, hi=1 << 62)
        out.append(SelectionEntry(None, False, list(packs(members)), commits, heaps=layer, unit=unit))
    return out


def _read_selections(value: object, packs: Callable[[Fields], Sequence[object]]) -> tuple[SelectionEntry, ...]:
    if not isinstance(value, list) or len(value) > MOST_SELECTIONS:
        raise FieldError("manifest.selections", "another form", f"a list of at most {MOST_SELECTIONS}")
    out, names = [], set[tuple[str | None, int | None]]()
    for i, one in enumerate(value):
        members = Fields(one, f"selections[{i}]")
        name = members.take("name", None)
        masks = None if name is not None or "masks" not in members else members.integer("masks", lo=1, hi=1 << 62)
        if not (name is None or is_name(name)) or (name, masks) in names:
            raise members.fault("name", "a text that no other has")
        names.add((name, masks))
        commits = members.integer("commits", lo=0, hi=1 << 62)
        pose = _pose(members) if masks is not None and "pose" in members else None
        out.append(
            SelectionEntry(
                name, members.flag("inverse"), list(packs(members)), commits, masks, members.flag("off", False), pose
            )
        )
    return tuple(out)


def _pose(members: Fields) -> Pose:
    placing = read_placing(Fields(members.take("pose"), members.at("pose")))
    if placing.of is not Same.SAME or placing.fields():
        raise members.fault("pose", "where a placement was, and nothing of what it showed")
    return placing.posed(Pose())


def with_tiles_of(
    entries: Sequence[SelectionEntry],
    grid: int,
    tiles: Callable[[Packs], Iterator[Coded]],
    levels: Callable[[Sequence[Coded]], Mapping[int, Mapping[tuple[int, int], Record]]],
) -> Chosen:
    """Returns selections of a file; `tiles` reads packs, `levels` lays them out.  One with ink, which none has but
    a heap, is refused by FieldError."""
    chosen, saved, masks, heaps = None, dict[str, Selection](), dict[int, Selection](), dict[int, Heaps]()
    for entry in entries:
        found = list(tiles(entry.packs))
        if entry.heaps is None and any(record.inks or implied for _, record, implied in found):
            raise FieldError("selections", "ink", "tiles without ink")
        own = FINE if entry.heaps is not None else grid
        pyramid = with_tiles(Pyramid(grid=own, commits=entry.commits), levels(found))
        if entry.heaps is not None:
            heaps[entry.heaps] = heaps.get(entry.heaps, NO_HEAPS).set(entry.unit, pyramid)
        elif entry.masks is not None:
            masks[entry.masks] = Selection(pyramid, entry.inverse, entry.off, entry.pose)
        elif entry.name is None:
            chosen = Selection(pyramid, entry.inverse)
        else:
            saved[entry.name] = Selection(pyramid, entry.inverse)
    return Chosen(chosen, Map(saved), masks, heaps)


def masks_of(root: Group) -> Iterator[tuple[int, Selection]]:
    """Yields the masks of a tree, with the ids of the nodes that have them."""
    for node in layers.walk(root):
        if node.mask is not None:
            yield node.id, node.mask


def with_masks(root: Group, masks: Mapping[int, Selection], pictured: Container[int] = ()) -> Group:
    """Returns the tree with masks on the nodes of some ids, but not on those whose paint is their picture: that is
    what the mask left."""
    for node in list(layers.walk(root)) if masks else []:
        if node.id in masks and node.id not in pictured:
            root = layers.set_fields(root, node.name, mask=masks[node.id])
    return root


def with_heaps(root: Group, heaps: Mapping[int, Heaps]) -> Group:
    """Returns the tree with heaps on the layers of some ids."""
    for node in list(layers.walk(root)) if heaps else []:
        if isinstance(node, Layer) and node.id in heaps:
            root = layers.substitute(root, node.name, replace(node, heaps=heaps[node.id]))
    return root
