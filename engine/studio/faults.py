"""What the artist is told when something fails: the reason of an expected refusal, of a fault only that there is one.

A fault is an error of any other type than those in EXPECTED.  It goes to the logger "inkfall" with its traceback: to
standard error, and into the log, which the window opens.
"""

from __future__ import annotations

import logging

from engine.canvas.layers import LayerError
from engine.checks.field_error import FieldError
from engine.files.fault import Cancelled, FileError
from engine.numeric.formula import FormulaError
from engine.painting.value import Refusal
from engine.studio.results import Note

EXPECTED = (FileError, FieldError, FormulaError, LayerError, Refusal, Cancelled, MemoryError)
FAULT = "A fault in Inkfall"
LOGGER = logging.getLogger("inkfall")


def told(error: Exception, doing: str) -> Note:
    """Returns what the window is told of an error, and logs it if it is a fault.  `doing`: what was being done."""
    fault = not isinstance(error, EXPECTED)
    if fault:
        LOGGER.error("a fault, %s", doing, exc_info=error)
    return Note(words(error), bad=True, fault=fault)


def words(error: Exception) -> str:
    """Returns an error in one line for people, which of a fault says nothing more."""
    if isinstance(error, MemoryError):
        return "Not enough memory for this"
    if isinstance(error, EXPECTED):
        return str(error).strip().partition("\n")[0] or type(error).__name__
    return FAULT
