"""How a coverage joins what is selected: added, taken away, or as all that both have."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from engine.brush import edits
from engine.brush.covered import Covered
from engine.brush.mask import Coverage
from engine.brush.settings import Brush
from engine.brush.stamp import Stamp
from engine.canvas.attenuate import fold
from engine.canvas.commit import commit
from engine.canvas.compact import compact
from engine.canvas.evaluate import evaluate
from engine.canvas.selecting.selection import Selection
from engine.canvas.store import Level, Pyramid, Record, level_of
from engine.numeric.address import TILE, TileKey
from engine.texture.planes import COLOURS, Planes

_ALPHA = 3
_LAYING = Brush(colour="#000000")
_TAKING = Brush(mode="erase")


def with_more(pyramid: Pyramid, coverage: Coverage) -> Pyramid:
    """Returns a pyramid of alpha with a coverage M more: v' = (1 - M) v + M."""
    ink = edits.class_of(_LAYING.mode).ink_of(_LAYING, {}, coverage.level, 0)
    return commit(pyramid, edits.edit(_LAYING, coverage, ink))


def taken(pyramid: Pyramid, coverage: Coverage) -> Pyramid:
    """Returns a pyramid of alpha without a coverage: v' = (1 - M) v."""
    return commit(pyramid, edits.edit(_TAKING, coverage, None))


def shared(pyramid: Pyramid, coverage: Coverage, inverse: bool = False) -> Pyramid:
    """Returns v M, of a pyramid of alpha v and a coverage M, with all finer levels of v; `inverse`: (1 - v) M."""
    whole = fold(pyramid)
    finer = {k: stored for k, stored in whole.levels.items() if k > coverage.level}
    levels = type(whole.levels)({k: kept for k, s in finer.items() if len(kept := _below(s, k, coverage, inverse))})
    grid, commits = whole.grid, whole.commits
    bare = Pyramid(levels, whole.last, settled=whole.settled, grid=grid, commits=commits, family=whole.family)
    return commit(bare, _Shared(coverage, _LAYING, None, False, None, alpha=whole, inverse=inverse))


def _below(stored: Level, level: int, coverage: Coverage, inverse: bool) -> Level:
    """Returns the records of a level that lie below tiles of a coverage; `inverse`: those of 1 - v."""
    by, tiles = level - coverage.level, coverage.tiles
    kept = ((at, record) for at, record in stored.items() if TileKey(coverage.level, at[0] >> by, at[1] >> by) in tiles)
    return level_of({at: _negative(record) if inverse else record for at, record in kept})


def _negative(record: Record) -> Record:
    return replace(record, held=_read_only(-record.data.astype(np.int32)))


@dataclass(frozen=True, eq=False)
class _Shared(Covered):
    """What `shared` does at the coverage's level, on a pyramid that has nothing there: B = v M, A = M."""

    alpha: Pyramid = field(default_factory=Pyramid)
    inverse: bool = False

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        """Returns A and B of a tile, as `Edit.stamp`."""
        m = self.coverage.on_grid(key)
        v = evaluate(self.alpha, key.level, key.rect).data[_ALPHA]
        add = np.zeros((COLOURS, TILE, TILE), np.float32)
        add[_ALPHA] = np.rint((1.0 - v if self.inverse else v) * m * 65536.0) / 65536.0
        return Stamp(m, add)


def alpha_of(pyramid: Pyramid) -> Pyramid:
    """Returns a pyramid with the same alpha at every level, and nothing else."""
    whole = fold(pyramid)
    levels = {k: kept for k, stored in whole.levels.items() if len(kept := _bare(stored))}
    return Pyramid(
        type(whole.levels)(levels), whole.last, settled=whole.settled, grid=whole.grid, commits=whole.commits
    )


def _bare(stored: Level) -> Level:
    kept: dict[tuple[int, int], Record] = {}
    for at, record in stored.items():
        data = np.zeros((COLOURS, *record.data.shape[1:]), np.int32)
        data[_ALPHA] = record.data[_ALPHA]
        bare = compact(record.rect, data, (), record.depth)
        if bare is not None:
            kept[at] = bare
    return level_of(kept)


def _read_only(data: np.ndarray) -> np.ndarray:
    data.flags.writeable = False
    return data


def joined_with(old: Selection | None, coverage: Coverage, op: str, grid: int) -> Selection:
    """Returns what is selected after an op of `JOINS` with a coverage; None selects nothing in particular, so that
    what is added or shared is all there is."""
    if old is None or op == "replace":
        return Selection(with_more(Pyramid(grid=grid), coverage), inverse=old is None and op == "subtract")
    return JOINS[op](old, coverage)


def _added(old: Selection, coverage: Coverage) -> Selection:
    return replace(old, pyramid=(taken if old.inverse else with_more)(old.pyramid, coverage))


def _subtracted(old: Selection, coverage: Coverage) -> Selection:
    return replace(old, pyramid=(with_more if old.inverse else taken)(old.pyramid, coverage))


def _shared(old: Selection, coverage: Coverage) -> Selection:
    return Selection(shared(old.pyramid, coverage, old.inverse))


JOINS: dict[str, Callable[[Selection, Coverage], Selection]] = {
    "add": _added,
    "subtract": _subtracted,
    "intersect": _shared,
}


def joined_with_another(old: Selection | None, other: Selection, coverage: Coverage, op: str) -> Selection:
    """As `joined_with`, with another selection whose pyramid has a `coverage` where they are to join; by itself it is
    as it is at every level."""
    if old is None or op == "replace":
        return other.inverted() if old is None and op == "subtract" else other
    if not other.inverse:
        return JOINS[op](old, coverage)
    if op == "add":
        return _shared(old.inverted(), coverage).inverted()
    return (_shared if op == "subtract" else _subtracted)(old, coverage)
