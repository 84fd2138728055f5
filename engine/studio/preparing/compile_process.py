"""A process that compiles kernels, as the program that starts it sees it: `compiling` is what runs in it."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from typing import IO

from engine.studio.preparing.job_queue import Job
from engine.studio.preparing.noted import ROOT

NICENESS = 10
PROGRAM = (
    "-c",
    "import sys; sys.path.insert(0, sys.argv[1]); "
    "from engine.studio.preparing.compiling import main; main(int(sys.argv[2]))",
    str(ROOT),
)
_BELOW_NORMAL, _NO_CONSOLE = 0x00004000, 0x08000000  # how Windows starts a process


class CompileProcess:
    """Starts it: OSError if that fails.  `gently`: the system lets others go first."""

    def __init__(self, program: tuple[str, ...], gently: bool) -> None:
        flags = _NO_CONSOLE | _BELOW_NORMAL * gently if sys.platform == "win32" else 0
        self._process = subprocess.Popen(
            [sys.executable, *program, str(NICENESS if gently else 0)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            encoding="utf-8",
            creationflags=flags,
        )
        self.pid = self._process.pid

    def exercise(self, job: Job, claim: Callable[[str], bool], saved: Callable[[str], None]) -> tuple[str, str]:
        """Has it do a job: the kernel that blocked it, or "", and what went wrong, or "".

        `claim`: asked before it compiles a kernel, whether it may; `saved`: called when that is in the cache.  OSError
        or ValueError if it ends meanwhile.
        """
        assert self._process.stdout is not None
        self._tell(job.line)
        for line in self._process.stdout:
            told = json.loads(line)
            if "missing" in told:
                self._tell(json.dumps({"yours": claim(told["missing"])}))
            elif "saved" in told:
                saved(told["saved"])
            else:
                return told.get("blocked", ""), told.get("fault", "")
        raise OSError(f"process {self.pid} ended in the midst of a job")

    def kill(self) -> None:
        """Ends it now; may be called from any thread."""
        self._process.kill()

    def close(self) -> None:
        """Ends it, and waits until it has gone."""
        self._process.kill()
        for pipe in (self._process.stdin, self._process.stdout):
            _close(pipe)
        self._process.wait()

    def _tell(self, line: str) -> None:
        assert self._process.stdin is not None
        self._process.stdin.write(line + "\n")
        self._process.stdin.flush()


def _close(pipe: IO[str] | None) -> None:
    if pipe is not None:
        with suppress(OSError):
            pipe.close()
