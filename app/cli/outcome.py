"""How a command ends: exit status and the one line on standard error that says why."""

from __future__ import annotations

import os
import sys
import traceback
from contextlib import suppress

DONE, FAILED, WRONG = 0, 1, 2
# Set by those who look for a fault in the program: then the whole trace is shown.
TRACE = "INKFALL_TRACEBACK"


class Refused(Exception):
    """Arguments or an input file are wrong: `str()` names which, what was found and what was expected."""


class Failed(Exception):
    """The work could not be done: `str()` says what and which file."""


def reported(error: BaseException) -> int:
    """Writes the line for `error`; gives the exit status."""
    if isinstance(error, SystemExit):
        return _status_of(error)
    if os.environ.get(TRACE):
        traceback.print_exception(error)
    status, line = _judged(error)
    if isinstance(error, OSError):
        _give_up_standard_output()
    with suppress(OSError, ValueError):
        print(f"inkfall: {' '.join(line.split())}", file=sys.stderr, flush=True)
    return status


def _status_of(error: SystemExit) -> int:
    try:
        sys.stdout.flush()
    except OSError as failure:
        return reported(failure)
    return error.code if isinstance(error.code, int) else DONE if error.code is None else FAILED


def _judged(error: BaseException) -> tuple[int, str]:
    match error:
        case Refused():
            return WRONG, str(error)
        case Failed():
            return FAILED, str(error)
        case KeyboardInterrupt():
            return FAILED, "interrupted; nothing half-written is left"
        case MemoryError():
            return FAILED, "not enough memory for this"
        case BrokenPipeError():
            return FAILED, "whoever read standard output has gone"
        case OSError():
            return FAILED, _of_system(error)
    return _judged_by_engine(error)


def _of_system(error: OSError) -> str:
    from engine.files.fault import system_words

    return system_words(error)


def _judged_by_engine(error: BaseException) -> tuple[int, str]:
    from engine.files.fault import FileError, WriteError

    match error:
        case WriteError():
            return FAILED, str(error)
        case FileError():
            return WRONG, str(error)
    from engine.studio.faults import EXPECTED, words

    if isinstance(error, EXPECTED):
        return WRONG, words(error)
    from app.faults.log import log_fault, log_file

    where = traceback.extract_tb(error.__traceback__)
    place = f" ({os.path.basename(where[-1].filename)}, line {where[-1].lineno})" if where else ""
    more = f"{log_file()} tells more" if log_fault(error) else f"{TRACE}=1 shows more"
    return FAILED, f"a fault in Inkfall: {type(error).__name__}: {error}{place}; {more}"


def _give_up_standard_output() -> None:
    """If it can take nothing more: so that the interpreter does not fail once more when it flushes on its way out."""
    try:
        sys.stdout.flush()
    except (OSError, ValueError):
        with suppress(OSError, ValueError):
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, sys.stdout.fileno())
            os.close(nowhere)
