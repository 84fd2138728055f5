"""What the artist is told when something fails: the reason of an expected refusal, of a fault only that there is one.

A fault is an error of any other type than those in EXPECTED.  It goes to the logger "inkfall" with its traceback: to
standard error, and into the log, which the window opens.
"""

from __future__ import annotations

import errno
import logging
from pathlib import Path

from engine.canvas.node_checks import LayerError
from engine.checks.field_error import FieldError
from engine.files.fault import Cancelled, FileError
from engine.numeric.formula import FormulaError
from engine.painting.value import Leak, Refusal, Unclosed
from engine.studio.results import Note

EXPECTED = (FileError, FieldError, FormulaError, LayerError, Refusal, Cancelled, MemoryError)
FAULT = "A fault in Inkfall"
# What can be done about what did not work, by what that was: names of rows of ACTIONS in app.actions.
OFFERS: dict[str, tuple[str, ...]] = {
    "save": ("try_again", "save_as"),
    "export": ("try_again",),
    "open": ("try_again", "open"),
}
LEAKS = "It runs out of what you see: fill all the same?"
UNCLOSED = "Nothing closed lies within the line: fill all that it goes round?"
NO_ROOM, LOGGED = ("free_space",), ("copy_details",)  # about a full disk; about a fault
LOGGER = logging.getLogger("inkfall")


def told(error: Exception, doing: str, about: str = "", path: Path | None = None) -> Note:
    """Returns what the window is told of an error, and logs it if it is a fault.

    `doing`: what was being done; `about`: a row of OFFERS, then the line stays with what can be done about it, to the
    file `path`, if it is not the one that the error names.
    """
    if isinstance(error, Leak):
        return Note(LEAKS, True, stays=True, offers=("fill_all",), about="fill")
    if isinstance(error, Unclosed):
        return Note(UNCLOSED, True, stays=True, offers=("fill_line",), about="fill")
    fault = not isinstance(error, EXPECTED)
    if fault:
        LOGGER.error("a fault, %s", doing, exc_info=error)
    if isinstance(error, FileError) and path is None:
        path = Path(error.path)
    offers = OFFERS.get(about, ()) + (NO_ROOM if about and is_full(error) else ()) + (LOGGED if fault else ())
    return Note(words(error), True, fault, fault or bool(about), offers, about or ("fault" if fault else ""), path)


def stated(error: Exception) -> Exception:
    """Returns an error of what nobody asked for just now, as what plays from a file: there is nobody to answer."""
    return Refusal(str(error)) if isinstance(error, Leak | Unclosed) else error


def is_full(error: BaseException) -> bool:
    """Tells whether an error, or what it was raised from, says that there is no room left on a disk."""
    cause: BaseException | None = error
    while cause is not None:
        if isinstance(cause, OSError) and cause.errno in (errno.ENOSPC, errno.EDQUOT):
            return True
        cause = cause.__cause__
    return False


def words(error: Exception) -> str:
    """Returns an error in one line for people, which of a fault says nothing more."""
    if isinstance(error, MemoryError):
        return "Not enough memory for this"
    if isinstance(error, EXPECTED):
        return str(error).strip().partition("\n")[0] or type(error).__name__
    return FAULT
