"""What is painted with examples, refined while nothing more urgent waits, step by step, from coarse to fine."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import replace

from engine.canvas.growth import Growth, is_settled, progress, settling
from engine.canvas.layers import Group, Layer
from engine.checks.owned import Owned
from engine.painting.difference import areas
from engine.painting.grown import MOST_THREADS, waiting, with_grown
from engine.strokes.bed import Bed
from engine.studio import results
from engine.studio.easel import Easel

TELL = 0.1  # seconds between two results about the progress, at least
SHARE = 40  # times as long as finding it out takes


class Grower(Owned):
    """It belongs to the engine's thread; the threads of its pool are given values alone.

    The stroke in progress comes first, then the active layer.  The layer under a stroke in progress stays as it is
    until the stroke ends; only what the stroke grows is refined.  `held`: its kernels are not there, so nothing is.
    """

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._steps: Iterator[Growth] | None = None
        self._at: Growth = ()  # what the steps have come to
        self._known: tuple[Group | None, list[Layer]] = None, []
        self._told: float | None = None  # when the window hears of it again; None: it knows that nothing grows
        self._pool: Executor | None = None
        self._failed: Growth | None = None  # what could not be refined: it would fail again
        self.held = False

    @property
    def pending(self) -> bool:
        """Tells whether something is left to grow, or to tell, that is not held."""
        return not self.held and (self._told is not None or self._open)

    @property
    def _open(self) -> bool:
        """Tells whether anything is to be refined."""
        return self._bed() is not None or bool(self._waiting())

    def step(self) -> None:
        """Does a piece of the refinement, some milliseconds; now and then how far that is."""
        if self._told is not None and time.monotonic() > self._told:
            self._tell()
            return
        bed, layers = self._bed(), self._waiting()
        old = bed.growth if bed is not None else layers[0].growth if layers else None
        if old is not None:
            try:
                grown = self._advance(old)
            except Exception:
                self._failed = old
                raise
            if grown is not old and bed is not None:
                self._easel.refined(grown)
            elif grown is not old:
                self._amend(layers[0], grown)
        if self._told is None or not self._open:
            self._tell()

    def close(self) -> None:
        """Ends the threads, whatever they are at."""
        self._steps = None  # ends what threads are at
        if self._pool is not None:
            self._pool.shutdown(cancel_futures=True)

    def _bed(self) -> Bed | None:
        """Returns what the stroke in progress grows, if that is not done."""
        bed = None if self._easel.live is None else self._easel.live.bed
        return None if bed is None or bed.growth is self._failed or is_settled(bed.growth) else bed

    def _waiting(self) -> list[Layer]:
        """Returns the layers of the painting that are to be refined, the active one first."""
        painting, live = self._easel.session.painting, self._easel.live
        if self._known[0] is not painting.root:
            self._known = painting.root, waiting(painting.root)
        held = None if live is None else live.layer.id
        found = [layer for layer in self._known[1] if layer.id != held and layer.growth is not self._failed]
        return sorted(found, key=lambda layer: layer.name != painting.active)

    def _advance(self, growth: Growth) -> Growth:
        """Returns the growth after the next step; what was begun with another one is dropped."""
        if self._steps is None or self._at is not growth:
            self._steps = settling(growth, self._easel.viewer.sight.near, self._threads())
        self._at = next(self._steps, growth)
        if is_settled(self._at):
            self._steps = None
        return self._at

    def _threads(self) -> Executor | None:
        """One core is left to the window, of two as well: with both taken its loop woke 8 ms late now and then."""
        count = min((os.cpu_count() or 1) - 1, MOST_THREADS)
        if self._pool is None and count > 1:
            self._pool = ThreadPoolExecutor(count, "inkfall examples")
        return self._pool

    def _amend(self, layer: Layer, grown: Growth) -> None:
        """Takes the painting with a layer further refined, also under the stroke in progress."""
        session, live = self._easel.session, self._easel.live
        before = session.painting
        after = replace(before, root=with_grown(before.root, layer.name, layer.growth, grown))
        session.amend(after)
        if live is not None:
            live.rebase(after, with_grown(live.base.root, layer.name, layer.growth, grown))
        self._easel.viewer.changed(areas(before, after))

    def _tell(self) -> None:
        """Tells how far all of it is, or that it is done."""
        now = time.monotonic()
        bed = self._bed()
        growths = [layer.growth for layer in self._waiting()] + ([] if bed is None else [bed.growth])
        if growths:
            rects, done = progress(tuple(plot for growth in growths for plot in growth))
            self._easel.send(results.Growing(done, tuple(rects)))
            took = time.monotonic() - now
            self._told = now + max(TELL, SHARE * took)
        elif self._told is not None:
            self._told = None
            self._easel.send(results.Growing(1.0))
