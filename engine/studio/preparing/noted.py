"""Which jobs are done, noted beside the kernels: a later start of the same program on this processor need not."""

from __future__ import annotations

import hashlib
import json
import os
import platform
from contextlib import suppress
from functools import cached_property
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from engine.studio.preparing.job_queue import Job

NOTE = "ready.json"
ROOT = Path(__file__).resolve().parents[3]


class Noted:
    """The jobs that are done, in a file of the folder of kernels.  It may not be there, or be damaged."""

    def __init__(self) -> None:
        self._keys: set[str] = set()
        with suppress(OSError, ValueError, TypeError, KeyError):
            told = json.loads((folder() / NOTE).read_text("utf-8"))
            if told["for"] == self._stamp:
                self._keys = set(map(str, told["ready"]))

    def __contains__(self, job: Job) -> bool:
        """Tells whether a job is done."""
        return job.key in self._keys

    def add(self, job: Job) -> None:
        """A job is done; the file says so, if it can be written."""
        self._keys.add(job.key)
        text = json.dumps({"for": self._stamp, "ready": sorted(self._keys)})
        path = folder() / NOTE
        beside = path.with_name(f"{NOTE}.{os.getpid()}.tmp")
        with suppress(OSError):
            beside.write_text(text, "utf-8")
            os.replace(beside, path)

    @cached_property
    def _stamp(self) -> str:
        return stamp()


def folder() -> Path:
    """Tells where the kernels are."""
    return Path(os.environ["NUMBA_CACHE_DIR"])


def stamp() -> str:
    """Returns what compiled kernels depend on: Inkfall, and all of its engine, as kernels take constants and functions
    from nearly all of it; numba, Python, processor."""
    from llvmlite import binding

    total = hashlib.sha256()
    for path in sorted((ROOT / "engine").rglob("*.py")):
        total.update(path.read_bytes())
    features = binding.get_host_cpu_features().flatten()
    about = *map(_version, ("inkfall", "numba")), platform.python_version(), binding.get_host_cpu_name(), features
    total.update(repr(about).encode())
    return total.hexdigest()


def _version(package: str) -> str:
    with suppress(PackageNotFoundError):
        return version(package)
    return ""
