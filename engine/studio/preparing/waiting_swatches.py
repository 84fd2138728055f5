"""The pictures of brushes that wait until their brushes are ready, and how many of these are."""

from __future__ import annotations

from collections.abc import Callable

from engine.kernel_cache import NotCompiled, refusing
from engine.studio import requests as q
from engine.studio import results
from engine.studio.preparing.job_queue import Job, expected, job_of
from engine.studio.preparing.named_textures import job_within
from engine.studio.preparing.processes import Preparing
from engine.studio.studio import Studio


class WaitingSwatches:
    """Has brushes made ready, and their swatches painted then.  All calls come from one thread."""

    def __init__(self, studio: Studio, preparing: Preparing, send: Callable[[results.Result], None]) -> None:
        self._studio, self._preparing, self._send = studio, preparing, send
        self._swatches: dict[str, tuple[q.Swatch, Job]] = {}  # that wait, and what makes their brushes ready
        self._expected: tuple[Job, ...] = ()
        self._told = (0, 0)

    @property
    def open(self) -> bool:
        """Tells whether brushes are to become ready."""
        return bool(self._swatches) or self._told[0] < self._told[1]

    @property
    def pending(self) -> bool:
        """Tells whether a swatch waits whose brush has become ready."""
        return self._next() is not None

    def expect(self, request: q.Prepare) -> None:
        """Brushes are to be made ready."""
        self._preparing.want(expected(request.swatches))
        self._expected = tuple(map(job_of, request.swatches))
        self.tell()

    def tell(self) -> None:
        """Sends how many of the expected brushes are ready, when that has changed."""
        told = sum(map(self._preparing.ready, self._expected)), len(self._expected)
        if told != self._told:
            self._told = told
            self._send(results.Prepared(*told))

    def ask(self, request: q.Swatch) -> None:
        """Paints a swatch, now or when its brush is ready."""
        job = job_within(self._studio.easel.session.painting, request)
        if self._preparing.ready(job):
            self._swatches.pop(request.ident, None)
            self._paint(request)
        else:
            self._swatches[request.ident] = request, job
            self._preparing.want((job,), request.soon)

    def step(self) -> bool:
        """Paints a swatch that has waited; False if there is none whose brush is ready."""
        ident = self._next()
        if ident is not None:
            self._paint(self._swatches.pop(ident)[0])
        return ident is not None

    def _next(self) -> str | None:
        return next((ident for ident, (_, job) in self._swatches.items() if self._preparing.ready(job)), None)

    def _paint(self, request: q.Swatch) -> None:
        try:
            with refusing(self._preparing.busy):
                self._studio.do(request)
        except NotCompiled:
            self._studio.do(request)  # its exercise left something out, and it should be small
