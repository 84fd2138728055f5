"""A layer's past at a place, unfolded: its strokes and what came between, as they lie, the topmost first."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import fields, replace
from functools import partial
from typing import NamedTuple

from engine.brush.copies import Torus
from engine.canvas.layers import Group, Layer, Node, stacks, walk
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.through import seen_first
from engine.canvas.selecting.placed_mask import mask_here
from engine.canvas.selecting.selection import Selection
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.value import Refusal
from engine.session.here.gazes import Gaze, source_of
from engine.session.here.lineage import Given, Joined, Laid, Left, LoggedStep, Moved, Past
from engine.session.here.plies import BeginPly, CoverPly, EndPly, Ply, ShadePly, Turn, Veil
from engine.session.here.poured_here import Poured
from engine.session.merging import PLAIN_BLEND
from engine.strokes.coverage_at import OnCell, bounds_of, near
from engine.strokes.wrapping import wrapped

_BOUND_AT_ONCE = 512  # strokes
_DEEPEST = 8  # placements that are unfolded, one in another


class Candidate(NamedTuple):
    """A stroke near a place, as it was laid there, and what limits it."""

    step: LoggedStep
    stroke: c.Stroke
    laid: Laid
    ply: Ply

    @property
    def limit(self) -> Selection | None:
        """Gives what was selected."""
        return self.laid.limit


Entry = Candidate | Turn


class Bounds:
    """What each stroke covers at most: learnt once.  `poured` knows that of fills."""

    def __init__(self, poured: Poured) -> None:
        self._known: dict[int, tuple[c.Command, c.Stroke, Rect]] = {}  # by the index of the step
        self._poured = poured

    def of(self, run: Sequence[Laid]) -> Iterator[tuple[Laid, c.Stroke, Rect]]:
        """Yields strokes and fills with their bounds; on a cell, as they lie before they come in again."""
        self._learn([one for one in run if self._missing(one.step)])
        for one in run:
            if isinstance(one.step.command, c.Fill):
                yield one, *self._poured.stroke(one, one.step.command)
            else:
                yield one, *self._known[one.step.index][1:]

    def _missing(self, step: LoggedStep) -> bool:
        known = self._known.get(step.index)
        return isinstance(step.command, c.Stroke) and (known is None or known[0] is not step.command)

    def _learn(self, run: Sequence[Laid]) -> None:
        if run:
            strokes = [_as_laid(one) for one in run]
            for one, stroke, bounds in zip(run, strokes, bounds_of(strokes), strict=True):
                self._known[one.step.index] = one.step.command, stroke, bounds


def _as_laid(one: Laid) -> c.Stroke:
    """Returns a stroke as it was laid, if need be on the cell of a layer that wrapped around."""
    stroke = one.step.command
    assert isinstance(stroke, c.Stroke)
    if one.wrap is None:
        return stroke
    try:
        laid, origin = wrapped(Layer(1, "layer", wrap=one.wrap), stroke.level, stroke.origin, stroke.copies)
    except Refusal:  # the log is of another painting
        return stroke
    members = {f.name: getattr(stroke, f.name) for f in fields(c.Stroke)}
    return OnCell(**{**members, "origin": origin}, torus=laid if isinstance(laid, Torus) else None)


def _coming_in(stroke: OnCell, bounds: Rect, place: Rect) -> c.Stroke | None:
    """Returns a stroke on a cell as it meets a place: shifted, where it comes in once; None where it does not."""
    torus = stroke.torus
    if torus is None:
        return stroke if bounds.meets(place) else None
    x, y = stroke.origin[0] + int(torus.left), stroke.origin[1] + int(torus.top)
    width, height = int(torus.width), int(torus.height)
    if not Rect.at(x, y, width, height).grown(int(torus.spare) + 1).meets(place):
        return None
    across = range(-((bounds.x1 - 1 - place.x0) // width), -((bounds.x0 - place.x1) // width))
    down = range(-((bounds.y1 - 1 - place.y0) // height), -((bounds.y0 - place.y1) // height))
    if len(across) == len(down) == 1:
        origin = stroke.origin[0] + across[0] * width, stroke.origin[1] + down[0] * height
        members = {f.name: getattr(stroke, f.name) for f in fields(c.Stroke)}
        return c.Stroke(**{**members, "origin": origin})
    return stroke if across and down else None


class Unfolding:
    """Lists what a past tells of a place: `entries`; `finer`: by how many levels the parts should be."""

    def __init__(self, bounds: Bounds, gaze: Gaze) -> None:
        self.entries: list[Entry] = []
        self.finer, self.strokes = 0, 0
        self._bounds = bounds
        self.ply = Ply(gaze)

    def unfold(self, past: Past) -> Iterator[None]:
        """Lists all of a past, with a break now and then."""
        self.entries.append(BeginPly(self.ply))
        yield from self._past(past, self.ply, 0)

    def _past(self, past: Past, ply: Ply, depth: int) -> Iterator[None]:
        while past is not None:
            run: list[Laid] = []
            while isinstance(past, Laid) and len(run) < _BOUND_AT_ONCE:
                run.append(past)
                past = past.before
            if run:
                self._near(run, ply)
                yield
            elif isinstance(past, Left):
                self.entries.append(ShadePly(ply, past.part, past.outside))
                past = past.before
            elif isinstance(past, Moved):
                return (yield from self._moved(past, ply, depth))
            elif isinstance(past, Joined):
                return (yield from self._nodes(past.nodes, past, ply, depth))
            elif isinstance(past, Given):
                self.entries.append(CoverPly(ply, past))
                return None
        return None

    def _near(self, run: Sequence[Laid], ply: Ply) -> None:
        there: dict[int, Rect] = {}
        level, rect = ply.gaze.level, ply.gaze.rect
        for one, stroke, around in self._bounds.of(run):
            if stroke.level not in there:
                there[stroke.level] = near(stroke.level, level, rect)
            place = there[stroke.level]
            met = _coming_in(stroke, around, place) if isinstance(stroke, OnCell) else stroke
            if met is not None and (met is not stroke or place.meets(around) or isinstance(met, OnCell)):
                self.entries.append(Candidate(one.step, met, one, ply))
                self.finer = max(self.finer, stroke.level - level)
                self.strokes += 1

    def _within(self, ply: Ply, what: Callable[[], Iterator[None]]) -> Iterator[None]:
        self.entries.append(BeginPly(ply))
        yield from what()
        self.entries.append(EndPly(ply))

    def _moved(self, past: Moved, ply: Ply, depth: int) -> Iterator[None]:
        level, rect = source_of(past.by, ply.gaze.level, ply.gaze.rect)
        if past.by.aligned_from is not None:
            self.finer = max(self.finer, past.by.aligned_from - ply.gaze.level)
        inner = Ply(Gaze.of(level, rect), ply, by=past.by, silent=ply.silent)
        yield from self._within(inner, lambda: self._past(past.before, inner, depth))

    def _nodes(self, nodes: Sequence[Node], tree: Joined, ply: Ply, depth: int) -> Iterator[None]:
        """Lists what some nodes, bottom first, show in a ply."""
        for base, clipped in reversed(stacks(nodes)):
            if not base.visible or not base.opacity:
                continue
            if not clipped:
                yield from self._node(base, base.opacity, tree, ply, depth)
                continue
            stack = Ply(ply.gaze, ply, Veil(base.opacity), covers=base.blend == PLAIN_BLEND, silent=ply.silent)
            yield from self._within(stack, partial(self._stack, base, clipped, tree, stack, depth))

    def _stack(self, base: Node, clipped: Sequence[Node], tree: Joined, ply: Ply, depth: int) -> Iterator[None]:
        """Lists what is clipped to a node, and that."""
        silent = Ply(ply.gaze, ply, silent=True)
        yield from self._within(silent, lambda: self._node(base, 1.0, tree, silent, depth))
        for node in reversed(clipped):
            if node.visible:
                on = Ply(ply.gaze, ply, Veil(within=silent), atop=True, silent=ply.silent)
                on.covers = node.blend == PLAIN_BLEND
                shown = replace(node, clip=False)
                yield from self._within(on, partial(self._node, shown, node.opacity, tree, on, depth))
        yield from self._node(replace(base, blend=PLAIN_BLEND), 1.0, tree, ply, depth)

    def _node(self, node: Node, opacity: float, tree: Joined, ply: Ply, depth: int) -> Iterator[None]:
        """Lists what a node shows."""
        covers = node.blend == PLAIN_BLEND
        if isinstance(node, Placement):
            mask = mask_here(node)
            if mask is None or mask.off:
                yield from self._placed(node, opacity, tree, ply, depth)
                return
            around = Ply(ply.gaze, ply, Veil(opacity, (mask,)), covers=covers, silent=ply.silent)
            shown = replace(node, blend=PLAIN_BLEND)
            yield from self._within(around, lambda: self._placed(shown, 1.0, tree, around, depth))
            return
        veil = Veil(opacity, () if node.mask is None or node.mask.off else (node.mask,))
        inner = Ply(ply.gaze, ply, veil, covers=covers, silent=ply.silent)
        if isinstance(node, Group):
            children = node.children
            yield from self._within(inner, lambda: self._nodes(children, tree, inner, depth))
        else:
            past = tree.pasts.get(node.id)
            yield from self._within(inner, lambda: self._past(past, inner, depth))

    def _placed(self, node: Placement, opacity: float, tree: Joined, ply: Ply, depth: int) -> Iterator[None]:
        """Lists what a placement shows, which is not repeated where it is merged."""
        seen = seen_first(node)
        gaze = Gaze.of(ply.gaze.level, ply.gaze.rect).through(seen)
        if gaze is None or depth == _DEEPEST:
            return
        by = seen.similarity if seen.similarity.quarter is not None else None
        if by is not None:
            level, rect = source_of(by, ply.gaze.level, ply.gaze.rect)
            gaze = Gaze.of(level, rect)
            if by.aligned_from is not None:
                self.finer = max(self.finer, by.aligned_from - ply.gaze.level)
        veil = Veil(opacity, seen=seen if seen.clips else None)
        inner = Ply(gaze, ply, veil, by, by is None, node.blend == PLAIN_BLEND, silent=ply.silent)
        source: Node = tree.root
        if node.of is not None:
            source = next(one for one in walk(tree.root) if one.id == node.of)
        yield from self._within(
            inner, lambda: self._node(replace(source, blend=PLAIN_BLEND), 1.0, tree, inner, depth + 1)
        )
