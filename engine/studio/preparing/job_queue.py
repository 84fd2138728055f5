"""What is to be made ready: jobs, and their order.

A job is a brush that is exercised (`exercise`).  Light on purpose: importing it loads no numba.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

from engine.brush.settings import Brush
from engine.brush.settings import to_json as brush_to_json
from engine.makers import definitions
from engine.studio.requests import Swatch


@dataclass(frozen=True)
class Job:
    """Something to be exercised, as JSON: told to a process."""

    line: str

    @cached_property
    def key(self) -> str:
        """Returns what tells it from others."""
        return hashlib.sha256(self.line.encode()).hexdigest()[:16]


def job_of(swatch: Swatch) -> Job:
    """Returns what compiles all that a swatch's brush needs.  Colours and the pixels' number are not part of it."""
    told = brush_to_json(swatch.brush)
    told.pop("colour", None)
    textures = definitions.to_json(swatch.textures)
    line = {"kind": swatch.kind, "brush": told, "textures": textures, "size": (104, 44)}
    return Job(json.dumps(line, sort_keys=True))


_PLAIN = job_of(Swatch("", Brush(), (104, 44)))
COMMIT, STRUCTURE, LEARNT_DETAIL, SEEN_DETAIL, WRITTEN_TEXTURES, FILES = (
    Job(json.dumps({"kind": kind})) for kind in ("commit", "structure", "learnt", "seen", "written", "files")
)  # detail that is seen is what a painting with learnt detail needs first: a part of what learning needs
PLAIN_PAINT = (_PLAIN, COMMIT)  # what the first strokes of plain paint need
_BEFORE_EXAMPLES = 3  # one in so many brushes comes before the first that grows an example


def expected(swatches: Iterable[Swatch]) -> tuple[Job, ...]:
    """Returns the jobs of brushes, most likely first: those that grow examples last, but for one, whose many kernels
    come one after the other, while a second process has others to compile; what refines pictures, matching, the
    brushes that need these, and files after all others, as they take long, and who saves waits for it where nobody
    sees it."""
    listed = _one_written(swatches)
    late = [swatch for swatch in listed if _is_refined(swatch)]
    grow = [swatch for swatch in listed if swatch.brush.row.grows and swatch not in late]
    others = [swatch for swatch in listed if not swatch.brush.row.grows and swatch not in late]
    at = len(others) // _BEFORE_EXAMPLES
    ordered = (*others[:at], *grow[:1], *others[at:], *grow[1:])
    jobs = (*map(job_of, ordered), WRITTEN_TEXTURES, LEARNT_DETAIL, STRUCTURE, *map(job_of, late), FILES)
    return tuple(dict.fromkeys(jobs))


def _one_written(swatches: Iterable[Swatch]) -> list[Swatch]:
    """Returns swatches with one of those whose only textures are written: all texts run in one machine."""
    out: list[Swatch] = []
    met = False
    for swatch in swatches:
        written = bool(swatch.textures) and all(one.maker == "expression" for one in swatch.textures)
        if not (written and met):
            out.append(swatch)
        met = met or written
    return out


def _is_refined(swatch: Swatch) -> bool:
    """Tells whether a brush has a texture with a structure, or with learnt detail."""
    return any({"structure", "detail"} & set(texture.arguments) for texture in swatch.textures)


class JobQueue:
    """Jobs that are to be done, in order, and the kernels that processes, by their numbers, compile now.

    No two processes compile one kernel: a job that comes to another's waits until that is there.  Whoever calls has
    the lock of all that share it.
    """

    def __init__(self) -> None:
        self.working: dict[str, Job] = {}  # by their keys
        self._jobs: list[Job] = []  # to be done, in order
        self._urgent: set[str] = set()  # keys of those that are waited for
        self._blocked: dict[str, str] = {}  # key of a job: the kernel of another process that it waits for
        self._claimed: dict[str, int] = {}  # kernel: number of the process that compiles it
        self._there: set[str] = set()  # kernels that were compiled, and nobody missed since

    def __len__(self) -> int:
        """Returns those that are not done."""
        return len(self._jobs) + len(self.working)

    @property
    def untaken(self) -> int:
        """Returns those that no process has taken."""
        return len(self._jobs)

    def add(self, jobs: Iterable[Job], soon: bool) -> None:
        """Jobs that are to be done, once each; `soon`: before all others, also where they are in the queue already."""
        told = [job for job in dict.fromkeys(jobs) if job.key not in self.working]
        if soon:
            self._urgent |= {job.key for job in told}
            self._jobs = told + [job for job in self._jobs if job not in told]
        else:
            self._jobs += [job for job in told if job not in self._jobs]

    def take(self, urgent: bool) -> Job | None:
        """Returns the next job that a process may begin now; `urgent`: of those that are waited for."""
        for job in self._jobs:
            if (job.key in self._urgent or not urgent) and self._blocked.get(job.key) not in self._claimed:
                self._jobs.remove(job)
                self.working[job.key] = job
                return job
        return None

    def put_back(self, job: Job, kernel: str) -> None:
        """A job waits for a kernel of another process: after those that are waited for, before those not tried."""
        del self.working[job.key]
        self._blocked[job.key] = kernel
        tried = sum(other.key in self._urgent or other.key in self._blocked for other in self._jobs)
        self._jobs.insert(0 if job.key in self._urgent else tried, job)

    def end(self, job: Job) -> None:
        """A job is done, or will not be."""
        del self.working[job.key]
        self._blocked.pop(job.key, None)

    def clear(self) -> None:
        """No more jobs are begun."""
        self._jobs.clear()

    def claim(self, kernel: str, number: int) -> bool:
        """Tells whether a process may compile a kernel: no other does, nor did while its word that it is missing was
        on the way."""
        if kernel in self._there:
            self._there.remove(kernel)  # who misses it again, which is tried at once, does rightly
            return False
        return self._claimed.setdefault(kernel, number) == number

    def compiled(self, kernel: str) -> None:
        """A kernel is there."""
        self._claimed.pop(kernel, None)
        self._there.add(kernel)

    def leave(self, number: int) -> None:
        """A process has gone, and compiles nothing."""
        self._claimed = {kernel: other for kernel, other in self._claimed.items() if other != number}
