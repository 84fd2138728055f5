"""Getting brushes ready: their kernels are compiled by processes of their own, which fill the cache of kernels.

A job is a brush that is exercised (`exercise`).  A process that comes to a kernel that another one compiles leaves its
job for later and takes the next.  What was exercised is noted beside the kernels, so that a later start need not.

Light on purpose: importing it loads no numba.  One thread for each process; all others may call.
"""

from __future__ import annotations

import hashlib
import json
import logging
import os
import platform
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import IO

from engine.brush.settings import Brush
from engine.brush.settings import to_json as brush_to_json
from engine.makers import definitions
from engine.studio.requests import Swatch

LOGGER = logging.getLogger("inkfall")
ROOT = Path(__file__).resolve().parents[3]
MOST = 8  # processes: each takes some 200 MB
REST = 1.0  # seconds after a stroke for which only one process works
NOTE = "ready.json"
NICENESS = 10
_PROGRAM = (
    "-c",
    "import sys; sys.path.insert(0, sys.argv[1])\n"
    "from engine.studio.preparing.compiling import main; main(int(sys.argv[2]))",
    str(ROOT),
)
_BELOW_NORMAL, _NO_CONSOLE = 0x00004000, 0x08000000  # how Windows starts a process


@dataclass(frozen=True)
class Job:
    """Something to be exercised, as JSON: told to a process."""

    line: str

    @cached_property
    def key(self) -> str:
        """What tells it from others."""
        return hashlib.sha256(self.line.encode()).hexdigest()[:16]


def job_of(swatch: Swatch) -> Job:
    """What compiles all that a swatch's brush needs.  Colours and the pixels' number are not part of it."""
    told = brush_to_json(swatch.brush)
    told.pop("colour", None)
    textures = definitions.to_json(swatch.textures)
    line = {"kind": swatch.kind, "brush": told, "textures": textures, "size": (104, 44)}
    return Job(json.dumps(line, sort_keys=True))


PLAIN = job_of(Swatch("", Brush(), (104, 44)))
COMMIT, FILES = (Job(json.dumps({"kind": kind})) for kind in ("commit", "files"))


def expected(swatches: Iterable[Swatch]) -> tuple[Job, ...]:
    """The jobs of brushes, most likely first: those that grow examples last, and files after the first."""
    listed = sorted(swatches, key=lambda swatch: swatch.brush.mode == "example")
    jobs = tuple(dict.fromkeys(map(job_of, listed)))
    return (*jobs[:1], FILES, *jobs[1:])


class Preparing:
    """Works off jobs, those asked for with `soon` first, in as many processes as there are cores; one while somebody
    paints, unless a job is waited for.

    `count`: how many kernels were saved and jobs done so far: when it changes, what waits may try again.
    """

    def __init__(
        self,
        processes: int | None = None,
        report: Callable[[str], None] = LOGGER.error,
        program: tuple[str, ...] = _PROGRAM,
        gently: bool = True,
    ) -> None:
        self._cores = processes if processes is not None else min(MOST, cores())
        self._report, self._program, self._gently = report, program, gently
        self._jobs: list[Job] = []  # to be done, in order
        self._urgent: set[str] = set()  # keys of those that are waited for
        self._blocked: dict[str, str] = {}  # key of a job: the kernel of another process that it waits for
        self._working: dict[str, Job] = {}
        self._claimed: dict[str, int] = {}  # kernel: number of the process that compiles it
        self._threads: dict[int, threading.Thread] = {}
        self._running: set[subprocess.Popen[str]] = set()
        self._signal = threading.Condition()
        self._painting, self._painted = False, 0.0
        self._closing = False
        self.count = 0
        self._ready = self._noted()
        self._lost: set[str] = set()  # keys of jobs whose process died

    # --- what is asked for -------------------------------------------------------------------------------------------

    def begin(self) -> None:
        """Has the first strokes of plain paint made ready."""
        self.want((PLAIN, COMMIT), soon=True)

    def want(self, jobs: Iterable[Job], soon: bool = False) -> None:
        """Has jobs done that have not been; `soon`: before all others, which are waited for less."""
        with self._signal:
            known = {job.key for job in self._jobs} | set(self._working) | self._ready | self._lost
            fresh = [job for job in dict.fromkeys(jobs) if job.key not in known or (soon and job in self._jobs)]
            if soon:
                self._urgent |= {job.key for job in fresh}
                self._jobs = fresh + [job for job in self._jobs if job not in fresh]
            else:
                self._jobs += fresh
            self._start_threads()
            self._signal.notify_all()

    def ready(self, job: Job) -> bool:
        """Whether a job is done, or will not be."""
        with self._signal:
            return job.key in self._ready or job.key in self._lost or not self._busy

    def done(self, job: Job) -> bool:
        """Whether it is done."""
        with self._signal:
            return job.key in self._ready

    @property
    def busy(self) -> bool:
        """Whether there are jobs that are not done."""
        with self._signal:
            return self._busy

    @property
    def _busy(self) -> bool:
        return bool(self._jobs or self._working)

    def painting(self, painting: bool) -> None:
        """Somebody paints, or has just stopped."""
        with self._signal:
            self._painting, self._painted = painting, time.monotonic()
            self._signal.notify_all()

    def wait(self, timeout: float) -> None:
        """Until something is saved or done, or so many seconds have passed."""
        with self._signal:
            count = self.count
            self._signal.wait_for(lambda: self.count != count or not self._busy, timeout)

    def close(self) -> None:
        """Ends the processes; kernels that are compiled are kept."""
        with self._signal:
            self._closing = True
            self._jobs.clear()
            for process in self._running:
                process.kill()
            self._signal.notify_all()
        for thread in list(self._threads.values()):
            thread.join()

    # --- the threads -------------------------------------------------------------------------------------------------

    def _start_threads(self) -> None:
        """A thread for each process that there may be and is not."""
        if not os.access(_folder(), os.W_OK):
            self._jobs.clear()  # nothing can be kept
        for number in range(min(self._cores, len(self._jobs) + len(self._working)) if self._jobs else 0):
            if number not in self._threads and not self._closing:
                thread = threading.Thread(target=self._work, args=(number,), name="inkfall preparing", daemon=True)
                self._threads[number] = thread
                thread.start()

    def _work(self, number: int) -> None:
        process = job = None
        try:
            process = self._started(number)
            while (job := self._take(number)) is not None:
                blocked, fault = self._exercised(process, job, number)
                self._end(job, blocked, fault)
        except (OSError, ValueError) as error:  # it could not be started, or has been killed
            if not self._closing:
                self._report(f"preparing brushes: {error}")
        finally:
            self._leave(number, process, job)

    def _started(self, number: int) -> subprocess.Popen[str]:
        gently = self._gently and number > 0  # a stroke may wait for the first
        flags = _NO_CONSOLE | _BELOW_NORMAL * gently if sys.platform == "win32" else 0
        process = subprocess.Popen(
            [sys.executable, *self._program, str(NICENESS if gently else 0)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            encoding="utf-8",
            creationflags=flags,
        )
        with self._signal:
            self._running.add(process)
        return process

    def _take(self, number: int) -> Job | None:
        """The next job for a process; None when there is none left."""
        with self._signal:
            while not self._closing:
                job = next((job for job in self._jobs if self._may(job, number)), None)
                if job is not None:
                    self._jobs.remove(job)
                    self._working[job.key] = job
                    return job
                if not self._jobs:
                    return None
                self._signal.wait(REST)
            return None

    def _may(self, job: Job, number: int) -> bool:
        """Whether a process may begin a job now."""
        resting = number > 0 and (self._painting or time.monotonic() - self._painted < REST)
        if resting and job.key not in self._urgent:
            return False
        return self._blocked.get(job.key) not in self._claimed

    def _exercised(self, process: subprocess.Popen[str], job: Job, number: int) -> tuple[str, str]:
        """Has a process do a job: the kernel that blocked it, or "", and what went wrong, or ""."""
        _tell(process.stdin, job.line)
        assert process.stdout is not None
        for line in process.stdout:
            told = json.loads(line)
            if "missing" in told:
                _tell(process.stdin, json.dumps({"yours": self._claim(told["missing"], number)}))
            elif "saved" in told:
                self._saved(told["saved"])
            else:
                return told.get("blocked", ""), told.get("fault", "")
        raise OSError(f"process {process.pid} ended in the midst of a job")

    def _claim(self, name: str, number: int) -> bool:
        with self._signal:
            return self._claimed.setdefault(name, number) == number

    def _saved(self, name: str) -> None:
        with self._signal:
            self._claimed.pop(name, None)
            self.count += 1
            self._signal.notify_all()

    def _end(self, job: Job, blocked: str, fault: str) -> None:
        if fault:
            self._report(f"preparing brushes: {fault}")
        with self._signal:
            del self._working[job.key]
            if blocked:
                self._blocked[job.key] = blocked
                self._jobs.insert(0 if job.key in self._urgent else self._place(job), job)
            else:
                self._blocked.pop(job.key, None)
                self._ready.add(job.key)
                self._note()
            self.count += 1
            self._signal.notify_all()

    def _place(self, job: Job) -> int:
        """Where a job that was left waits: after those that are waited for, before those that nobody has tried."""
        return sum(other.key in self._urgent or other.key in self._blocked for other in self._jobs)

    def _leave(self, number: int, process: subprocess.Popen[str] | None, job: Job | None) -> None:
        """A process ends, as nothing is left to do, or at a job that is not tried again."""
        if process is not None:
            process.kill()
            for pipe in (process.stdin, process.stdout):
                if pipe is not None:
                    with suppress(OSError):
                        pipe.close()
            process.wait()
        with self._signal:
            if process is None:  # none can be started
                self._jobs.clear()
            else:
                self._running.discard(process)
            if job is not None:
                self._working.pop(job.key, None)
                self._lost.add(job.key)
            self._claimed = {name: other for name, other in self._claimed.items() if other != number}
            del self._threads[number]
            self.count += 1
            self._start_threads()
            self._signal.notify_all()

    # --- what is noted -----------------------------------------------------------------------------------------------

    def _noted(self) -> set[str]:
        """Keys of the jobs that are done for this program on this processor."""
        with suppress(OSError, ValueError, TypeError, KeyError):
            told = json.loads((_folder() / NOTE).read_text("utf-8"))
            if told["for"] == stamp():
                return set(map(str, told["ready"]))
        return set()

    def _note(self) -> None:
        text = json.dumps({"for": stamp(), "ready": sorted(self._ready)})
        path = _folder() / NOTE
        beside = path.with_name(f"{NOTE}.{os.getpid()}.tmp")
        with suppress(OSError):
            beside.write_text(text, "utf-8")
            os.replace(beside, path)


def cores() -> int:
    """Those that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def stamp() -> str:
    """What compiled kernels depend on: Inkfall and those of its sources that hold kernels, numba, Python, processor."""
    from llvmlite import binding

    total = hashlib.sha256()
    for path in sorted((ROOT / "engine").rglob("*.py")):
        source = path.read_bytes()
        if b"numba" in source:
            total.update(source)
    features = binding.get_host_cpu_features().flatten()
    about = *map(_version, ("inkfall", "numba")), platform.python_version(), binding.get_host_cpu_name(), features
    total.update(repr(about).encode())
    return total.hexdigest()


def _version(package: str) -> str:
    with suppress(PackageNotFoundError):
        return version(package)
    return ""


def _folder() -> Path:
    return Path(os.environ["NUMBA_CACHE_DIR"])


def _tell(pipe: IO[str] | None, line: str) -> None:
    assert pipe is not None
    pipe.write(line + "\n")
    pipe.flush()
