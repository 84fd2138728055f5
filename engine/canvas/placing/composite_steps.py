"""What is composited: the tree of layers as a list of steps, with what placements show, looked up when it is wanted."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from engine.canvas.layers import Alone, Group, Layer, Node, passes_through, stacks
from engine.canvas.merging.paper import Paper
from engine.canvas.placing import unrolled
from engine.canvas.placing.drawn_copies import Copies, Shown
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.portions import Portions
from engine.canvas.placing.rounds import by_ids, composed, rounds
from engine.canvas.placing.self_copies import Tiles
from engine.canvas.placing.shared.extents import Shared
from engine.canvas.placing.through import UNPLACED, Seen, seen_first
from engine.canvas.placing.unpainted import Unpainted
from engine.canvas.reading import Read
from engine.canvas.selecting.layer_mask import Mask
from engine.numeric import blend

_MANY = 32  # placements from which on it is looked for where what they show lies


@dataclass(frozen=True, slots=True)
class CompositeStep:
    """One operation on the picture so far: its source is a layer, the steps of an isolated group, what a placement
    shows, the paper, or a mask.

    `over`: the operator is src-over.  `atop`: the picture so far keeps its alpha.
    """

    row: blend.Blend
    opacity: np.float32
    source: Layer | tuple[CompositeStep, ...] | Placed | Paper | Mask
    over: bool
    atop: bool = False

    @property
    def may_cover(self) -> bool:
        """Tells whether the step hides what lies below wherever it is opaque."""
        return self.over and self.opacity == 1

    @property
    def cuts(self) -> bool:
        """Tells whether all that it leaves of what is below is what lies within its own alpha."""
        return isinstance(self.source, Mask)

    @property
    def shown(self) -> tuple[Placed | None, Mask | None]:
        """Gives what a placement shows, if that is all that the step lays, and its mask, if it has one."""
        if isinstance(self.source, Placed):
            return self.source, None
        if self.over and isinstance(self.source, tuple) and len(self.source) == 2:
            (first, last) = self.source
            if first.may_cover and isinstance(first.source, Placed) and isinstance(last.source, Mask):
                return first.source, last.source
        return None, None


Leaf: TypeAlias = "Layer | Placed | Paper | Mask"
# What a block needs of a step: its pixels, (4, n) read-only, None if empty, or a list to be composited first.
Found = list[tuple[CompositeStep, "np.ndarray | Found | None"]]


class Sources:
    """What placements of a tree show: the steps of each node, as if it were visible, opaque and normal.

    `portions`: where turns are gone on with; None: all are made at once.  `painted`: the id of the layer, or of the
    mask's sheet, that a stroke in progress lies on."""

    def __init__(self, root: Group, portions: Portions | None = None, painted: int | None = None) -> None:
        self.portions, self.painted = portions, painted
        self.unpainted = Unpainted()
        self.sparing: Callable[[Read], Read] = functools.partial(self.unpainted.reading, painted=painted)
        self._root = root.tree if isinstance(root, Alone) and root.tree is not None else root
        self._steps: dict[Shown, tuple[CompositeStep, ...]] = {}
        self._turns: dict[Shown, bool] = {}
        self._loops: dict[Shown, Copies | None] = {}
        self._opened: dict[Shown, tuple[CompositeStep, ...]] = {}
        self._own: dict[Shown, int | None] = {}
        self._tiles: dict[Shown, Tiles[Leaf, Found]] = {}
        self._ends: dict[int, tuple[Placement, Seen]] = {}

    @functools.cached_property
    def _nodes(self) -> dict[int, Node]:
        return by_ids(self._root)

    @functools.cached_property
    def _rounds(self) -> set[int]:
        return rounds(self._root, self._nodes)

    @functools.cached_property
    def shared(self) -> Shared | None:
        """Gives where what placements show lies, and its pictures; None where there are few of them."""
        if sum(isinstance(node, Placement) for node in self._nodes.values()) < _MANY:
            return None
        painted = () if self.painted is None else (self.painted,)
        return Shared(self._root, self._nodes, self.end, frozenset((*self._rounds, *painted)))

    def steps(self, of: Shown) -> tuple[CompositeStep, ...]:
        """Returns what to composite for a node of an id; None: for all of them."""
        held = self._steps.get(of)
        if held is None:
            node = self._root if of is None else self._nodes[of]
            plan = steps(node, self) if isinstance(node, Group) else (self.step(node),)
            held = self._steps[of] = masked(plan, node)
        return held

    def turns(self, of: Shown) -> bool:
        """Tells whether something in a node is turned or scaled so that it has to be sampled."""
        held = self._turns.get(of)
        if held is None:
            self._turns[of] = False  # until it is known: it may hold itself
            held = self._turns[of] = any(map(self._turned, self.steps(of)))
        return held

    def _turned(self, step: CompositeStep) -> bool:
        if isinstance(step.source, Placed):
            placement, _ = self.end(step.source.placement)
            return placement.pose.similarity.quarter is None or self.turns(placement.of)
        if isinstance(step.source, Mask):
            return step.source.moved.similarity.quarter is None
        return isinstance(step.source, tuple) and any(map(self._turned, step.source))

    def loop(self, of: Shown) -> Copies | None:
        """Returns the placements within what shows one another that a node is part of, by the nodes they lie in; None
        if it does not hold itself."""
        if (self._root.id if of is None else of) not in self._rounds:
            return None
        if of not in self._loops:
            ahead = _reached(of, lambda node: [one.placement.of for one in placements_in(self.steps(node))])
            behind: dict[Shown, list[Shown]] = {}
            for node in ahead:
                for one in placements_in(self.steps(node)):
                    behind.setdefault(one.placement.of, []).append(node)
            round_ = [node for node in ahead if node in _reached(of, lambda node: behind.get(node, []))]
            copies = {
                node: tuple(one.placement for one in placements_in(self.steps(node)) if one.placement.of in round_)
                for node in round_
            }
            self._loops[of] = copies or None
        return self._loops[of]

    def opened(self, of: Shown) -> tuple[CompositeStep, ...]:
        """Returns the steps of a node, with those groups dissolved that lie over the rest as they are."""
        if of not in self._opened:
            self._opened[of] = tuple(_opened(self.steps(of)))
        return self._opened[of]

    def own(self, of: Shown) -> int | None:
        """Returns the place, among its opened steps, of the one placement by which a node holds itself; None if there
        is none, or if there are more ways."""
        if of not in self._own:
            loop, at = self.loop(of), []
            if loop is not None and tuple(map(len, loop.values())) == (1,):
                shown = [step.shown[0] for step in self.opened(of)]
                at = [i for i, one in enumerate(shown) if one is not None and one.of == of]
            self._own[of] = at[0] if at else None
        return self._own[of]

    def is_own(self, one: Placement) -> bool:
        """Tells whether a placement is the one way by which a node holds itself."""
        at = self.own(one.of)
        own = None if at is None else self.opened(one.of)[at].shown[0]
        return own is not None and own.placement == one

    def tiles(self, of: Shown, made: Callable[[Copies], Tiles[Leaf, Found]]) -> Tiles[Leaf, Found] | None:
        """Returns the tiles of what a node shows, if it holds itself in several ways; new ones are `made`."""
        loop = self.loop(of)
        if loop is None or self.own(of) is not None:
            return None
        if of not in self._tiles:
            self._tiles.update(dict.fromkeys(loop, made(loop)))
        return self._tiles[of]

    def end(self, placement: Placement) -> tuple[Placement, Seen]:
        """Returns the last of exact placements in one another, from one on, and how that is seen in the first: they are
        one, however many there are."""
        chain = [placement]
        while chain[-1].id not in self._ends:
            inner = None if chain[-1].of is None or chain[-1].of in self._rounds else self._nodes[chain[-1].of]
            if not isinstance(inner, Placement) or not composed(chain[-1], inner):
                self._ends[chain[-1].id] = chain[-1], UNPLACED
                break
            chain.append(inner)
        for outer, inner in reversed(list(itertools.pairwise(chain))):
            last, seen = self._ends[inner.id]
            self._ends[outer.id] = last, seen.through(seen_first(outer))
        return self._ends[placement.id]

    def step(self, node: Layer | Placement) -> CompositeStep:
        """Returns the step that lays a layer, or what a placement shows, over nothing."""
        return CompositeStep(blend.BLENDS["src-over"], np.float32(1), self.source(node), True)

    def source(self, node: Layer | Placement) -> Layer | Placed:
        """Returns what a step of the node has for a source."""
        return node if isinstance(node, Layer) else Placed(node, self)


def _reached(of: Shown, ways: Callable[[Shown], Iterable[Shown]]) -> dict[Shown, None]:
    """Returns the nodes that one comes to from one by at least one way, in their order."""
    found: dict[Shown, None] = {}
    waiting = [of]
    while waiting:
        for node in ways(waiting.pop()):
            if node not in found:
                found[node] = None
                waiting.append(node)
    return found


def placements_in(plan: Sequence[CompositeStep]) -> Iterator[Placed]:
    """Yields what placements show that are composited directly, or in groups."""
    return (one for one in unrolled.leaves(step.source for step in plan) if isinstance(one, Placed))


def _opened(plan: Sequence[CompositeStep]) -> Iterator[CompositeStep]:
    for step in plan:
        inner = step.source
        if isinstance(inner, tuple) and step.may_cover and all(one.over for one in _opened(inner)):
            yield from _opened(inner)
        else:
            yield step


@dataclass(frozen=True, slots=True)
class Placed:
    """What a placement shows: the steps of its source, looked up when they are wanted, as they may hold it."""

    placement: Placement
    sources: Sources

    @property
    def of(self) -> Shown:
        """Gives the node that is shown."""
        return self.placement.of

    @property
    def steps(self) -> tuple[CompositeStep, ...]:
        """Gives what of the source is composited."""
        return self.sources.steps(self.of)


@dataclass(frozen=True, eq=False, slots=True)
class Planned:
    """A root with its steps, for many rectangles that are composited from the same layers: what copies of copies show
    is kept from one to the next."""

    root: Group
    steps: tuple[CompositeStep, ...]

    @classmethod
    def of(
        cls, root: Group, held: Planned | None = None, portions: Portions | None = None, painted: int | None = None
    ) -> Planned:
        """Returns a root planned; what is `held` if that is of the same.  `portions`: in which pictures that contain
        themselves are gone on with, where it is asked for them.  `painted`: the id of the layer that a stroke in
        progress lies on."""
        return held if held is not None and held.root is root else cls(root, steps_of(root, portions, painted))


def steps_of(
    root: Group | Planned, portions: Portions | None = None, painted: int | None = None
) -> tuple[CompositeStep, ...]:
    """Returns the steps of a root, over its paper."""
    if isinstance(root, Planned):
        return root.steps
    plan = steps(root, Sources(root, portions, painted))
    if root.paper is None:
        return plan
    return (CompositeStep(blend.BLENDS["src-over"], np.float32(1), Paper(root.paper), True), *plan)


def steps(root: Group, sources: Sources | None = None) -> tuple[CompositeStep, ...]:
    """Returns what to composite, bottom first: invisible nodes left out, groups that pass through dissolved.

    `sources`: those of the whole tree, where `root` is a group of it."""
    sources = Sources(root) if sources is None else sources
    out: list[CompositeStep] = []
    for node, clipped in stacks(root.children):
        row = blend.BLENDS[node.blend]
        if not node.visible or (node.opacity == 0 and not row.outside):
            continue
        if clipped:
            both = _clipped(node, clipped, sources)
            out.append(CompositeStep(row, np.float32(node.opacity), both, row.name == "src-over"))
            continue
        if isinstance(node, Group) and passes_through(node):
            out.extend(steps(node, sources))
            continue
        source = _source(node, sources)
        if source or row.outside:
            out.append(CompositeStep(row, np.float32(node.opacity), source, row.name == "src-over"))
    return tuple(out)


def masked(plan: tuple[CompositeStep, ...], node: Node) -> tuple[CompositeStep, ...]:
    """Returns the steps of a node's picture with its mask taken off them."""
    mask = Mask.of(node) if plan else None
    return plan if mask is None else (*plan, CompositeStep(blend.BLENDS["dst-in"], np.float32(1), mask, False))


def _source(node: Node, sources: Sources) -> Layer | Placed | tuple[CompositeStep, ...]:
    if isinstance(node, Group):
        return masked(steps(node, sources), node)
    if node.mask is not None:
        return masked((sources.step(node),), node)
    return sources.source(node)


def _clipped(node: Node, clipped: Sequence[Node], sources: Sources) -> tuple[CompositeStep, ...]:
    """Returns a node and what is clipped to it as one picture: that keeps the node's alpha."""
    own = CompositeStep(
        blend.BLENDS["src-over"],
        np.float32(1),
        _source(node, sources),
        True,
    )
    above = steps(Group(node.id, node.name, children=tuple(replace(one, clip=False) for one in clipped)), sources)
    return own, *(replace(step, over=False, atop=True) for step in above)
