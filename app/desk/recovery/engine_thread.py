"""The engine’s thread as the window has it: begun, and begun again with the painting as it was when it has stopped."""

from __future__ import annotations

import time
from collections.abc import Callable

from app.desk.desk import Desk, Hear
from app.desk.moving.floating import settling
from engine.studio import results
from engine.studio.requests import Recover, Request, at_time
from engine.studio.results import Note, Result
from engine.studio.worker import Worker

SOON = 60.0  # seconds: what stops again so soon after it was begun is not begun again unasked

Start = Callable[[Worker | None], Worker]  # given the one that has stopped


class EngineThread:
    """All calls come from the window's thread.  `start` begins one; `settle` ends the stroke in hand; `taken` hears
    which one it is from now on."""

    def __init__(
        self, desk: Desk, start: Start, settle: Callable[[], None], taken: Callable[[Worker, bool], None]
    ) -> None:
        self._desk, self._start, self._settle, self._taken = desk, start, settle, taken
        self._began = -SOON
        self.worker = start(None)
        self.hears: dict[type, Hear] = {results.Stopped: self._stopped}
        desk.post, desk.start_engine = settling(desk, self._post), self.begin_again
        desk.behind = lambda: self.worker.behind or desk.moving.floating is not None
        taken(self.worker, False)

    def news(self) -> list[Result]:
        """Returns what came since the last call, in order."""
        return self.worker.results()

    def paint(self) -> list[Result]:
        """Returns what came to be seen of the painting, as far as nothing else came before."""
        return self.worker.results(seen=True)

    @property
    def kept(self) -> bool:
        """Tells whether all that was painted is on disk."""
        return self.worker.journal is None or self.worker.journal.settled

    def _post(self, request: Request) -> None:
        self.worker.post(at_time(request, round(time.time(), 3)))

    def _stopped(self, desk: Desk, _stopped: results.Stopped, now: float) -> None:
        """Begins another one, which has the painting back; only when it is asked to, if that has just been tried."""
        self._settle()
        if now - self._began < SOON or self.worker.entry is None:
            desk.told(_note("The paint engine has stopped again; what you painted is kept", "start_engine"))
            return
        self._began = now
        self.begin_again()
        desk.told(_note("The paint engine stopped, and was started again; the painting is as it was", "save_as"))

    def begin_again(self) -> None:
        """Begins another one, in place of the one that has stopped, and has the painting back."""
        before, folder = self.worker, self.worker.entry
        self.worker = self._start(before)
        self._desk.notices.settle("engine")
        self._desk.learn(ready=False)
        self._taken(self.worker, True)
        if folder is not None:
            self._post(Recover(folder, at_once=True))  # what is painted from now on is painted on it


def _note(text: str, offer: str) -> Note:
    return Note(text, bad=True, stays=True, offers=(offer, "copy_details"), about="engine")
