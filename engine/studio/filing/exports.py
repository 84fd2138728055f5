"""Pictures of the painting that are written to files, one at a time: each takes a hundred megabytes while it runs."""

from __future__ import annotations

from pathlib import Path

from engine.canvas.layers import Group
from engine.checks.owned import Owned
from engine.keeping.unfinished import unfinished
from engine.painting.value import Painting
from engine.studio import requests as q
from engine.studio import results
from engine.studio.easel import Easel
from engine.studio.filing import documents
from engine.studio.filing.writers import Writers


class Exports(Owned):
    """What is exported, and what waits for it: of each file the newest that was asked for.  It belongs to the engine's
    thread."""

    def __init__(self, easel: Easel, writers: Writers) -> None:
        self._easel, self._writers = easel, writers
        self._waiting: dict[Path, tuple[q.Export, Painting]] = {}
        self._running = False
        easel.aside.append(self._roots)

    def export(self, request: q.Export) -> None:
        """Exports the painting as it is now; painting goes on meanwhile."""
        self._waiting.pop(Path(request.path), None)  # it is older
        self._waiting[Path(request.path)] = request, self._easel.session.painting
        if not self._running:
            self._start()

    def close(self) -> None:
        """Waits until all is exported."""
        while self._waiting:  # what is on its way has ended, but is still to be told
            self._writers.close()
            self._start()
        self._writers.close()

    def _roots(self) -> list[Group]:
        return [painting.root for _, painting in self._waiting.values()]

    def _start(self) -> None:
        request, painting = self._waiting.pop(next(iter(self._waiting)))
        self._running = True

        def write(grown: Painting) -> results.Result:
            with unfinished(request.path):
                documents.write_picture(request, grown)
            return results.Note(f"Wrote {request.path.name}", about="export")

        self._writers.start(write, painting, self._ended)

    def _ended(self, told: results.Result | None) -> None:
        self._running = False
        if told is not None:
            self._easel.send(told)
        if self._waiting:
            self._start()
