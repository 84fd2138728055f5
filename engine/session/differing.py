"""What differs between two states of the layers: records that only one of them has, and the bytes that these take."""

from __future__ import annotations

from collections.abc import Iterator

from engine.canvas import growth as growths
from engine.canvas import layers
from engine.canvas.growth import Growth
from engine.canvas.layers import Group
from engine.canvas.store import RECORD_OVERHEAD, Change, Pyramid, Record, changed_rects
from engine.numeric.address import Rect, TileKey
from engine.texture.sparse_planes import SparsePlanes

_AROUND = 4  # pixels around a change whose residuals it also rewrites: those under the expanded parents
OnlyHere = tuple[TileKey, Record, Record | None]  # a record of one state, and what another has in its place


def difference(old: Group, new: Group) -> tuple[int, int]:
    """Returns bytes that only `old` holds, and bytes that only `new` holds."""
    return alone(old, new), alone(new, old)


def alone(far: Group, near: Group) -> int:
    """Returns bytes that only one of two states of the layers, `far`, holds."""
    there, held = {layer.id: layer for layer in layers.layers(near)}, 0
    for layer in layers.layers(far):
        other = there.get(layer.id)
        held += _regrown(layer.growth, other.growth if other else ())
        one, beside = layer.pyramid, other.pyramid if other else None
        if one is beside:
            continue
        if beside is None or one.uid != beside.uid:
            held += one.nbytes
            continue
        held += sum(_alone(record, found) for _, record, found in _only(one, beside)) + _waiting(one, beside)
    return held


def _alone(record: Record, beside: Record | None) -> int:
    """Returns the bytes that a record does not share with the one in its place."""
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
    there = growths.arrays(other)
    return sum(size for array, size in growths.arrays(one).items() if array not in there)


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
    folded = _folded_between(one, other)
    for level, stored in one.levels.items():
        there = other.levels.get(level)
        if there is stored:
            continue
        for key, record in _places(one, level, _rewritten(one, other, folded, level)):
            beside = there.get((key.x, key.y)) if there is not None else None
            if beside is not record:
                yield key, record, beside


def _folded_between(one: Pyramid, other: Pyramid) -> list[Change]:
    """Returns the commits of which what they leave of finer detail waits in one of two states alone: records changed
    wherever it lay."""
    if one.waits is other.waits:
        return []
    here, there = ({waits.change.serial: waits.change for waits in state.waiting()} for state in (one, other))
    return [(here.get(serial) or there[serial]) for serial in here.keys() ^ there.keys()]


def _rewritten(one: Pyramid, other: Pyramid, folded: list[Change], level: int) -> list[Rect]:
    """Returns rectangles of a level out of which both states have the same records."""
    rects = [rect.grown(_AROUND) for rect in changed_rects(other, one, level)]
    return rects + [change.reach(level).grown(_AROUND) for change in folded if change.level < level]


def _places(pyramid: Pyramid, level: int, rects: list[Rect]) -> Iterator[tuple[TileKey, Record]]:
    """Yields the records of a level that meet any of some rectangles, each once."""
    stored = pyramid.levels[level]
    if len(rects) == 1:
        yield from pyramid.records(level, rects[0])
    elif sum(rect.within_tiles().area for rect in rects) >= len(stored):  # that many would be looked for
        yield from ((TileKey(level, *place), record) for place, record in stored.items())
    else:
        yield from {key: record for rect in rects for key, record in pyramid.records(level, rect)}.items()
