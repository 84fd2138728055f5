"""What differs between two states of the layers: records that only one of them has, of paint, of heaps or of masks, and
the bytes that these take."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Iterator, Set

from immutables import Map

from engine.canvas import growth as growths
from engine.canvas import layers
from engine.canvas.growth import Growth
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.rising.page_places import TilePlace
from engine.canvas.rising.paged_level import PagedLevel, shared
from engine.canvas.store import (
    RECORD_OVERHEAD,
    Change,
    Level,
    Pyramid,
    Record,
    changed_rects,
    changes_between,
)
from engine.numeric.address import Rect, TileKey
from engine.session.held_pyramids import Sheet, changed_nodes, pyramids, pyramids_of, related
from engine.texture.example.tiles import TilePlanes
from engine.texture.sparse_planes import SparsePlanes

_AROUND = 4  # pixels around a change whose residuals it also rewrites: those under the expanded parents
_NOTHING: Level = Map()
_FEW = 256  # places that are looked at one by one
OnlyHere = tuple[TileKey, Record, Record | None]  # a record of one state, and what another has in its place
Lessen = Callable[[Record | None, Record], None]


class _Holding:
    """The records in memory of a state of the layers, looked for in all that may share them: a copy of a layer does.

    `families`: of the pyramids whose records are looked for."""

    def __init__(self, root: Group, families: Set[int]) -> None:
        self._pyramids = related(root, families)
        self._levels: dict[int, list[Level]] = {}

    def holds(self, key: TileKey, record: Record | None) -> bool:
        """Tells whether some layer has a record at its place."""
        place = key.x, key.y
        return any(_in_memory(level, place) is record for level in self._of(key.level))

    def lacks(self, pyramid: Pyramid) -> int:
        """Counts the bytes in memory of what no layer has of a pyramid: of records, and of attenuations that wait."""
        there_wait = {waits.change.serial for one in self._pyramids for waits in one.waiting()}
        size = sum(waits.nbytes for waits in pyramid.waiting() if waits.change.serial not in there_wait)
        for level, stored in pyramid.levels.items():
            there = self._of(level)
            if any(one is stored for one in there):
                continue
            for place, record in _all_in_memory(stored, there):
                if not any(_in_memory(one, place) is record for one in there):
                    size += record.nbytes
        return size

    def _of(self, level: int) -> list[Level]:
        """Returns what the layers have of a level."""
        found = self._levels.get(level)
        if found is None:
            stored = (pyramid.levels.get(level) for pyramid in self._pyramids)
            found = self._levels[level] = [one for one in stored if one is not None]
        return found


def _in_memory(level: Level, place: TilePlace) -> Record | None:
    """Returns the record of a tile; None if it has none, or that lies on disk."""
    if not isinstance(level, PagedLevel):
        return level.get(place)
    page = level.page_at(place)
    return None if page is None else page.held[1].get(place)


def _all_in_memory(stored: Level, beside: list[Level]) -> Iterator[tuple[TilePlace, Record]]:
    """Yields the records in memory of a level with their places, but for pages that others have, too."""
    if not isinstance(stored, PagedLevel):
        yield from stored.items()
        return
    for at, page in stored.pages.items():
        if not any(isinstance(one, PagedLevel) and one.pages.get(at) is page for one in beside):
            yield from ((place, record) for place, record in page.held[1].items() if record is not None)


def difference(old: Group, new: Group, lessen: Lessen | None = None) -> tuple[int, int]:
    """Returns bytes that only `old` holds, and bytes that only `new` holds, in whichever layer.  `lessen`: makes a
    record that took a place smaller, and the one that only `old` holds by it, if there is one, before both are
    counted."""
    nodes = changed_nodes(old, new)
    before, after = map(_growths, nodes)
    lost = gained = 0
    for number in before.keys() | after.keys():
        one, other = before.get(number, ()), after.get(number, ())
        lost += _regrown(one, other)
        gained += _regrown(other, one)
    here, there = map(pyramids_of, nodes)
    families = {pyramid.family for pyramid in (*here.values(), *there.values())}
    in_old, in_new = _Holding(old, families), _Holding(new, families)
    for sheet in here.keys() | there.keys():
        a, b = here.get(sheet), there.get(sheet)
        if a is b:
            continue
        if a is None or b is None or a.uid != b.uid:
            lost += in_new.lacks(a) if a is not None else 0
            gained += in_old.lacks(b) if b is not None else 0
            continue
        for key, record, beside in placed_apart(a, b):
            apart = not in_new.holds(key, record)
            if lessen is not None and beside is not None:
                lessen(record if apart else None, beside)
            lost += _alone(record, beside) if apart else 0
            gained += 0 if in_old.holds(key, beside) else _alone(beside, record)
        lost, gained = lost + _waiting(a, b), gained + _waiting(b, a)
    return lost, gained


def _growths(nodes: Iterable[Node]) -> dict[int, Growth]:
    """Returns what was painted with examples on those of some nodes that are layers, by their ids."""
    return {node.id: node.growth for node in nodes if isinstance(node, Layer)}


def _alone(record: Record | None, beside: Record | None) -> int:
    """Returns the bytes that a record does not share with the one in its place."""
    if record is None:
        return 0
    if beside is not None and isinstance(record.held, SparsePlanes) and isinstance(beside.held, SparsePlanes):
        return record.held.alone(beside.held) + RECORD_OVERHEAD
    return record.nbytes


def _waiting(one: Pyramid, other: Pyramid) -> int:
    """Returns the bytes of attenuations that wait in one state and not in another."""
    there = {waits.change.serial for waits in other.waiting()}
    return sum(waits.nbytes for waits in one.waiting() if waits.change.serial not in there)


def _regrown(one: Growth, other: Growth) -> int:
    """Returns the bytes of what was painted on a layer with examples that another state has not."""
    if one is other:
        return 0
    return sum(tile.nbytes for tile in growths.tiles_of(one) - growths.tiles_of(other))


def changed_records(far: Group, near: Group) -> Iterator[OnlyHere]:
    """Yields the records that one of two states of the layers has and the other has not, of layers that both have."""
    yield from _changed_records(*map(pyramids_of, changed_nodes(far, near)))


def _changed_records(far: dict[Sheet, Pyramid], near: dict[Sheet, Pyramid]) -> Iterator[OnlyHere]:
    for sheet, pyramid in far.items():
        other = near.get(sheet)
        if other is not None and other is not pyramid and other.uid == pyramid.uid:
            yield from _only(pyramid, other)


def apart_records(far: Group, near: Group) -> Iterator[OnlyHere]:
    """As `changed_records`, and those of layers that the other state has not."""
    here, there = map(pyramids_of, changed_nodes(far, near))
    for sheet, pyramid in here.items():
        other = there.get(sheet)
        if other is None or other.uid != pyramid.uid:
            yield from ((key, record, None) for key, record in pyramid.all_records())
    yield from _changed_records(here, there)


def placed_records(far: Group, near: Group) -> Iterator[tuple[Record, Record | None]]:
    """Yields records in memory of one state of the layers, whatever lies between it and another, and those that the
    other has in their places: all that differ, and some that do not."""
    there = pyramids(near)
    for sheet, pyramid in pyramids(far).items():
        other = there.get(sheet)
        for level, stored in pyramid.levels.items():
            beside = _NOTHING if other is None else other.levels.get(level, _NOTHING)
            if stored is not beside:
                found = _all_in_memory(stored, [beside])
                yield from ((record, _in_memory(beside, place)) for place, record in found)


def apart_tiles(far: Group, near: Group) -> set[TilePlanes]:
    """Returns the tiles of what was painted with examples that one state of the layers has, and another nowhere."""
    here, there = map(_growths, changed_nodes(far, near))
    changed = [growth for number, growth in here.items() if there.get(number) is not growth]
    found: set[TilePlanes] = set().union(*map(growths.tiles_of, changed))
    return found.difference(*(growths.tiles_of(layer.growth) for layer in layers.layers(near))) if found else found


def lost_records(old: Group, new: Group) -> Iterator[Record]:
    """Yields the records that one state of the layers has and a later one has not."""
    here, there = map(pyramids_of, changed_nodes(old, new))
    for sheet, pyramid in here.items():
        if sheet not in there:
            yield from (record for _, record in pyramid.all_records())
    yield from (record for _, record, _ in _changed_records(here, there))


def _only(one: Pyramid, other: Pyramid) -> Iterator[OnlyHere]:
    """Yields the records of one state that another of the same line of history does not share, and what that has in
    their places."""
    return ((key, record, beside) for key, record, beside in placed_apart(one, other) if record is not None)


def placed_apart(one: Pyramid, other: Pyramid) -> Iterator[tuple[TileKey, Record | None, Record | None]]:
    """Yields the places where two states of a line of history have other records, and what each has there."""
    folded = _folded_between(one, other)
    for level in _levels_apart(one, other, folded):
        here, there = one.levels.get(level, _NOTHING), other.levels.get(level, _NOTHING)
        if here is there:
            continue
        for place in _places(_rewritten(one, other, folded, level), (one, other), level):
            if shared(here, there, place):
                continue
            record, beside = here.get(place), there.get(place)
            if record is not beside:
                yield TileKey(level, *place), record, beside


def _folded_between(one: Pyramid, other: Pyramid) -> list[Change]:
    """Returns the commits of which what they leave of finer detail waits in one of two states, and is settled in the
    other: records changed wherever it lay."""
    if one.waits is other.waits:
        return []
    here, there = ({waits.change.serial: waits.change for waits in state.waiting()} for state in (one, other))
    left = [change for serial, change in here.items() if serial not in there and change.depth <= other.settled]
    return left + [change for serial, change in there.items() if serial not in here and change.depth <= one.settled]


def _levels_apart(one: Pyramid, other: Pyramid, folded: list[Change]) -> Iterable[int]:
    """Returns the levels that have other records in two states of a line of history, and perhaps some that have not."""
    whole = {*one.levels, *other.levels} if folded else set[int]()
    for change in changes_between(one.last, other.last) if not folded else ():
        if change.coarsest is None:
            return {*one.levels, *other.levels}
        whole.update(range(change.coarsest, change.level + 1))
    return whole


def _rewritten(one: Pyramid, other: Pyramid, folded: list[Change], level: int) -> list[Rect]:
    """Returns rectangles of tiles of a level, out of which both states have the same records."""
    rects = [rect.grown(_AROUND) for rect in changed_rects(other, one, level)]
    rects += [change.reach(level).grown(_AROUND) for change in folded if change.level < level]
    return [rect.within_tiles() for rect in rects]


def _places(rects: list[Rect], states: tuple[Pyramid, Pyramid], level: int) -> Iterable[tuple[int, int]]:
    """Returns the places in some rectangles of tiles, each once; where they are many, those that have records instead:
    columns and rows."""
    if sum(rect.area for rect in rects) > _FEW:
        return dict.fromkeys(place for state in states for place in _held_within(rects, state, level))
    found = ((x, y) for x0, y0, x1, y1 in rects for y in range(y0, y1) for x in range(x0, x1))
    return found if len(rects) == 1 else dict.fromkeys(found)


def _held_within(rects: list[Rect], state: Pyramid, level: int) -> Iterable[tuple[int, int]]:
    """Returns the places in some rectangles of tiles that have records, or all where they are few."""
    places = state.blocks(level)
    if places is None:
        return state.levels.get(level, _NOTHING)
    return itertools.chain.from_iterable(map(places.within, rects))
