"""Programs forked off a process that has loaded what all of them load: a start costs a twentieth of a fresh one's."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import engine  # which sets where kernels are kept

assert engine
ROOT = Path(__file__).parents[2]
_AT_IMPORT = ("NUMBA_", "XDG_CACHE_HOME", "HOME", "INKFALL_CHECK_THREADS", "OMP_", "OPENBLAS_")


class Forked:
    """A program that the server has started, under the hands that `subprocess.Popen` has."""

    def __init__(self, server: Server, pid: int) -> None:
        self._server, self.pid = server, pid
        self.returncode: int | None = None

    def poll(self) -> int | None:
        """The exit status, negative for a signal; None while it runs."""
        with self._server.lock:
            if self.returncode is None:
                self.returncode = self._server.ask(poll=self.pid)
            return self.returncode

    def wait(self, timeout: float) -> int:
        """The exit status, once it has ended.  subprocess.TimeoutExpired if it does not."""
        end = time.monotonic() + timeout
        while (status := self.poll()) is None:
            if time.monotonic() > end:
                raise subprocess.TimeoutExpired("a forked program", timeout)
            time.sleep(0.02)
        return status

    def send_signal(self, number: int) -> None:
        """Signals it, if it still runs."""
        if self.poll() is None:
            os.kill(self.pid, number)

    def terminate(self) -> None:
        """Asks it to end, if it still runs."""
        self.send_signal(15)

    def kill(self) -> None:
        """Ends it at once, if it still runs."""
        self.send_signal(9)


class Server:
    """The process that forks them off; begun when the first is asked for."""

    def __init__(self) -> None:
        self.lock = threading.RLock()
        self._environment = dict(os.environ)
        self._process: subprocess.Popen[str] | None = None

    def start(
        self, module: str, words: tuple[str, ...], folder: Path, log: Path, environment: dict[str, str]
    ) -> Forked:
        """Starts a program as `python -W error::RuntimeWarning -m MODULE WORDS` would."""
        paths = environment["PYTHONPATH"].split(os.pathsep)
        for name in environment.keys() | self._environment.keys():
            if name.startswith(_AT_IMPORT):
                same = environment.get(name) == self._environment.get(name)
                assert same, f"{name} is read by what the server has imported: start this one fresh"
        told = {"words": words, "cwd": str(folder), "log": str(log), "environment": environment, "paths": paths}
        with self.lock:
            return Forked(self, self.ask(start=module, **told))

    def ask(self, **what: Any) -> Any:
        """Asks the server, and waits for its answer."""
        with self.lock:
            if self._process is None:
                self._process = self._begun()
            assert self._process.stdin is not None
            assert self._process.stdout is not None
            self._process.stdin.write(f"{json.dumps(what)}\n")
            self._process.stdin.flush()
            answer = self._process.stdout.readline()
        assert answer, "the server is gone"
        return json.loads(answer)

    def close(self) -> None:
        """Ends the server; what it has started goes on."""
        if self._process is not None:
            self._process.communicate(timeout=90)

    def _begun(self) -> subprocess.Popen[str]:
        environment = {**self._environment, "INKFALL_TRACE": "1", "PYTHONPATH": str(ROOT)}
        environment["OPENBLAS_NUM_THREADS"] = "1"  # it begins its threads when it is loaded
        server = str(Path(__file__).with_name("fork_server.py"))
        command = [sys.executable, "-W", "error::RuntimeWarning", server]
        return subprocess.Popen(command, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
