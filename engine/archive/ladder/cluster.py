"""Ladders written by the workers of a Dask cluster: a task for each block, which owns all of the block's files.

The bytes of the painting are scattered once.  A task may be done twice, or again after its worker died: it writes the
same bytes.  What its workers lost is scattered and asked for anew.
"""

from __future__ import annotations

import logging
import os
import secrets
import signal
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from itertools import chain, islice
from multiprocessing import resource_tracker
from pathlib import PurePath
from typing import TYPE_CHECKING

from engine.archive.export import Picture, lighting_of, shown_root
from engine.archive.ladder.blocks import Source
from engine.archive.ladder.in_place import put_in_place
from engine.archive.ladder.ladder_files import EXTRA, Telling, folder_format, ladder_of
from engine.archive.ladder.on_workers import Order, end_order, version, write_block
from engine.archive.ladder.rungs import Block
from engine.files.fault import FileError, WriteError
from engine.painting.rendering import Progress, Stop, check_cancelled

if TYPE_CHECKING:
    from distributed import Client, Future

LOCAL = "local"
_AHEAD = 4  # tasks of each thread of the cluster that are with its scheduler
_LEAST_AHEAD = 64
_RETRIES = 3  # of a task that raises
_ROUNDS = 5  # times that a block may be lost with its workers
_LOOK = 2.0  # seconds from one look at the cluster to the next
_NAP = 0.01  # seconds between two questions for what is done
_NOBODY = 120.0  # seconds that are waited for a worker
_ANSWER = 30.0  # seconds that are waited for a scheduler


def require(path: str | os.PathLike[str]) -> None:
    """Raises WriteError where the libraries are missing."""
    try:
        import distributed  # noqa: F401
    except ImportError:
        raise WriteError(path, f"export on a cluster needs: {EXTRA}") from None


def write_on_cluster(
    path: str | os.PathLike[str],
    picture: Picture,
    painting: bytes,
    scheduler: str,
    progress: Progress = None,
    cancelled: Stop = None,
) -> None:
    """As `write_folder`, by the workers of the cluster whose scheduler has an address, or is told of in a file of
    Dask's; `LOCAL`: by a process for each core of this machine.

    `painting`: the bytes of a file of the picture's painting.  All workers see the folder of `path`, and run this
    version of the program.
    """
    form = folder_format(path)
    require(path)
    ladder = ladder_of(path, picture, form)
    Source(
        shown_root(picture), ladder, lighting_of(picture)
    ).prepare()  # so that workers of this machine find their kernels compiled
    name = PurePath(path).name
    with connected(path, scheduler) as client, put_in_place(path, form.parts(name), form.replaceable) as folder:
        form.begin(folder / name, ladder)
        ending = PurePath(path).suffix.lower()
        number, target = secrets.token_hex(8), str(folder / name)
        order = Order(number, ladder, picture.layer, target, ending, version(), picture.light, picture.transparent)
        spread = _Spread(client, order, painting, os.fspath(path))
        tell = Telling(ladder, progress)
        try:
            for pixels in spread.written(cancelled):
                tell(pixels)
        finally:
            spread.end()


@contextmanager
def connected(path: str | os.PathLike[str], scheduler: str) -> Iterator[Client]:
    """Hands out the connection to a cluster; WriteError if there is none.  What Dask logs meanwhile is not shown."""
    from distributed import Client, LocalCluster

    told = logging.getLogger("distributed")
    before = told.level
    told.setLevel(logging.CRITICAL + 1)
    try:
        if scheduler == LOCAL:
            with _deaf():
                cluster = LocalCluster(
                    n_workers=os.cpu_count() or 1,
                    threads_per_worker=1,
                    dashboard_address=None,
                    memory_limit=0,
                    silence_logs=logging.CRITICAL + 1,
                )
            with cluster, Client(cluster, timeout=_ANSWER) as client:
                yield client
            return
        where = {"scheduler_file": scheduler} if scheduler.endswith(".json") else {"address": scheduler}
        try:
            found = Client(**where, timeout=_ANSWER)
        except (OSError, ValueError) as error:  # a timeout is an OSError
            raise WriteError(path, f"no Dask scheduler answers at {scheduler!a}: {error}") from None
        with found as client:
            yield client
    finally:
        told.setLevel(before)


@contextmanager
def _deaf() -> Iterator[None]:
    """Within it, Ctrl+C waits; threads and processes that are begun never hear it: this one ends them."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    resource_tracker.ensure_running()  # else it lets the signal through once more
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


class _Spread:
    """The blocks of an order on their way through a cluster."""

    def __init__(self, client: Client, order: Order, painting: bytes, path: str) -> None:
        from distributed import as_completed

        self._client, self._order, self._painting, self._path = client, order, painting, path
        self._blocks: Iterator[Block] = order.ladder.blocks()
        self._again: list[Block] = []  # that were lost
        self._losses: Counter[Block] = Counter()
        self._waiting: dict[Future, Block] = {}
        self._coming = as_completed()
        self._scattered: Future | None = None
        self._threads = 0
        self._met = time.monotonic()  # when a worker was there last
        self._looks = 0.0

    def written(self, cancelled: Stop) -> Iterator[int]:
        """Yields the pixels of each block when it is written; WriteError, Cancelled."""
        try:
            while True:
                check_cancelled(cancelled)
                self._look()
                self._submit()
                if not self._waiting and self._threads:
                    return
                batch = self._coming.next_batch(block=False)
                for future in batch:
                    block = self._waiting.pop(future)
                    if self._whole(future, block):
                        yield block.rect.area
                if not batch:
                    time.sleep(_NAP)
        except (OSError, RuntimeError, ValueError) as error:
            raise WriteError(self._path, f"the cluster failed: {type(error).__name__}: {error}") from error

    def end(self) -> None:
        """Gives up what is not written: afterwards no worker that answers writes any of it."""
        futures = list(self._waiting)
        self._waiting.clear()
        with suppress(Exception):  # the cluster may be gone
            if futures:
                self._client.cancel(futures, force=True)
            self._client.run(end_order, self._order.number, on_error="ignore")

    def _look(self) -> None:
        """Counts the cluster's threads, now and then."""
        now = time.monotonic()
        if now < self._looks:
            return
        self._looks = now + _LOOK
        self._threads = sum(self._client.nthreads().values())
        if self._threads:
            self._met = now
        elif now > self._met + _NOBODY:
            raise WriteError(self._path, f"found no worker in the cluster for {_NOBODY:.0f} s, expected at least one")

    def _submit(self) -> None:
        """Keeps the scheduler supplied, without handing it everything at once."""
        room = max(_LEAST_AHEAD, _AHEAD * self._threads)
        free = room - len(self._waiting)
        if not self._threads or free < room // 4:
            return
        blocks = list(islice(chain(self._again, self._blocks), free))
        del self._again[: len(blocks)]
        if not blocks:
            return
        if self._scattered is None:
            self._scattered = self._client.scatter(self._painting, broadcast=True, hash=False)
        futures = self._client.map(
            write_block, blocks, order=self._order, painting=self._scattered, retries=_RETRIES, pure=False
        )
        self._waiting.update(zip(futures, blocks, strict=True))
        self._coming.update(futures)

    def _whole(self, future: Future, block: Block) -> bool:
        """Tells whether a block was written; what was lost with its workers is asked for again."""
        from distributed import KilledWorker

        if future.status == "finished":
            return True
        error = future.exception() if future.status == "error" else None
        if error is not None and not isinstance(error, KilledWorker):
            raise WriteError(self._path, _words(error))
        self._scattered = None
        self._losses[block] += 1
        if self._losses[block] > _ROUNDS:
            raise WriteError(self._path, f"its workers died {_ROUNDS} times over the same piece, expected them to live")
        self._again.append(block)
        return False


def _words(error: BaseException) -> str:
    """Returns what a worker says, in one line."""
    if isinstance(error, FileError):
        return error.message
    if isinstance(error, ImportError):
        return f"a worker has no Inkfall as it is needed ({error}), expected this version on all of them"
    return f"a worker failed: {type(error).__name__}: {error}"
