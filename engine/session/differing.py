"""What differs between two states of the layers: records that only one of them has, and the bytes that these take."""

from __future__ import annotations

from collections.abc import Iterator

from engine.canvas import growth as growths
from engine.canvas import layers
from engine.canvas.growth import Growth
from engine.canvas.layers import Group
from engine.canvas.store import RECORD_OVERHEAD, Pyramid, Record, changed_rects
from engine.numeric.address import TileKey
from engine.texture.sparse_planes import SparsePlanes

_AROUND = 4  # pixels around a change whose residuals it also rewrites: those under the expanded parents
OnlyHere = tuple[TileKey, Record, Record | None]  # a record of one state, and what another has in its place


def difference(old: Group, new: Group) -> tuple[int, int]:
    """Returns bytes that only `old` holds, and bytes that only `new` holds."""
    before = {layer.id: layer for layer in layers.layers(old)}
    after = {layer.id: layer for layer in layers.layers(new)}
    lost = gained = 0
    for number in before.keys() | after.keys():
        one, other = before.get(number), after.get(number)
        fewer, more = _regrown(one.growth if one else (), other.growth if other else ())
        lost, gained = lost + fewer, gained + more
        a, b = one.pyramid if one else None, other.pyramid if other else None
        if a is b:
            continue
        if a is None or b is None or a.uid != b.uid:
            lost += a.nbytes if a is not None else 0
            gained += b.nbytes if b is not None else 0
            continue
        lost += sum(_alone(record, beside) for _, record, beside in _only(a, b))
        gained += sum(_alone(record, beside) for _, record, beside in _only(b, a))
        lost, gained = lost + _waiting(a, b), gained + _waiting(b, a)
    return lost, gained


def _alone(record: Record, beside: Record | None) -> int:
    """Returns the bytes that a record does not share with the one in its place."""
    if beside is not None and isinstance(record.held, SparsePlanes) and isinstance(beside.held, SparsePlanes):
        return record.held.alone(beside.held) + RECORD_OVERHEAD
    return record.nbytes


def _waiting(one: Pyramid, other: Pyramid) -> int:
    """Returns the bytes of attenuations that wait in one state and not in another."""
    there = {waits.change.serial for waits in other.waiting()}
    return sum(waits.nbytes for waits in one.waiting() if waits.change.serial not in there)


def _regrown(old: Growth, new: Growth) -> tuple[int, int]:
    """Returns the same of what was painted on a layer with examples."""
    if old is new:
        return 0, 0
    before, after = growths.arrays(old), growths.arrays(new)
    return sum(n for k, n in before.items() if k not in after), sum(n for k, n in after.items() if k not in before)


def changed_records(far: Group, near: Group) -> Iterator[OnlyHere]:
    """Yields the records that one of two states of the layers has and the other has not, of layers that both have."""
    there = {layer.id: layer.pyramid for layer in layers.layers(near)}
    for layer in layers.layers(far):
        other = there.get(layer.id)
        if other is not None and other is not layer.pyramid and other.uid == layer.pyramid.uid:
            yield from _only(layer.pyramid, other)


def apart_records(far: Group, near: Group) -> Iterator[OnlyHere]:
    """As `changed_records`, and those of layers that the other state has not."""
    there = {layer.id: layer.pyramid.uid for layer in layers.layers(near)}
    for layer in layers.layers(far):
        if there.get(layer.id) != layer.pyramid.uid:
            yield from ((key, record, None) for key, record in layer.pyramid.all_records())
    yield from changed_records(far, near)


def lost_records(old: Group, new: Group) -> Iterator[Record]:
    """Yields the records that one state of the layers has and a later one has not."""
    there = {layer.id for layer in layers.layers(new)}
    for layer in layers.layers(old):
        if layer.id not in there:
            yield from (record for _, record in layer.pyramid.all_records())
    yield from (record for _, record, _ in changed_records(old, new))


def _only(one: Pyramid, other: Pyramid) -> Iterator[OnlyHere]:
    """Yields the records of one state that another of the same line of history does not share, and what that has in
    their places."""
    for level, stored in one.levels.items():
        there = other.levels.get(level)
        if there is stored:
            continue
        # Folded in between, records changed wherever a stroke had waited; and several commits met the same tiles.
        if one.settled != other.settled or len(rects := changed_rects(other, one, level)) > 1:
            places = ((TileKey(level, *place), record) for place, record in stored.items())
        else:
            places = (found for rect in rects for found in one.records(level, rect.grown(_AROUND)))
        for key, record in places:
            beside = there.get((key.x, key.y)) if there is not None else None
            if beside is not record:
                yield key, record, beside
