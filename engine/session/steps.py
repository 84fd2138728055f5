"""The steps of a log: which are done and which undone, and on which layer each stroke lies by now.

Layers are followed through renaming, copying and removing; no pixel is painted for it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from immutables import Map

from engine.canvas import layers
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.node_checks import LayerError
from engine.canvas.selecting.selection import EVERYTHING
from engine.canvas.store import Pyramid
from engine.checks.owned import Owned
from engine.painting import commands as c
from engine.painting.value import Painting, Refusal, layer_for
from engine.session.apply import STEPS, apply

Definitions = Map[str, c.DefineTexture]


@dataclass(frozen=True, eq=False, slots=True)
class LoggedStep:
    """`index`: the place of its command in the log, from 0; `number`: how many steps were done with it, from 1;
    `textures`: those defined when it was done; `locked`: whether the alpha of a stroke's layer was."""

    index: int
    number: int
    command: c.Command
    textures: Definitions
    locked: bool = False


@dataclass(frozen=True, eq=False, slots=True)
class Laid:
    """The last stroke on a layer, and those before it."""

    step: LoggedStep
    before: Laid | None


@dataclass(frozen=True, eq=False, slots=True)
class _State:
    """The layers without their paint, the last step that led here, and what was laid on each layer, by its id.

    `active`: the active layer right after that step; the painting has the one that was chosen since.
    """

    painting: Painting
    step: LoggedStep | None
    laid: Map[int, Laid | None]
    active: str | None = None


class Steps(Owned):
    """What a log comes to.  It belongs to the thread that made it, and follows the log as that grows.

    `base`: the painting that the log begins with.
    """

    def __init__(self, base: Painting, log: Sequence[c.Command] = ()) -> None:
        self._now = _State(replace(base, root=_bare(base.root), textures=Map()), None, Map())
        self._done: list[_State] = []  # before each step that is done
        self._undone: list[_State] = []  # after each that is undone
        self._textures: Definitions = Map()
        self._read = 0
        self.follow(log)

    def follow(self, log: Sequence[c.Command]) -> None:
        """Takes in what was added to the log since; a definition that took the place of the last one, too."""
        again = self._read - 1 if self._read and isinstance(log[self._read - 1], c.DefineTexture) else self._read
        for index in range(again, len(log)):
            self._take(index, log[index])
        self._read = len(log)

    @property
    def count(self) -> int:
        """Counts the steps that are done."""
        return len(self._done)

    @property
    def done(self) -> tuple[LoggedStep, ...]:
        """Returns the steps that led to the painting, the first one first."""
        states = [*self._done[1:], self._now] if self._done else []
        return tuple(state.step for state in states if state.step is not None)

    @property
    def undone(self) -> tuple[LoggedStep, ...]:
        """Returns the steps that can be done again, the next one first."""
        return tuple(state.step for state in reversed(self._undone) if state.step is not None)

    def active_at(self, number: int) -> str | None:
        """Returns the active layer that undoing, or doing again, up to the step of a number comes to."""
        by = number - self.count
        if by > 0:
            return self._undone[-by].active
        return (self._done[number] if by < 0 else self._now).painting.active

    @property
    def root(self) -> Group:
        """Gives the layers, without paint."""
        return self._now.painting.root

    def strokes(self, layer: Layer) -> Iterator[LoggedStep]:
        """Yields the strokes and fills on a layer, by its name now, the newest first."""
        laid = self._now.laid.get(layer.id)
        while laid is not None:
            yield laid.step
            laid = laid.before

    def _take(self, index: int, command: c.Command) -> None:
        if isinstance(command, c.DefineTexture):
            self._textures = self._textures.set(command.name, command)
        elif isinstance(command, c.Undo):
            self._travel(command.count, self._done, self._undone, False)
        elif isinstance(command, c.Redo):
            self._travel(command.count, self._undone, self._done, True)
        elif type(command) in STEPS:
            before, number = self._now, 1 + len(self._done)
            self._now = self._after(LoggedStep(index, number, command, self._textures))
            self._done.append(before)
            self._undone.clear()
        else:
            self._now = replace(self._now, painting=_applied(self._now.painting, command))

    def _after(self, step: LoggedStep) -> _State:
        """Returns the state after a step on the present one."""
        now, command = self._now, step.command
        if isinstance(command, c.Stroke | c.Fill):
            return self._after_stroke(step, command)
        if isinstance(command, c.Select):  # what is selected depends on paint, which is not here
            return replace(now, step=step, active=now.painting.active)
        if isinstance(command, c.SetLayer) and command.selected is not None:
            return self._after_part(step, command)
        painting, laid = _applied(now.painting, command), now.laid
        if isinstance(command, c.DuplicateLayer) and painting is not now.painting:
            copied = _applied(now.painting, replace(command, placing=None))  # moved, they have the same numbers
            for one, copy in _copied(copied.root, command):
                laid = laid.set(copy.id, laid.get(one.id))
        if isinstance(
            command, c.RemoveLayer | c.MergeLayer | c.FlattenGroup | c.DuplicateLayer
        ):  # a later layer may get the number of one that is gone
            held = {node.id for node in layers.walk(painting.root)}
            laid = Map({number: last for number, last in laid.items() if number in held})
        return _State(painting, step, laid, painting.active)

    def _after_part(self, step: LoggedStep, command: c.SetLayer) -> _State:
        """Returns the state after what is selected of a layer was moved: on a layer of its own, all that was laid on
        the layer may be."""
        now, chosen = self._now, replace(self._now.painting, selection=EVERYTHING)
        painting, laid = replace(_applied(chosen, command), selection=None), now.laid
        for node in layers.layers(painting.root):
            if not layers.has(now.painting.root, node.name):
                laid = laid.set(node.id, laid.get(layers.find(now.painting.root, command.name).id))
        return _State(painting, step, laid, painting.active)

    def _after_stroke(self, step: LoggedStep, stroke: c.Stroke | c.Fill) -> _State:
        now = self._now
        if stroke.onto:  # no paint: it is nothing that shows
            return replace(now, step=step)
        try:
            painting, layer = layer_for(now.painting, stroke.layer)
        except (Refusal, LayerError):  # the log is of another painting
            return replace(now, step=step)
        step = replace(step, locked=layer.alpha_locked)
        return _State(painting, step, now.laid.set(layer.id, Laid(step, now.laid.get(layer.id))), painting.active)

    def _travel(self, count: int, back: list[_State], forth: list[_State], redone: bool) -> None:
        """As `Session` does it: what is no step stays as it is.  Where the active layer is gone, it is the one before
        the step that is undone, or right after the one that is done again."""
        active = self._now.painting.active
        for _ in range(min(count, len(back))):
            forth.append(self._now)
            self._now = back.pop()
        found = self._now.painting
        first = self._now.active if redone else found.active
        kept = active if active is not None and layers.has(found.root, active) else first
        self._now = replace(self._now, painting=replace(found, active=kept))


def _applied(painting: Painting, command: c.Command) -> Painting:
    """Returns the layers after a command that paints nothing; the same where it does not fit them."""
    try:
        return apply(painting, command)
    except (Refusal, LayerError):
        return painting


def _copied(root: Group, command: c.DuplicateLayer) -> Iterable[tuple[Node, Node]]:
    """Returns the nodes of what was copied, each with its copy."""
    return zip(_within(layers.find(root, command.name)), _within(layers.find(root, command.to)), strict=True)


def _within(node: Node) -> list[Node]:
    return [node, *layers.walk(node)] if isinstance(node, Group) else [node]


def _bare(group: Group) -> Group:
    """Returns the same layers without any paint."""
    return replace(group, children=tuple(_without_paint(child) for child in group.children))


def _without_paint(node: Node) -> Node:
    if isinstance(node, Group):
        return _bare(node)
    return replace(node, pyramid=Pyramid(), growth=()) if isinstance(node, Layer) else node
