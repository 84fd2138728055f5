"""The painting as a value: frame, seed, layers, the active one, the textures that were defined, bookmarks."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import NamedTuple

from immutables import Map

from engine.canvas import layers
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.selecting.selection import NONE_SAVED, Saved, Selection
from engine.canvas.store import Pyramid
from engine.numeric.address import Rect
from engine.numeric.arithmetic import FINE, LIBRARY
from engine.painting.commands import Same
from engine.painting.guiding.guides import NO_GUIDES, Guides
from engine.painting.layering.touch_command import NO_TOUCHES, Touches
from engine.painting.places import NO_BOOKMARKS, Bookmarks
from engine.painting.recording import DEFAULT_FRAME, Header
from engine.painting.textures import Texture, built_in


class Refusal(ValueError):
    """A command that cannot be done on this painting: `str()` is one line; the painting is as before."""


class Leak(Refusal):
    """A region to be filled that goes on beyond where it is looked for."""


class Unclosed(Refusal):
    """A line goes round no region that is closed."""


class Beginning(NamedTuple):
    """The frame and the paper that a painting had at first, where it has others now."""

    frame: Rect
    paper: str | None


@dataclass(frozen=True, eq=False, slots=True)
class Painting:
    """`frame`: level-0 pixels that export and other programs show; `seed`: of textures without their own;
    `active`: name of the layer that strokes go to; `textures`: those defined by name; `bookmarks`: places by name;
    `arithmetic`: in which its pixels are worked out, that of its recording; `grid`: on which the values of its layers
    lie, by its bits, for as long as it lives; `selection`: what strokes are limited to, None for nothing in particular;
    `selections`: those kept by name; `guides`: what one draws by, by name; `copied`: what was copied last, to be
    pasted, which is in no file; `touches`: what was painted on solids, by their names.

    The textures, the bookmarks and what was copied are beside the steps: they stay as they are when steps are taken
    back, or done again."""

    frame: Rect = DEFAULT_FRAME
    seed: int = 0
    root: Group = layers.EMPTY
    active: str | None = None
    textures: Map[str, Texture] = field(default_factory=Map)
    bookmarks: Bookmarks = field(default_factory=lambda: NO_BOOKMARKS)
    arithmetic: int = LIBRARY
    grid: int = FINE
    selection: Selection | None = None
    selections: Saved = field(default_factory=lambda: NONE_SAVED)
    guides: Guides = field(default_factory=lambda: NO_GUIDES)
    begun: Beginning | None = None
    copied: Layer | None = None
    touches: Touches = NO_TOUCHES

    def beside(self, other: Painting) -> Painting:
        """Returns the painting with what another has beside the steps."""
        return replace(self, textures=other.textures, bookmarks=other.bookmarks, copied=other.copied)

    def framed(self, frame: Rect) -> Painting:
        """Returns the same paint in another frame."""
        return replace(self, frame=frame, begun=self.beginning)

    def on_paper(self, paper: str | None) -> Painting:
        """Returns the same paint on another paper."""
        return replace(self, root=replace(self.root, paper=paper), begun=self.beginning)

    @property
    def beginning(self) -> Beginning:
        """Gives what its recording begins with."""
        return Beginning(self.frame, self.paper) if self.begun is None else self.begun

    @property
    def paper(self) -> str | None:
        """Gives the colour of the ground under all layers; None where there is none."""
        return self.root.paper

    @property
    def known_textures(self) -> Map[str, Texture]:
        """Gives the textures that a brush may name: those defined, and those that need no definition, each in the
        painting's arithmetic."""
        return built_in(self.arithmetic).update(self.textures)


def first_painting(header: Header) -> Painting:
    """Returns the painting that a recording begins with."""
    root = layers.EMPTY if header.paper is None else replace(layers.EMPTY, paper=header.paper)
    return Painting(header.frame, header.seed, root, arithmetic=header.arithmetic, grid=header.grid)


def header_for(painting: Painting) -> Header:
    """Returns the header of the recording of a painting."""
    frame, paper = painting.beginning
    return Header(frame, painting.seed, arithmetic=painting.arithmetic, grid=painting.grid, paper=paper)


def blank(painting: Painting) -> Painting:
    """Returns the painting that its recording begins with."""
    return first_painting(header_for(painting))


def with_node(painting: Painting, node: Node, group: str | Same | None = Same.SAME, to: int | None = None) -> Painting:
    """With a new layer or group: at position `to` of a group (None: the root; SAME: that of the active layer); without
    a position above the active layer if that lies there, else on top.  A new layer becomes the active one."""
    beside = layers.place(painting.root, painting.active) if painting.active is not None else (None, -1)
    where = beside[0] if isinstance(group, Same) else group
    if to is None and painting.active is not None and where == beside[0]:
        to = beside[1] + 1
    root = layers.insert(painting.root, node, where, to)
    return replace(painting, root=root, active=node.name if isinstance(node, Layer) else painting.active)


def new_layer(painting: Painting, name: str) -> Layer:
    """Returns a layer of a painting in which nothing lies yet."""
    return Layer(layers.next_id(painting.root), name, pyramid=Pyramid(grid=painting.grid))


def layer_for(painting: Painting, name: str | None, what: str = "stroke") -> tuple[Painting, Layer]:
    """Returns the layer that a stroke, or `what` else, goes to: the one named, else the active one; a first one is
    made where there is none."""
    wanted = painting.active if name is None else name
    if wanted is None:
        wanted = layers.unique_name(painting.root)
        painting = with_node(painting, new_layer(painting, wanted))
    node = layers.find(painting.root, wanted)
    if not isinstance(node, Layer):
        kind = "a group" if isinstance(node, Group) else "a placement"
        raise Refusal(f"{what}: found {wanted!r}, which is {kind}, expected a layer")
    if layers.is_locked(painting.root, wanted):
        raise Refusal(f"{what}: found layer {wanted!r} locked, expected one that is not")
    return painting, node
