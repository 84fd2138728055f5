"""The steps of a log: which are done and which undone, and on which layer each stroke lies by now.

Layers are followed through renaming, copying, moving, merging, clearing and removing; no pixel is painted for it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from immutables import Map

from engine.canvas import layers
from engine.canvas.layers import Group, Layer
from engine.canvas.node_checks import LayerError
from engine.canvas.store import Pyramid
from engine.checks.owned import Owned
from engine.painting import commands as c
from engine.painting.value import Painting, Refusal, layer_for
from engine.session.apply import STEPS, apply
from engine.session.here.chosen import ByCommand, Definitions, choosing
from engine.session.here.lineage import (
    Change,
    CopiedPast,
    Given,
    Laid,
    Pasts,
    bare,
    given,
    mask_painted,
    moved_along,
    past_copied,
    pasts_after,
    unpainted,
)
from engine.session.here.lineage import LoggedStep as LoggedStep
from engine.session.picturing import without_pictures
from engine.session.whole_painting import without_paint


@dataclass(frozen=True, eq=False, slots=True)
class _State:
    """The layers without their paint, the last step that led here, and what each layer came to, by its id.

    `active`: the active layer right after that step; the painting has the one that was chosen since.  `copied`: what
    was copied last by then.
    """

    painting: Painting
    step: LoggedStep | None
    pasts: Pasts
    active: str | None = None
    copied: CopiedPast | None = None


class Steps(Owned):
    """What a log comes to.  It belongs to the thread that made it, and follows the log as that grows.

    `base`: the painting that the log begins with.
    """

    def __init__(self, base: Painting, log: Sequence[c.Command] = ()) -> None:
        held = base.copied
        copied, paint = (None, None) if held is None else (CopiedPast(Given(held), 0, None), unpainted(held))
        painting = replace(base, root=bare(base.root), textures=Map(), copied=paint)
        self._now = _State(painting, None, given(base.root), copied=copied)
        self._done: list[_State] = []  # before each step that is done
        self._undone: list[_State] = []  # after each that is undone
        self._textures: Definitions = Map()
        self._read = 0
        self.follow(log)

    def follow(self, log: Sequence[c.Command]) -> None:
        """Takes in what was added to the log since; a definition that took the place of the last one, too."""
        again = self._read - 1 if self._read and isinstance(log[self._read - 1], c.DefineTexture) else self._read
        for index in range(again, len(log)):
            self._take(index, log)
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

    @property
    def painting(self) -> Painting:
        """Gives the painting without paint; what is selected in it, and its masks, are known by their commands."""
        return self._now.painting

    @property
    def pasts(self) -> Pasts:
        """Gives what each layer came to, by its id in `root`."""
        return self._now.pasts

    def _take(self, index: int, log: Sequence[c.Command]) -> None:
        command = log[index]
        if isinstance(command, c.DefineTexture):
            self._textures = self._textures.set(command.name, command)
        elif isinstance(command, c.Undo):
            self._travel(command.count, self._done, self._undone, False)
        elif isinstance(command, c.Redo):
            self._travel(command.count, self._undone, self._done, True)
        elif type(command) in STEPS:
            before, number = self._now, 1 + len(self._done)
            self._now = self._after(LoggedStep(index, number, log, self._textures))
            self._done.append(before)
            self._undone.clear()
        else:
            now, painting = self._now, _applied(self._now.painting, command)
            self._now = replace(now, painting=painting, copied=self._copied(painting, command))

    def _after(self, step: LoggedStep) -> _State:
        """Returns the state after a step on the present one."""
        now, command = self._now, step.command
        if isinstance(command, c.Stroke | c.Fill):
            return self._after_stroke(step, command)
        if isinstance(command, c.Select):  # what is selected depends on paint, which is not here
            painting = choosing(now.painting, command, step.number, step.textures)
        elif isinstance(command, c.AddPicture):  # its picture is not here
            painting = _applied(now.painting, c.AddLayer(command.name, group=command.group, to=command.to))
            painting = _applied(painting, c.SetLayer(command.name, role=command.role))
        elif isinstance(command, c.AddPictures | c.AddPainting):
            painting = _grouped(now.painting, command)
        else:
            painting = _applied(now.painting, command)
        change = Change(now.painting, painting, now.pasts, step)
        if isinstance(command, c.PastePaint):
            change = self._pasted(change, command)
            painting = change.after
        if painting is not now.painting:
            painting = moved_along(change)
        return _State(painting, step, pasts_after(change), painting.active, self._copied(painting, command))

    def _copied(self, after: Painting, command: c.Command) -> CopiedPast | None:
        """Returns what is copied after a command on the present state."""
        now = self._now
        if not isinstance(command, c.CopyPaint | c.CutPaint) or after is now.painting:
            return now.copied
        return CopiedPast(past_copied(now.painting, now.pasts, command.name), len(self._done), now.step)

    def _pasted(self, change: Change, command: c.PastePaint) -> Change:
        """Returns the change with what is pasted: where it was copied from steps that are not done any more, it is
        known by the step that pastes it alone."""
        copied = self._now.copied
        if copied is None or change.after is change.before:
            return change
        states = [*self._done[copied.count : copied.count + 1], self._now]
        if copied.count <= len(self._done) and states[0].step is copied.step:
            return change._replace(pasted=copied.past)
        layer = layers.find(change.after.root, command.name)
        assert isinstance(layer, Layer)
        after = mask_painted(change.after, layer, change.step)
        return change._replace(after=after, pasted=Given(pasted=change.step))

    def _after_stroke(self, step: LoggedStep, stroke: c.Stroke | c.Fill) -> _State:
        now = self._now
        try:
            painting, layer = layer_for(now.painting, stroke.layer)
        except (Refusal, LayerError):  # the log is of another painting
            return replace(now, step=step)
        if stroke.onto:  # no paint: it is nothing that shows
            return replace(now, painting=mask_painted(painting, layer, step), step=step, active=painting.active)
        step = replace(step, locked=layer.alpha_locked)
        chosen = now.painting.selection
        if isinstance(stroke, c.Stroke) and stroke.seen is not None and chosen is not None:
            chosen = ByCommand(Pyramid(), old=chosen, by=stroke.seen.similarity.inverse())
        laid = Laid(step, now.pasts.get(layer.id), chosen, layer.wrap, now.painting.frame)
        return replace(now, painting=painting, step=step, pasts=now.pasts.set(layer.id, laid), active=painting.active)

    def _travel(self, count: int, back: list[_State], forth: list[_State], redone: bool) -> None:
        """As `Session` does it: what is no step stays as it is.  Where the active layer is gone, it is the one before
        the step that is undone, or right after the one that is done again."""
        was, active = self._now, self._now.painting.active
        for _ in range(min(count, len(back))):
            forth.append(self._now)
            self._now = back.pop()
        found = self._now.painting
        first = self._now.active if redone else found.active
        kept = active if active is not None and layers.has(found.root, active) else first
        painting = replace(found, active=kept, copied=was.painting.copied)
        self._now = replace(self._now, painting=painting, copied=was.copied)


def _grouped(painting: Painting, command: c.AddPictures | c.AddPainting) -> Painting:
    try:
        if isinstance(command, c.AddPainting):
            return without_paint(painting, command)
        return without_pictures(painting, command)
    except (Refusal, LayerError):  # the log is of another painting
        return painting


def _applied(painting: Painting, command: c.Command) -> Painting:
    """Returns the layers after a command that paints nothing; the same where it does not fit them."""
    try:
        return apply(painting, command)
    except (Refusal, LayerError):
        return painting
