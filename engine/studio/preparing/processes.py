"""Getting brushes ready: their kernels are compiled by processes of their own, which fill the cache of kernels.

A process that comes to a kernel that another one compiles leaves its job for later and takes the next.  What was
exercised is noted beside the kernels, so that a later start need not.

Light on purpose: importing it loads no numba.  One thread for each process; all others may call.
"""

from __future__ import annotations

import logging
import os
import threading
import time
from collections.abc import Callable, Iterable
from functools import partial

from engine.studio.preparing.compile_process import PROGRAM, CompileProcess
from engine.studio.preparing.job_queue import Job, JobQueue
from engine.studio.preparing.noted import Noted, folder

_LOGGER = logging.getLogger("inkfall")
_MOST = 8  # processes: each takes some 200 MB
REST = 1.0  # seconds after a stroke for which only one process works


class Preparing:
    """Works off jobs, those asked for with `soon` first, in as many processes as there are cores; one while somebody
    paints, unless a job is waited for.

    `count`: how many kernels were saved and jobs done so far: when it changes, what waits may try again.
    """

    def __init__(
        self,
        processes: int | None = None,
        report: Callable[[str], None] = _LOGGER.error,
        program: tuple[str, ...] = PROGRAM,
        gently: bool = True,
    ) -> None:
        self._cores = processes if processes is not None else min(_MOST, cores())
        self._report, self._program, self._gently = report, program, gently
        self._queue = JobQueue()
        self._noted = Noted()
        self._lost: set[Job] = set()  # whose process died
        self._threads: dict[int, threading.Thread] = {}
        self._ending: list[threading.Thread] = []  # that have left, and are about to end
        self._running: set[CompileProcess] = set()
        self._signal = threading.Condition()
        self._painting, self._painted = False, 0.0
        self._closing = False
        self.count = 0

    # --- what is asked for -------------------------------------------------------------------------------------------

    def want(self, jobs: Iterable[Job], soon: bool = False) -> None:
        """Has jobs done that have not been; `soon`: before all others, which are waited for less."""
        with self._signal:
            self._queue.add((job for job in jobs if job not in self._noted and job not in self._lost), soon)
            self._start_threads()
            self._signal.notify_all()

    def ready(self, job: Job) -> bool:
        """Tells whether a job is done, or will not be."""
        with self._signal:
            return job in self._noted or job in self._lost or not self._queue

    def done(self, job: Job) -> bool:
        """Tells whether it is done."""
        with self._signal:
            return job in self._noted

    @property
    def busy(self) -> bool:
        """Tells whether there are jobs that are not done."""
        with self._signal:
            return bool(self._queue)

    def painting(self, painting: bool) -> None:
        """Somebody paints, or has just stopped."""
        with self._signal:
            self._painting, self._painted = painting, time.monotonic()
            self._signal.notify_all()

    def wait(self, timeout: float) -> None:
        """Until something is saved or done, or so many seconds have passed."""
        with self._signal:
            count = self.count
            self._signal.wait_for(lambda: self.count != count or not self._queue, timeout)

    def close(self) -> None:
        """Ends the processes; kernels that are compiled are kept."""
        with self._signal:
            self._closing = True
            self._queue.clear()
            for process in self._running:
                process.kill()
            self._signal.notify_all()
            threads = [*self._threads.values(), *self._ending]
        for thread in threads:
            thread.join()

    # --- the threads -------------------------------------------------------------------------------------------------

    def _start_threads(self) -> None:
        """Starts a thread for each process that there may be and is not."""
        if not os.access(folder(), os.W_OK):
            self._queue.clear()  # nothing can be kept
        for number in range(min(self._cores, len(self._queue)) if self._queue.untaken else 0):
            if number not in self._threads and not self._closing:
                thread = threading.Thread(target=self._work, args=(number,), name="inkfall preparing", daemon=True)
                self._threads[number] = thread
                thread.start()

    def _work(self, number: int) -> None:
        process = job = None
        try:
            process = CompileProcess(self._program, self._gently and number > 0)  # a stroke may wait for the first
            with self._signal:
                self._running.add(process)
            while (job := self._take(number)) is not None:
                blocked, fault = process.exercise(job, partial(self._claim, number), self._saved)
                self._end(job, blocked, fault)
        except (OSError, ValueError) as error:  # it could not be started, or has been killed
            if not self._closing:
                self._report(f"preparing brushes: {error}")
        finally:
            self._leave(number, process, job)

    def _take(self, number: int) -> Job | None:
        """Returns the next job for a process; None when there is none left."""
        with self._signal:
            while self._queue.untaken and not self._closing:
                resting = number > 0 and (self._painting or time.monotonic() - self._painted < REST)
                job = self._queue.take(urgent=resting)
                if job is not None:
                    return job
                self._signal.wait(REST)
            return None

    def _claim(self, number: int, kernel: str) -> bool:
        with self._signal:
            return self._queue.claim(kernel, number)

    def _saved(self, kernel: str) -> None:
        with self._signal:
            self._queue.compiled(kernel)
            self.count += 1
            self._signal.notify_all()

    def _end(self, job: Job, blocked: str, fault: str) -> None:
        if fault:
            self._report(f"preparing brushes: {fault}")
        with self._signal:
            if blocked:
                self._queue.put_back(job, blocked)
            else:
                self._queue.end(job)
                self._noted.add(job)
            self.count += 1
            self._signal.notify_all()

    def _leave(self, number: int, process: CompileProcess | None, job: Job | None) -> None:
        """A process ends, as nothing is left to do, or at a job that is not tried again."""
        if process is not None:
            process.close()
        with self._signal:
            if process is None:  # none can be started
                self._queue.clear()
            else:
                self._running.discard(process)
            if job is not None:
                self._queue.end(job)
                self._lost.add(job)
            self._queue.leave(number)
            self._ending = [thread for thread in self._ending if thread.is_alive()] + [self._threads.pop(number)]
            self._start_threads()
            self.count += 1
            self._signal.notify_all()


def cores() -> int:
    """Returns those that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
