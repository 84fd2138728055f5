"""Which window a file is open in: a lock beside nothing of the user's, which the kernel frees when a process dies.

The lock is on a file of the state folder, not on the painting's: that is another one after each save.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from engine.keeping.state_folder import key_of, state_folder

try:
    import fcntl
except ImportError:  # Windows: no advisory locks, so windows do not know of one another there
    fcntl = None  # type: ignore[assignment]

_FLAGS = os.O_RDWR | os.O_CREAT | getattr(os, "O_CLOEXEC", 0)


class Claim:
    """A file is open here.  Without a `descriptor` nobody else hears of it: the system, or the disk, has no locks."""

    def __init__(self, sidecar: Path | None = None, descriptor: int = -1) -> None:
        self._sidecar, self._descriptor = sidecar, descriptor

    def release(self) -> None:
        """Gives it up."""
        if self._sidecar is not None:
            with suppress(OSError):
                self._sidecar.unlink()  # while it is locked: whoever locks it next looks whether it is still there
            os.close(self._descriptor)
            self._sidecar = None


def claim(target: Path, room: str = "open", wait: bool = False) -> Claim | None:
    """Claims a file, by its real path; None if another window has it.  `room`: what for; `wait`: until it is free."""
    if fcntl is None:
        return Claim()
    try:
        sidecar = state_folder(room) / key_of(target)
        while True:
            descriptor = os.open(sidecar, _FLAGS, 0o600)
            try:
                fcntl.flock(descriptor, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
                if _is_at(descriptor, sidecar):
                    return Claim(sidecar, descriptor)
            except BlockingIOError:
                os.close(descriptor)
                return None
            except OSError:
                os.close(descriptor)
                raise
            os.close(descriptor)  # it was given up, and taken away, in between
    except OSError:
        return Claim()


def _is_at(descriptor: int, path: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(descriptor), os.stat(path))
    except FileNotFoundError:
        return False


@contextmanager
def turn(target: Path) -> Iterator[None]:
    """Waits until no other process is within it for the same file; where there are no locks, goes on at once."""
    held = claim(target, "turns", wait=True)
    try:
        yield
    finally:
        if held is not None:
            held.release()


def forget_unclaimed() -> None:
    """Takes away what windows left behind that were killed."""
    if fcntl is None:
        return
    for sidecar in [path for room in ("open", "turns") for path in state_folder(room).iterdir()]:
        with suppress(OSError):
            descriptor = os.open(sidecar, os.O_RDWR)
            try:
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
                if _is_at(descriptor, sidecar):
                    sidecar.unlink()
            finally:
                os.close(descriptor)
