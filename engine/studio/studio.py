"""The engine's side of the post: what the window asks for is carried out, and open work done, the most urgent first.

The painting is on the easel; filing, lab, examiner, matcher and grower work at it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from engine.checks.owned import Owned
from engine.numeric.colour import to_premul8
from engine.painting import commands as c
from engine.painting.points import rounded
from engine.studio import requests as q
from engine.studio import results, swatches
from engine.studio.easel import Easel
from engine.studio.examine import Examiner
from engine.studio.filing import Filing
from engine.studio.grower import Grower
from engine.studio.lab import Lab
from engine.studio.matcher import Matcher
from engine.studio.ready import ready
from engine.studio.region import Regions
from engine.studio.warming import Warming
from engine.studio.writers import Post, Send


class Studio(Owned):
    """What the worker works at.  It belongs to the engine's thread.

    `send` and `post` may be called from any thread: `send` takes results to the window, `post` requests to this.
    """

    def __init__(self, send: Send, post: Post) -> None:
        self.easel = easel = Easel(send)
        self.filing, self.lab, self.examiner = Filing(easel, post), Lab(easel), Examiner(easel)
        self.matcher, self.grower, self.regions = Matcher(easel), Grower(easel), Regions(send)
        self._handlers: dict[type, Callable[[Any], None]] = {
            q.Do: lambda r: easel.carry_out(r.command),
            q.Begin: self._begin,
            q.Points: lambda r: easel.extend(rounded(r.points)),
            q.Finish: lambda r: easel.finish(),
            q.Abandon: lambda r: easel.abandon(),
            q.Swatch: self._swatch,
        }
        for part in (easel.viewer, self.filing, self.lab, self.examiner, self.matcher, self.regions, Warming(send)):
            self._handlers |= part.handlers
        send(ready())
        easel.tell()

    def do(self, request: q.Request) -> None:
        """Carries out a request that changes something; sends its results."""
        if self.filing.comes_between(request):
            self._handlers[type(request)](request)

    def look(self, request: q.Look) -> None:
        """Takes over what is wanted on the screen."""
        self.easel.viewer.sight.look(request)

    @property
    def pending(self) -> int:
        """Pieces of open work."""
        parts = (self.easel.viewer, self.regions, self.grower, self.lab, self.examiner, self.matcher)
        return self.easel.behind + sum(part.pending for part in parts)

    def step(self) -> bool:
        """Does the most urgent piece of open work: what the pen just painted, on the canvas or in a region, then the
        lab's pictures, tiles, examples being grown, textures being matched, analysis.  False when there is none."""
        viewer = self.easel.viewer
        if self.easel.behind:
            self.easel.follow()
        elif viewer.fresh:
            viewer.send_fresh()
        elif self.regions.pending:
            self.regions.step()
        elif self.lab.pending:
            self.lab.step()
        elif viewer.pending:
            viewer.send_tile()
        elif self.grower.pending:
            self.grower.step()
            if not self.grower.pending:
                self.filing.grown()
        elif self.matcher.pending:
            self.matcher.step()
        elif self.examiner.pending:
            self.examiner.step()
        else:
            return False
        return True

    @property
    def due(self) -> float | None:
        """When a recording that plays goes on."""
        return self.filing.due

    def play(self) -> None:
        """Plays the next piece of a recording."""
        self.filing.play()

    def close(self) -> None:
        """Waits for files that are being written.  What their threads posted is still to be carried out."""
        self.filing.close()
        self.grower.close()

    def _begin(self, request: q.Begin) -> None:
        self.lab.settle()
        self.easel.begin(c.Stroke(request.level, request.origin, np.empty((0, 6)), request.brush))

    def _swatch(self, request: q.Swatch) -> None:
        pixels = swatches.painted(request, self.easel.session.painting)
        self.easel.send(results.Picture(request.ident, results.frozen(to_premul8(pixels))))
