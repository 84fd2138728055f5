"""What the background worker works at: a session, the stroke in progress, and all that the window asks about them.

What is seen of it is the viewer's, its files are filing's; lab, examiner and matcher have work of their own.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.colour import to_premul8
from engine.painting import commands as c
from engine.painting.difference import areas
from engine.painting.points import rounded
from engine.session.session import Session
from engine.strokes.example_stroke import Live
from engine.studio import requests as q
from engine.studio import results, swatches
from engine.studio.examine import Examiner
from engine.studio.filing import Filing
from engine.studio.grower import Grower
from engine.studio.lab import Lab
from engine.studio.matcher import Matcher
from engine.studio.outline import rows
from engine.studio.ready import ready
from engine.studio.viewer import Viewer
from engine.studio.warming import Warming


class Easel:
    """The engine's side of the post.  All calls come from one thread."""

    def __init__(self, send: Callable[[results.Result], None]) -> None:
        self.send = send
        self.session = Session()
        self.live: Live | None = None
        self._telling = threading.Lock()
        self.viewer, self.filing = Viewer(self), Filing(self)
        self.lab, self.examiner, self.matcher, self.grower = Lab(self), Examiner(self), Matcher(self), Grower(self)
        self._handlers: dict[type, Callable[[Any], None]] = {
            q.Do: lambda r: self.carry_out(r.command),
            q.Begin: self._begin,
            q.Points: lambda r: self.extend(rounded(r.points)),
            q.Finish: lambda r: self.finish(),
            q.Abandon: lambda r: self._abandon(),
            q.Swatch: self._swatch,
        }
        for part in (self.viewer, self.filing, self.lab, self.examiner, self.matcher, Warming(send)):
            self._handlers |= part.handlers
        send(ready())
        self.tell()

    # --- the worker's side -------------------------------------------------------------------------------------------

    def do(self, request: q.Request) -> None:
        """Carries out a request that changes something; sends its results."""
        if self.filing.comes_between(request):
            self._handlers[type(request)](request)

    def look(self, request: q.Look) -> None:
        """Takes over what is wanted on the screen."""
        self.viewer.sight.look(request)

    @property
    def revision(self) -> int:
        """How often the picture has changed."""
        return self.viewer.sight.revision

    @property
    def pending(self) -> int:
        parts = (self.viewer, self.grower, self.lab, self.examiner, self.matcher)
        return self.grower.behind + sum(part.pending for part in parts)

    def step(self) -> bool:
        """The most urgent piece of open work: what the pen just painted, then the lab's pictures, tiles, examples being
        grown, textures being matched, analysis."""
        if self.grower.behind:
            self.grower.follow()
        elif self.viewer.fresh:
            self.viewer.send_fresh()
        elif self.lab.pending:
            self.lab.step()
        elif self.viewer.pending:
            self.viewer.send_tile()
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
        """The next piece of a recording that plays."""
        self.filing.play()

    def close(self) -> None:
        """Waits for files that are being written."""
        self.filing.close()
        self.grower.close()

    # --- the painting ------------------------------------------------------------------------------------------------

    def show(self, session: Session, path: Path | None) -> None:
        """Another painting is on the easel."""
        self.live, self.session = None, session
        self.filing.shown(session, path)
        self.viewer.forget()
        self.tell()
        self.viewer.changed(lambda level: None)

    def carry_out(self, command: c.Command) -> None:
        """A command; what it changed on the screen is brought up to date."""
        if self.live is not None:
            self.finish()
        before = self.session.painting
        after = self.session.do(command)
        if after is not before:
            self.viewer.changed(areas(before, after))
        self.tell()

    def _begin(self, request: q.Begin) -> None:
        self.lab.settle()
        self.begin(c.Stroke(request.level, request.origin, np.empty((0, 6)), request.brush))

    def begin(self, stroke: c.Stroke) -> None:
        """The pen touches down; the stroke's points come later."""
        if self.live is not None:
            self.finish()
        self.live = self.session.begin(stroke.level, stroke.origin, stroke.brush, stroke.layer, stroke.seed)
        self.live.extra = stroke.extra

    def extend(self, points: np.ndarray) -> None:
        """More of the stroke.  Only the paint is laid; pictures of it follow when no more points wait."""
        if self.live is None:  # its beginning was refused
            return
        rect = self.live.add(points)
        if not rect.empty:
            self.viewer.grew(self.live.level, rect)
        if self.live.full:
            stroke = self.live.to_command()
            self.finish()
            self.begin(replace(stroke, points=points[:0]))

    def finish(self) -> None:
        """The pen lifts."""
        if self.grower.behind:
            self.grower.follow()
        live, self.live = self.live, None
        if live is None:
            return
        try:
            after = self.session.finish(live)
        except Exception:
            self.viewer.unsee(live)  # its preview is on the screen, and will not be paint
            raise
        if live.predictor is not None:
            self.send(results.Note(f"Continued by a filter of reach {live.predictor.reach}: {live.predictor.verdict}"))
        if live.flattened:
            self.viewer.changed(areas(live.before, after))
            self.tell()
            return
        other = areas(live.base, after)
        # At the stroke's own level the preview is what was committed: nothing changes.
        self.viewer.changed(lambda level: [] if level == live.level else other(level))
        self.tell()

    def _abandon(self) -> None:
        live, self.live = self.live, None
        if live is not None:
            self.viewer.unsee(live)

    def picture(self, level: int, whole: Rect) -> np.ndarray:
        """What is to be seen of a rectangle: float32 (4, h, w), premultiplied; with the stroke in progress."""
        return self.viewer.picture(level, whole)

    def _swatch(self, request: q.Swatch) -> None:
        pixels = swatches.painted(request, self.session.painting)
        self.send(results.Picture(request.ident, results.frozen(to_premul8(pixels))))

    def tell(self) -> None:
        """Sends what the panels show.  Files that were written tell as well, from their own threads: in turn, so that
        the last one sent is the newest."""
        with self._telling:
            self.send(self._scene())

    def _scene(self) -> results.Scene:
        painting = self.session.painting
        return results.Scene(
            frame=painting.frame,
            layers=tuple(rows(painting.root)),
            active=painting.active,
            can_undo=self.session.can_undo,
            can_redo=self.session.can_redo,
            modified=self.filing.modified,
            path=self.filing.path,
            textures=tuple(sorted(painting.textures)),
            texture_kinds=tuple((name, texture.kind) for name, texture in painting.textures.items()),
            definitions=tuple((name, texture.kind, texture.parameters) for name, texture in painting.textures.items()),
            texture_widths=tuple((name, t.source.width) for name, t in painting.textures.items() if t.source),
            serial=self.filing.serial,
        )
