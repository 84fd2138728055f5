"""Opening as the window does it: what the thread posts is carried out, and the file that is whole is shown."""

import time

from engine.files.fault import Cancelled
from engine.studio import requests as q
from engine.studio import results
from engine.studio.filing.opening_requests import FileWhole, Show

PATIENCE = 90.0  # seconds


def read(studio, posted):
    """Carries out what the thread of an opening posts, until the file is whole or refused; returns the last of it."""
    end = time.monotonic() + PATIENCE
    while True:
        while not posted:
            assert time.monotonic() < end, "the file is neither opened nor refused"
            time.sleep(0.001)
        request = posted.popleft()
        studio.do(request)
        if isinstance(request, FileWhole):
            return request


def opens(studio, posted, path, live=False, untitled=False):
    """Opens a file in place of the painting, whatever was painted."""
    studio.do(q.Open(path, live, untitled))
    whole = read(studio, posted)
    if whole.fault is None:
        studio.do(Show(whole.file, sure=True))


def opens_in(worker, path):
    """Opens a file in a worker, whose results are drained meanwhile, in place of a painting that is not changed."""
    shows(worker, q.Open(path))


def recovers_in(worker, folder):
    """Opens an entry in a worker, likewise."""
    shows(worker, q.Recover(folder))


def shows(worker, request):
    """Asks a worker for another painting, and shows it when it is whole."""
    worker.post(request)
    end = time.monotonic() + PATIENCE
    while not (found := [result for result in worker.results() if isinstance(result, results.Whole)]):
        assert time.monotonic() < end, "the file is not opened"
        time.sleep(0.001)
    worker.post(Show(found[0].file))


class Watch:
    """Hears how far an opening is; wants it no more after some words."""

    def __init__(self, most=10**9):
        self.parts, self._most = [], most

    @property
    def cancelled(self):
        return len(self.parts) >= self._most

    def tell(self, part):
        self.parts.append(part)
        if self.cancelled:
            raise Cancelled
