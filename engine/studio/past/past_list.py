"""The list of steps as the window shows it, and their small pictures.

A picture is made soon after its step is done, while nothing else waits.  Those of a painting that was opened are made
while its log is played anew, as long as the list is shown.
"""

from __future__ import annotations

import time
from bisect import bisect_left

import numpy as np

from engine.checks.owned import Owned
from engine.session.steps import LoggedStep
from engine.studio import results
from engine.studio.past import past_records as p
from engine.studio.past.rebuilding import Rebuilding
from engine.studio.past.step_pictures import StepPainter, StepPictures
from engine.studio.past.trail import Trail
from engine.studio.past.travels import Travels
from engine.studio.requests import Handlers

_TELL = 0.1  # seconds between two results about a way, at least


class PastList(Owned):
    """Tells of the steps.  It belongs to the engine's thread."""

    def __init__(self, trail: Trail, travels: Travels) -> None:
        self._trail, self._travels, self._easel = trail, travels, trail.easel
        self._shown = p.ShowPast(False)
        self._told: tuple[object, ...] = ()
        self._begin()
        self.handlers: Handlers = {p.ShowPast: self._show}
        self._easel.aside.append(lambda: [] if self._tour is None else [self._tour.session.painting.root])

    def _begin(self) -> None:
        """Another painting is on the easel."""
        self._session = self._easel.session
        self._pictures, self._painter = StepPictures(), StepPainter()
        self._open: list[LoggedStep] = []  # steps without a picture, the newest last
        self._logged = 0  # commands in the log that were looked at
        self._tour: Rebuilding | None = None
        self._broken = False  # whether the log cannot be played

    @property
    def pending(self) -> int:
        """Counts the pieces of open work."""
        touring = self._shown.shown and self._tour is not None
        return int(
            touring or self.untold or bool(self._open) or self._session is not self._easel.session or self._behind
        )

    @property
    def _behind(self) -> bool:
        return self._logged != len(self._session.log)

    def _follow(self) -> None:
        """Takes in what was done since."""
        if self._session is not self._easel.session:
            self._begin()
        self._trail.follow()
        if self._behind:
            self._open += self._trail.since(self._logged)
            self._logged = len(self._session.log)

    @property
    def untold(self) -> bool:
        """Tells whether the window's list is not what it should be."""
        return self._shown.shown and self._state() != self._told

    def step(self) -> None:
        """Does the next piece."""
        self._follow()
        if self.untold:
            self.tell()
        elif self._open:
            self._picture(self._open.pop())
        elif self._tour is not None and self._shown.shown:
            self._go_on(self._tour)

    def _show(self, request: p.ShowPast) -> None:
        self._told = self._told if self._shown.shown and request.shown else ()
        before, self._shown = set(self._shown.pictures), request
        self._follow()
        if not request.shown:
            self._tour = None
            return
        wanted = [step for step in self._trail.steps if step.index in request.pictures]
        for step in wanted:
            if step in self._pictures:
                if step.index not in before:
                    self._send(step)
            elif self._trail.held(step.number) is not None:
                self._open.append(step)
        self._set_out()

    def _set_out(self) -> None:
        """Begins to play anew what leads to pictures that are wanted and not at hand."""
        if self._tour is not None or self._broken:
            return
        lacking = [
            step
            for step in self._trail.steps
            if step.index in self._shown.pictures
            and step not in self._pictures
            and self._trail.held(step.number) is None
        ]
        if lacking:
            self._tour = self._trail.tour(lacking[0], lacking[-1])

    def _picture(self, step: LoggedStep) -> None:
        """Makes the picture of a step that is at hand."""
        steps = self._trail.steps
        there = step.number <= len(steps) and steps[step.number - 1] is step and step not in self._pictures
        painting = self._trail.held(step.number) if there else None
        if painting is not None:
            self._keep(step, self._painter.made(step, painting, self._session.cache))

    def _go_on(self, tour: Rebuilding) -> None:
        """Plays the next command, and makes a picture of its step."""
        at = tour.at
        if tour.done:
            self._tour = None
            self._set_out()
            return
        try:
            tour.play()
        except Exception:
            self._tour, self._broken = None, True
            raise
        steps = self._trail.steps
        place = bisect_left(steps, at, key=lambda step: step.index)
        step = steps[place] if place < len(steps) else None
        if step is not None and step.index == at and step not in self._pictures:
            self._keep(step, self._painter.made(step, tour.session.painting, tour.session.cache))

    def _keep(self, step: LoggedStep, pixels: np.ndarray) -> None:
        self._pictures.keep(step, pixels)
        if self._shown.shown and step.index in self._shown.pictures:
            self._send(step)

    def _send(self, step: LoggedStep) -> None:
        self._easel.send(results.Picture(self._trail.row(step).picture, self._pictures.of(step)))

    def _state(self) -> tuple[object, ...]:
        """Returns what the list depends on; while a way is gone, the time too."""
        session, part = self._easel.session, self._travels.part
        beat = None if part is None else int(time.monotonic() / _TELL)
        return session, len(session.log), session.state, self._travels.looking, beat

    def tell(self) -> None:
        """Sends the list."""
        self._follow()
        self._told = self._state()
        trail, history = self._trail, self._trail.session.history
        rows = tuple(trail.row(step) for step in trail.steps)
        held = trail.count - history.undo_count, trail.count + history.redo_count
        self._easel.send(p.PastScene(rows, trail.count, held, self._travels.looking, self._travels.part))
