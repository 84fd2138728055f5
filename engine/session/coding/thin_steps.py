"""Steps far from the present: of their far end only what differs from the near one, on disk as one piece.

A painting as a value has maps of all its tiles, of which each state holds some nodes of its own: tens of kilobytes a
step where tiles lie far apart.  The state is made again from the near end when that is the next one to be gone to.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from functools import partial

from immutables import Map

from engine.canvas import layers
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.store import Level, Pyramid, Record, level_of
from engine.keeping.spill import PLACE_OVERHEAD, Spilled, spill
from engine.numeric.address import Rect, TileKey
from engine.painting.value import Painting
from engine.session.coding import told_tiles
from engine.session.differing import placed_apart
from engine.session.held_pyramids import changed_nodes
from engine.texture.record import Instance

THIN_OVERHEAD = 800 + PLACE_OVERHEAD  # bytes of memory that such a step takes, roughly
_PLAIN = (int, float, str, Rect)
_APART = {Layer: {"pyramid"}, Group: {"children"}}


@dataclass(frozen=True, eq=False, slots=True)
class ThinStep:
    """A step that changed the paint of one layer alone.  `far`, `near`: its ends without their layers, one object where
    nothing else differs; `layer`: its name; `paint`: at the far end, without records; `inks`: stacks that these have;
    `piece`: tiles that differ."""

    far: Painting
    near: Painting
    layer: str
    paint: Pyramid
    inks: tuple[Instance, ...]
    piece: Spilled | bytes

    @property
    def nbytes(self) -> int:
        """Counts the bytes of memory that it takes, roughly."""
        return THIN_OVERHEAD + (len(self.piece) if isinstance(self.piece, bytes) else 0)

    def ends(self, root: Group) -> tuple[Painting, Painting]:
        """Returns its far and its near end; `root`: the layers at the near one.  OSError if they cannot be read."""
        node = layers.find(root, self.layer)
        assert isinstance(node, Layer)
        levels, found = node.pyramid.levels, dict[int, dict[tuple[int, int], Record | None]]()
        piece = self.piece if isinstance(self.piece, bytes) else self.piece.read()
        for key, record in told_tiles.read(piece, self.inks, partial(_record_at, levels)):
            found.setdefault(key.level, {})[key.x, key.y] = record
        for level, records in found.items():
            editable = level_of(levels.get(level, {})).mutate()
            for place, record in records.items():
                if record is None:
                    editable.pop(place, None)
                else:
                    editable.set(place, record)
            stored = level_of(editable.finish())
            levels = levels.set(level, stored) if len(stored) else levels.delete(level)
        far = layers.with_pyramid(root, self.layer, replace(self.paint, levels=levels))
        return replace(self.far, root=far), replace(self.near, root=root)


def thin_step(far: Painting, near: Painting) -> ThinStep | None:
    """Returns what makes one end of a step from the other; None where they differ in more than the paint of one layer,
    or in tiles too far away."""
    lost, found = changed_nodes(far.root, near.root)
    changed = [(a, b) for a, b in zip(lost, found, strict=False) if isinstance(a, Layer)]
    if len(lost) != len(found) or len(changed) != 1:
        return None
    if not all(map(_alike, (far.root, *lost), (near.root, *found))):
        return None
    one, other = changed[0]
    assert isinstance(other, Layer)
    paint, beside = one.pyramid, other.pyramid
    if paint.uid != beside.uid or layers.find(near.root, one.name) is not other:
        return None
    told = told_tiles.tell(list(placed_apart(paint, beside)))
    if told is None:
        return None
    inks, piece = told
    ends = replace(far, root=layers.EMPTY), replace(near, root=layers.EMPTY)
    bare = replace(paint, levels=Pyramid().levels, known=Pyramid().known, bounds_known=None)
    same = _same(*ends, set())
    return ThinStep(ends[same], ends[1], one.name, bare, inks, spill().put_spare(piece) or piece)


def _alike(one: Node, other: Node) -> bool:
    """Tells whether two nodes differ in their paint, or in what lies in them, alone."""
    return type(one) is type(other) and type(one) in _APART and _same(one, other, _APART[type(one)])


def _same(one: Painting | Node, other: Painting | Node, apart: set[str]) -> bool:
    names = (field.name for field in fields(one) if field.name not in apart)
    pairs = ((getattr(one, name), getattr(other, name)) for name in names)
    return all(a is b or (isinstance(a, _PLAIN) and a == b) for a, b in pairs)


def _record_at(levels: Map[int, Level], key: TileKey) -> Record | None:
    """Returns the record that a tile has."""
    stored = levels.get(key.level)
    return None if stored is None else stored.get((key.x, key.y))
