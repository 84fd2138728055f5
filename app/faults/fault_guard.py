"""Faults on the window's own thread: each is logged and told to the artist, and the window goes on.

The painting is a value on the engine's thread, which no fault of the window touches: it can still be saved.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from imgui_bundle import imgui

from app.faults.log import LOGGER

QUIET = 60.0  # seconds in which a fault of one place is told once: a panel's comes with every frame


class FaultGuard:
    """What is done within `spare` or `spare_drawing` may fail, and what comes after it is done all the same.  `say`:
    shows the artist that there was a fault."""

    def __init__(self, say: Callable[[], None]) -> None:
        self._say = say
        self._told: dict[tuple[str, int], tuple[float, int]] = {}  # by place: when, and how many came since

    @contextmanager
    def spare(self, doing: str) -> Iterator[None]:
        """Ends what fails within it.  `doing`: what is being done, for the log."""
        try:
            yield
        except Exception as error:
            self._tell(error, doing)

    @contextmanager
    def spare_drawing(self, doing: str) -> Iterator[None]:
        """As `spare`, for what calls imgui: windows, groups, styles and names that are still open are closed."""
        state = imgui.internal.ErrorRecoveryState()
        imgui.internal.error_recovery_store_state(state)
        try:
            yield
        except Exception as error:
            _recover(state)
            self._tell(error, doing)

    def _tell(self, error: Exception, doing: str) -> None:
        place, now = _raised_at(error), time.monotonic()
        told, more = self._told.get(place, (-QUIET, 0))
        if now - told < QUIET:
            self._told[place] = told, more + 1
            return
        if LOGGER.handlers:  # else it was the first frame's, before the log is open: it is to stand there, too
            self._told[place] = now, 0
        LOGGER.error("a fault, %s%s", doing, f", {more} times more" if more else "", exc_info=error)
        self._say()


def _raised_at(error: Exception) -> tuple[str, int]:
    """Returns the file and the line that raised it."""
    trace = error.__traceback__
    assert trace is not None
    while trace.tb_next is not None:
        trace = trace.tb_next
    return trace.tb_frame.f_code.co_filename, trace.tb_lineno


def _recover(state: imgui.internal.ErrorRecoveryState) -> None:
    """Closes what was opened since.  imgui would raise, print and show each of these as an error of its own."""
    io = imgui.get_io()
    told = (
        io.config_error_recovery_enable_assert,
        io.config_error_recovery_enable_debug_log,
        io.config_error_recovery_enable_tooltip,
    )
    _set_tellings(io, False, False, False)
    imgui.internal.error_recovery_try_to_recover_state(state)
    _set_tellings(io, *told)


def _set_tellings(io: imgui.IO, raises: bool, prints: bool, shows: bool) -> None:
    io.config_error_recovery_enable_assert = raises
    io.config_error_recovery_enable_debug_log = prints
    io.config_error_recovery_enable_tooltip = shows
