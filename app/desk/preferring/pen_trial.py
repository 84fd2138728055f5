"""What pens tell while the pen tester is open, and what is measured of it; which of them are there."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import NamedTuple

from app.input.events import PenEvent

SECONDS = 4.0  # that are shown
_MEASURED = 1.0  # seconds of motion of which rate and jitter are told
_MOST = 4096  # reports that are kept
_DOTS = 400  # of a trail at most
_PAUSE = 0.1  # seconds without a report that end a motion


class Report(NamedTuple):
    """One report: how hard the pen was `pressed`, and what that was `felt` as."""

    time: float
    x: float
    y: float
    pressed: float
    felt: float
    event: PenEvent


class Measured(NamedTuple):
    """Of the last motion: reports a second, the deviation of the times between them, ms, and that of their places from
    the line through their neighbours, pixels."""

    rate: float
    uneven: float
    jitter: float


@dataclass(slots=True)
class PenTrial:
    """`on`: the tester is open; `driver`, `pens`: how pens are heard, and those that are there."""

    on: bool = False
    driver: str = ""
    pens: tuple[str, ...] | None = None
    reports: deque[Report] = field(default_factory=lambda: deque(maxlen=_MOST))
    buttons: set[int] = field(default_factory=set)

    def take(self, event: PenEvent, felt: PenEvent) -> None:
        """Notes an event as it came, and as it is felt; that of a mouse tells of its buttons alone."""
        if not self.on:
            return
        if event.kind == "down":
            self.buttons.add(event.button)
        elif event.kind in ("up", "lost"):
            self.buttons.discard(event.button)
        if event.pen and event.kind != "wheel":
            self.reports.append(Report(event.time, event.x, event.y, event.pressure, felt.pressure, event))

    def leave(self) -> None:
        """Forgets what was tried."""
        self.on = False
        self.reports.clear()
        self.buttons.clear()

    def heard(self, driver: str, pens: tuple[str, ...]) -> str:
        """Takes over which pens are there; returns a line where one came or went meanwhile."""
        before, self.driver, self.pens = self.pens, driver, pens
        if before is None or before == pens:
            return ""
        came, gone = ([name for name in one if name not in other] for one, other in ((pens, before), (before, pens)))
        return f"Pen found: {', '.join(came)}" if came else f"Pen gone: {', '.join(gone)}" if gone else ""


class TrailDot(NamedTuple):
    """A place of an area, pixels from its corner, and the pressure felt there."""

    x: float
    y: float
    pressure: float


class PenTrail:
    """The last stroke in an area: a dot for every report, however few frames there are."""

    def __init__(self) -> None:
        self.dots: list[TrailDot] = []
        self._heard, self._down = 0.0, False  # the time of the last report that was taken, and whether the pen lay down

    def follow(self, reports: Sequence[Report], area: tuple[float, float, float, float]) -> None:
        """Takes what a pen told since the last call; `area`: its left and upper edge, width and height."""
        for report in [report for report in reports if report.time > self._heard]:
            x, y = report.x - area[0], report.y - area[1]
            lies = report.pressed > 0 and 0 <= x < area[2] and 0 <= y < area[3]
            if lies:
                self.lay(x, y, report.felt, begins=not self._down)
            self._down, self._heard = lies, report.time

    def lay(self, x: float, y: float, pressure: float, *, begins: bool) -> None:
        """Leaves a dot; the first of a stroke takes the place of the stroke before."""
        self.dots = [*([] if begins else self.dots[1 - _DOTS :]), TrailDot(x, y, pressure)]


def motion_measured(reports: Sequence[Report]) -> Measured | None:
    """Returns what is measured of the last motion; None where there are too few reports."""
    last: list[Report] = []
    for report in reversed(reports):
        if last and not (0 <= last[-1].time - report.time < _PAUSE and last[0].time - report.time <= _MEASURED):
            break
        last.append(report)
    if len(last) < 5 or last[0].time <= last[-1].time:
        return None
    steps = [one.time - other.time for one, other in pairwise(last)]
    mean = (last[0].time - last[-1].time) / len(steps)
    uneven = math.sqrt(sum((step - mean) ** 2 for step in steps) / len(steps))
    off = [
        (b.x - (a.x + c.x) / 2) ** 2 + (b.y - (a.y + c.y) / 2) ** 2
        for a, b, c in zip(last, last[1:], last[2:], strict=False)
    ]
    jitter = math.sqrt(sum(off) / len(off) / 3)  # the variance of each axis is 1.5 times that of a place
    return Measured(1 / mean, 1000 * uneven, jitter)
