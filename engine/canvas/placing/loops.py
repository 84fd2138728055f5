"""Which node shows which: sources are there, and a picture that holds itself shrinks each time round."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

from engine.canvas import layers
from engine.canvas.layers import Group
from engine.canvas.node_checks import LayerError
from engine.canvas.placing.drawable import checked_drawable
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.rounds import by_ids

if TYPE_CHECKING:
    import numpy as np

_ROUND = -1.0  # log2 of the scale by which a loop shrinks at least
_SLACK = 1e-9


class _Way(NamedTuple):
    """From a node to one that is shown in it, 2^log times as large: down into a group, or through a placement."""

    holder: int
    shown: int
    log: float


def placements(root: Group) -> Iterator[Placement]:
    """Yields every placement, bottom first."""
    return (node for node in layers.walk(root) if isinstance(node, Placement))


def showing(root: Group, name: str) -> list[Placement]:
    """Returns the placements outside a node that show it, or something within it."""
    node = layers.find(root, name)
    within = {node.id, *(inner.id for inner in (layers.walk(node) if isinstance(node, Group) else ()))}
    return [one for one in placements(root) if one.of in within and one.id not in within]


def seen_elsewhere(root: Group, name: str) -> bool:
    """Tells whether a placement shows a node, something within it, or a group that holds it."""
    held = {None, root.id, *(group.id for group in layers.ancestors(root, name))}
    return bool(showing(root, name)) or any(one.of in held for one in placements(root))


def holds_itself(one: Placement, shown_in: Callable[[int | None], Iterable[Placement]]) -> bool:
    """Tells whether a placement is shown in what it shows; `shown_in`: the placements in the source of a number."""
    todo, known = [one.of], {one.of}
    while todo:
        inner = list(shown_in(todo.pop()))
        if any(other.id == one.id for other in inner):
            return True
        new = {other.of for other in inner} - known
        todo, known = [*todo, *new], known | new
    return False


def checked(root: Group) -> Group:
    """Returns the tree itself if its placements can be shown; else LayerError, with the loop named."""
    found = list(placements(root))
    if not found:
        return root
    nodes = by_ids(root)
    for one in found:
        if one.of is not None and one.of not in nodes:
            raise LayerError(f"layer {one.name!r}: of: found a node that is not there, expected one that is")
    if checked_drawable(root, nodes):
        _check_loops(root, found)
    return root


def _check_loops(root: Group, found: list[Placement]) -> None:
    """Raises LayerError unless all that shows itself shrinks each time round."""
    through = [_Way(one.id, root.id if one.of is None else one.of, _log(one)) for one in found]
    graph = _Graph([*_into(root), *through])
    for one, way in zip(found, through, strict=True):
        if graph.goes_round(way):
            _check_in_loop(one)
    loop = graph.not_halving([way for way in through if graph.goes_round(way) and way.log > _ROUND])
    if loop:
        names = {root.id: "the painting", **{node.id: repr(node.name) for node in layers.walk(root)}}
        told = " in ".join(names[node] for node in loop)
        raise LayerError(f"layer: found a loop that does not halve each time round ({told}), expected one that does")


def _log(one: Placement) -> float:
    """Returns log2 of a placement's scale, at most -1 exactly where it halves."""
    similarity = one.pose.similarity
    return min(similarity.log_scale, _ROUND) if similarity.halves else max(similarity.log_scale, _ROUND + 2 * _SLACK)


def _check_in_loop(one: Placement) -> None:
    if one.part is None:
        raise LayerError(f"layer {one.name!r}: found no rect in a placement that shows itself, expected one")
    if one.repeat:
        raise LayerError(f"layer {one.name!r}: found repeat in a placement that shows itself, expected none")
    if one.blend != "src-over":
        raise LayerError(f"layer {one.name!r}: found {one.blend!r} in a placement that shows itself, expected src-over")


def _into(node: Group) -> Iterator[_Way]:
    for child in node.children:
        yield _Way(node.id, child.id, 0.0)
        if isinstance(child, Group):
            yield from _into(child)


class _Graph:
    """The ways between nodes, each as long as it shrinks: a loop that halves has a length of 1 at least."""

    def __init__(self, ways: list[_Way]) -> None:
        from scipy.sparse import csr_array  # here: most paintings hold no placement
        from scipy.sparse.csgraph import connected_components

        self._nodes = list(dict.fromkeys(node for way in ways for node in (way.holder, way.shown)))
        self._numbers = {node: number for number, node in enumerate(self._nodes)}
        ends = [self._numbers[way.holder] for way in ways], [self._numbers[way.shown] for way in ways]
        size = len(self._nodes), len(self._nodes)
        self._lengths: Any = csr_array(([-way.log for way in ways], ends), shape=size)
        self._parts: np.ndarray = connected_components(self._lengths, connection="strong")[1]

    def goes_round(self, way: _Way) -> bool:
        """Tells whether a way lies on a loop."""
        part: bool = self._parts[self._numbers[way.holder]] == self._parts[self._numbers[way.shown]]
        return part

    def not_halving(self, ways: list[_Way]) -> list[int]:
        """Returns the nodes of a loop that is shorter than 1, each held by the next; none if there is none.  `ways`:
        those shorter than 1 that lie on loops: one without them halves."""
        from scipy.sparse.csgraph import NegativeCycleError, bellman_ford, breadth_first_order

        for way in ways:
            holder, shown = self._numbers[way.holder], self._numbers[way.shown]
            try:
                lengths, before = bellman_ford(self._lengths, indices=shown, return_predecessors=True)
                short = lengths[holder] - way.log < -_ROUND - _SLACK
            except NegativeCycleError:  # it grows
                before, short = breadth_first_order(self._lengths, shown)[1], True
            if short:
                path = [holder]
                while path[-1] != shown:
                    path.append(int(before[path[-1]]))
                return [self._nodes[number] for number in path]
        return []
