"""The engine's side of the post: what the window asks for is carried out, and open work done, the most urgent first.

The painting is on the easel; filing, lab, examiner, matcher and grower work at it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, Protocol

import numpy as np

from engine.checks.owned import Owned
from engine.keeping import collecting
from engine.keeping.preferences import Preferences
from engine.numeric.colour import to_premul8
from engine.painting import commands as c
from engine.painting.points import rounded
from engine.painting.times import members, timed
from engine.studio import requests as q
from engine.studio import results
from engine.studio.adjusting.trials import Trials
from engine.studio.atlas.atlas import Atlas
from engine.studio.copying import Copyist
from engine.studio.easel import Easel
from engine.studio.examine import Examiner
from engine.studio.filing.filing import Filing
from engine.studio.filing.writers import Post, Send
from engine.studio.grower import Grower
from engine.studio.held.holding import Holding
from engine.studio.journalled.answers import Answers
from engine.studio.journalled.posts import Posts
from engine.studio.journalled.tend_request import Tend
from engine.studio.land.land_maker import LandMaker
from engine.studio.land.still_picture import StillPictures
from engine.studio.land.wearing import Wearer
from engine.studio.masked.mask_pictures import MaskPictures
from engine.studio.moving.frame_fitting import FrameFitter
from engine.studio.moving.moves import Moves
from engine.studio.moving.sheeting import Sheeting
from engine.studio.past.here import HereFinder
from engine.studio.past.past_list import PastList
from engine.studio.past.trail import Trail
from engine.studio.past.travels import Travels
from engine.studio.ready import ready
from engine.studio.selecting.ants import AntsFinder
from engine.studio.selecting.mask_tint import TintFinder
from engine.studio.stack.layer_pictures import LayerPictures
from engine.studio.textures import swatch_files, swatches
from engine.studio.textures.cut_finder import CutFinder
from engine.studio.textures.lab import Lab
from engine.studio.textures.matcher import Matcher
from engine.studio.textures.region_strokes import Regions
from engine.studio.textures.texture_doctor import TextureDoctor
from engine.studio.warming import Warming
from engine.studio.workshop.workshop import Workshop

_NO_REQUESTS: q.Handlers = {}
_DEFAULT = Preferences()


class Part(Protocol):
    """What works at the painting for a panel, piece by piece."""

    handlers: q.Handlers

    @property
    def pending(self) -> int:
        """Pieces of open work."""
        ...

    def step(self) -> None:
        """Does the next piece."""
        ...


class Work(NamedTuple):
    """One row of open work: how many pieces there are, what does the next one, and the requests that make more."""

    pending: Callable[[], int]
    step: Callable[[], None]
    handlers: q.Handlers = _NO_REQUESTS


def _each(*parts: Part) -> tuple[Work, ...]:
    return tuple(_of(part) for part in parts)


def _of(part: Part) -> Work:
    return Work(lambda: part.pending, part.step, part.handlers)


def _answers(easel: Easel, filing: Filing, posts: Posts) -> Answers:
    made = Answers(easel, posts)
    filing.turned, filing.saves.mark, filing.saves.replaces = made.turn, made.mark, made.replaces
    made.making = filing.saves.making
    return made


class Studio(Owned):
    """What the worker works at.  It belongs to the engine's thread.

    `send` and `post` may be called from any thread: `send` takes results to the window, `post` requests to this.
    `posts`: what was asked for, as the journal knows it; None without a journal.  `holding` tells what memory is held;
    None where nobody wants to know.
    """

    def __init__(self, send: Send, post: Post, posts: Posts | None = None, preferences: Preferences = _DEFAULT) -> None:
        self.easel = easel = Easel(send)
        self.filing, self.lab, self.grower = Filing(easel, post, preferences), Lab(easel), Grower(easel)
        self.holding: Holding | None = None
        self._answers = None if posts is None else _answers(easel, self.filing, posts)
        viewer, travels = easel.viewer, Travels(trail := Trail(easel))
        past = PastList(trail, travels)
        # From the most urgent: first what the pen just painted, on the canvas or in a region.
        self._rows = (
            Work(lambda: easel.behind, easel.follow),
            Work(lambda: viewer.fresh, viewer.send_fresh),
            *_each(AntsFinder(easel), TintFinder(easel)),
            _of(Regions(send)),
            *_each(self.lab, Workshop(easel)),
            *_each(MaskPictures(easel), Trials(easel)),
            *_each(Moves(easel), FrameFitter(easel)),
            Work(lambda: len(viewer.sight.open), viewer.send_tile, viewer.handlers),
            Work(lambda: past.untold, past.tell),
            *_each(LandMaker(easel), Sheeting(easel), travels, HereFinder(trail), LayerPictures(easel)),
            Work(lambda: self.grower.pending, self._grow),
            *_each(Wearer(easel), Matcher(easel), TextureDoctor(easel), Copyist(easel), Examiner(easel), Atlas(easel)),
            _of(past),
            Work(lambda: easel.session.room.pending, lambda: easel.session.room.step()),
            Work(lambda: int(easel.live is None and collecting.due()), collecting.pass_over),
        )
        self._handlers: q.Handlers = {
            q.Do: lambda r: travels.carry_out(timed(r.command, r.time), r.over_symmetry, r.lent, r.together),
            q.Begin: self._begin,
            q.Points: lambda r: easel.extend(rounded(r.points)),
            q.Finish: lambda r: easel.finish(),
            q.Abandon: lambda r: easel.abandon(),
            q.Swatch: self._swatch,
            Tend: lambda r: None,
            **self.filing.handlers,
            **Warming(send).handlers,
            **(StillPictures(easel).handlers | CutFinder(send).handlers),
        }
        for row in self._rows:
            self._handlers |= row.handlers
        send(ready())
        easel.tell()

    def do(self, request: q.Request) -> None:
        """Carries out a request that changes something; sends its results."""
        if self.filing.comes_between(request):
            handle = self._handlers[type(request)]
            if self._answers is None:
                handle(request)
            else:
                self._answers.carry_out(request, handle)
            self._keep_within()

    def look(self, request: q.Look) -> None:
        """Takes over what is wanted on the screen."""
        self.easel.viewer.heights.want(request.heights)
        self.easel.viewer.sight.look(request)
        if request.tiles:
            self.easel.session.cache.look_at(request.tiles[0][0])
            self.easel.session.room.looked()

    @property
    def pending(self) -> int:
        """Pieces of open work."""
        return sum(row.pending() for row in self._rows)

    def step(self) -> bool:
        """Does the most urgent piece of open work; False when there is none."""
        row = next((row for row in self._rows if row.pending()), None)
        if row is not None:
            row.step()
            self._keep_within()
            if self.holding is not None:
                self.holding.tell()
        return row is not None

    def _keep_within(self) -> None:
        """Looks after the memory that it takes."""
        session = self.easel.session
        session.room.keep_within(session.painting.root)

    @property
    def due(self) -> float | None:
        """When a recording that plays goes on, or something is due beside the journal, or open work will be there."""
        times = (self.filing.due, None if self._answers is None else self._answers.due, self.easel.session.room.due)
        return min((time for time in times if time is not None), default=None)

    def play(self) -> None:
        """Plays the next piece of a recording, or looks after the journal, whichever is due first."""
        if self._answers is None:
            if self.filing.due is not None:
                self.filing.play()
            return
        if self.filing.due is not None and self.filing.due == self.due:
            with self._answers.timed():
                self.filing.play()
        self._answers.rest()

    def secure(self) -> None:
        """Has the journal whole, as a fault ends the engine's thread: the painting is had back from it."""
        if self._answers is not None:
            self._answers.secure()

    def close(self) -> None:
        """Waits for files that are being written.  What their threads posted is still to be carried out."""
        self.filing.close()
        self.grower.close()
        if self._answers is not None:
            self._answers.close()

    def _begin(self, request: q.Begin) -> None:
        self.lab.settle()
        no_points, when = np.empty((0, 6)), members(request.time)
        about = request.level, request.origin, no_points, request.brush, request.layer, None, when
        self.easel.begin(c.Stroke(*about, request.copies, request.onto, request.seen))

    def _grow(self) -> None:
        self.grower.step()
        if not self.grower.pending:
            self.filing.grown()

    def _swatch(self, request: q.Swatch) -> None:
        painting = self.easel.session.painting
        pixels = swatch_files.kept(request, painting)
        if pixels is None:
            pixels = to_premul8(swatches.painted(request, painting))
            swatch_files.keep(request, painting, pixels)
        self.easel.send(results.Picture(request.ident, results.frozen(pixels)))
