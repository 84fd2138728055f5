"""Looking back at a step, and jumping to it.

What the history holds is there at once; other states are played anew, piece by piece.  Looking changes nothing; a jump
is recorded as the steps that it undoes, or does again.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace

from engine.canvas import layers
from engine.canvas.layers import Group
from engine.checks.owned import Owned
from engine.painting import commands as c
from engine.painting.difference import areas
from engine.painting.value import Painting
from engine.studio.past import past_records as p
from engine.studio.past.joined_steps import JoinedSteps
from engine.studio.past.layer_steps import layer_after
from engine.studio.past.rebuilding import PLAYED_AT_ONCE, Rebuilding
from engine.studio.past.symmetry_steps import steps_over_symmetry
from engine.studio.past.trail import Trail
from engine.studio.requests import Handlers
from engine.texture.image import ImageSource


@dataclass(frozen=True, slots=True, eq=False)
class _Way:
    """On the way to the step of a number, to look at it or to be there; `logged`: commands in the log as it begins."""

    number: int
    jumps: bool
    rebuilding: Rebuilding
    logged: int


class Travels(Owned):
    """Goes to steps.  It belongs to the engine's thread."""

    def __init__(self, trail: Trail) -> None:
        self._trail, self._easel = trail, trail.easel
        self._joined = JoinedSteps()
        self._way: _Way | None = None
        self._seen: int | None = None
        self.handlers: Handlers = {
            p.LookBack: self._look_back,
            p.Jump: lambda r: self._jump(r.number),
            p.StopJump: lambda r: self._stop(),
        }
        self._easel.aside.append(self._seen_roots)

    @property
    def looking(self) -> int | None:
        """Returns the number of the step that is seen instead of the painting."""
        return None if self._easel.viewer.looking is None else self._seen

    @property
    def part(self) -> float | None:
        """Tells how far the way to a step is, 0..1; None where none is gone."""
        return None if self._way is None else self._way.rebuilding.part

    @property
    def pending(self) -> int:
        """Counts the pieces of open work."""
        return int(self._way is not None)

    def carry_out(
        self, command: c.Command, over_symmetry: bool = False, lent: ImageSource | None = None, together: int = 0
    ) -> None:
        """Does a command, as the easel does; undo and redo beyond what the history holds are a jump.  `over_symmetry`:
        by hand, for which they do not count steps that only set the symmetry, and the layer that a step chose, or left,
        is chosen again.  `together`: see `Do`."""
        session = self._easel.session
        if over_symmetry and isinstance(command, c.Undo | c.Redo):
            if self._easel.live is not None:
                self._easel.finish()
            back = isinstance(command, c.Undo)
            count = self._joined.reach(session, back, steps_over_symmetry(session, back))
            command = replace(command, count=count)
        if isinstance(command, c.Undo | c.Redo) and session.leapt and self._easel.live is None:
            self._trail.follow()
            by = -command.count if isinstance(command, c.Undo) else command.count
            to = min(max(self._trail.count + by, 0), len(self._trail.steps))
            if to != self._trail.count and self._trail.held(to) is None:
                self._jump(to)
                return
        chosen = layer_after(session, command) if over_symmetry and isinstance(command, c.Undo | c.Redo) else None
        logged = len(session.log)
        self._easel.carry_out(command, lent)
        if together and self._easel.session is session:
            self._joined.note(session, logged, together)
        painting = session.painting
        if chosen is not None and chosen != painting.active and layers.has(painting.root, chosen):
            self._easel.carry_out(c.SelectLayer(chosen))

    def step(self) -> None:
        """Plays a piece of the way."""
        way, session = self._way, self._easel.session
        assert way is not None
        if self._trail.session is not session or way.logged != len(session.log) or self._easel.live is not None:
            self._stop()  # painting went on
            return
        end = time.monotonic() + PLAYED_AT_ONCE
        try:
            while not way.rebuilding.done and time.monotonic() < end:
                way.rebuilding.play()
        except Exception:
            self._stop()
            raise
        if way.rebuilding.done:
            self._arrive(way)

    def _seen_roots(self) -> list[Group]:
        """Returns the layers of a state that is seen, and of one on the way."""
        way = None if self._way is None else self._way.rebuilding.session.painting
        return [painting.root for painting in (way, self._easel.viewer.looking) if painting is not None]

    def _look_back(self, request: p.LookBack) -> None:
        self._trail.follow()
        if request.number is None or request.number == self._trail.count:
            self._stop()
            self._see(None, None)
        elif 0 <= request.number <= len(self._trail.steps):
            self._go(request.number, False)

    def _jump(self, number: int) -> None:
        if self._easel.live is not None:
            self._easel.finish()
        self._trail.follow()
        if 0 <= number <= len(self._trail.steps):
            self._go(number, True)

    def _stop(self) -> None:
        self._way = None

    def _go(self, number: int, jumps: bool) -> None:
        """At once if the step is at hand."""
        self._stop()
        by, held = number - self._trail.count, self._trail.held(number)
        if held is None:
            self._way = _Way(number, jumps, self._trail.rebuilding(number), len(self._trail.session.log))
        elif not jumps:
            self._see(number, held)
        elif by:
            self._easel.carry_out(c.Undo(-by) if by < 0 else c.Redo(by))
        else:
            self._see(None, None)

    def _arrive(self, way: _Way) -> None:
        self._stop()
        found, session = way.rebuilding.session, self._trail.session
        if not way.jumps:
            self._see(way.number, found.painting)
            return
        self._see(None, None)
        before = session.painting
        after = session.leap(way.number, found.painting, found.history)
        self._easel.viewer.changed(areas(before, after))
        self._easel.tell()

    def _see(self, number: int | None, painting: Painting | None) -> None:
        self._seen = number
        self._easel.viewer.look_back(painting)
