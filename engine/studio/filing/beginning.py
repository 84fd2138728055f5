"""What is done about files before the first painting: preferences are read, what killed processes left is removed."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable

from engine.journal.entries import tidy
from engine.keeping import memory
from engine.keeping.claim import forget_unclaimed
from engine.keeping.preferences import Preferences, preferences_file, read_preferences
from engine.keeping.unfinished import sweep_unfinished
from engine.studio.filing.bounds import bound_kept
from engine.studio.results import Note, Result

_LOGGER = logging.getLogger("inkfall")


def begun(send: Callable[[Result], None]) -> Preferences:
    """Returns the preferences, and tells what is wrong with them or with the budget of memory; sweeps on its own
    thread, which nothing waits for: the files may lie in folders that take long to answer."""
    preferences, faults = read_preferences(preferences_file())
    threading.Thread(target=_sweep, args=(preferences,), name="inkfall sweep", daemon=True).start()
    wrong = memory.fault()
    if wrong:
        send(Note(wrong, bad=True, stays=True, about="memory"))
    if faults:
        more, lines = (f" (and {len(faults) - 1} more)", faults) if len(faults) > 1 else ("", ())
        text, path = f"{faults[0]}{more}", preferences_file()
        send(Note(text, bad=True, stays=True, about="preferences", path=path, lines=lines))
    return preferences


def _sweep(preferences: Preferences) -> None:
    try:
        tidy()
        bound_kept(preferences)
        sweep_unfinished()
        forget_unclaimed()
    except OSError as error:
        _LOGGER.warning("nothing was swept: %s", error)
