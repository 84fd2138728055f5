"""One object, one thread: what the docstring of a class says is checked while the tests run.

Where the environment sets INKFALL_CHECK_THREADS, each touch of an owned object by another thread than the one that
made it is an AssertionError; elsewhere nothing is checked, and nothing is slower.
"""

from __future__ import annotations

import os
import threading
from typing import Any

CHECKED = bool(os.environ.get("INKFALL_CHECK_THREADS"))


class Owned:
    """The base of classes whose objects belong to the thread that made them: no other reads, calls or changes them."""

    def __new__(cls, *_args: Any, **_named: Any) -> Any:
        self = super().__new__(cls)
        if CHECKED:
            object.__setattr__(self, "_owner", threading.current_thread())
        return self


def _assert_own(owned: Owned, name: str) -> None:
    if name.startswith("__"):
        return
    owner, caller = object.__getattribute__(owned, "_owner"), threading.current_thread()
    assert owner is caller, (
        f"{type(owned).__name__}.{name}: touched by thread {caller.name!r}, it belongs to {owner.name!r}"
    )


def _get(self: Owned, name: str) -> Any:
    _assert_own(self, name)
    return object.__getattribute__(self, name)


def _set(self: Owned, name: str, value: Any) -> None:
    _assert_own(self, name)
    object.__setattr__(self, name, value)


if CHECKED:
    Owned.__getattribute__ = _get  # type: ignore[method-assign, assignment]
    Owned.__setattr__ = _set  # type: ignore[method-assign, assignment]
