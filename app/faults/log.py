"""The log of faults: a file in the user's state folder to which every unexpected error goes with its traceback.

Nothing is opened before the first frame is on the screen; until then faults go to standard error alone.
"""

from __future__ import annotations

import faulthandler
import logging
import sys
import threading
from io import TextIOWrapper
from logging.handlers import RotatingFileHandler
from pathlib import Path
from types import TracebackType
from typing import Any

import platformdirs

from engine.keeping.program import program_ident

SIZE, OLD = 1 << 20, 3  # bytes of the log at most, and how many full ones are kept
FORM = "%(asctime)s %(levelname)s %(threadName)s: %(message)s"
LOGGER = logging.getLogger("inkfall")


def log_file() -> Path:
    """Returns where the log lies, whether it exists or not."""
    return platformdirs.user_log_path("inkfall") / "inkfall.log"


def fault_words(fault: str = "A fault in Inkfall") -> str:
    """Returns the sentence for the artist that there was a fault, and where more of it stands."""
    return f"{fault}: {log_file()} tells more"


def program_line(ident: str, thread: int) -> str:
    """Returns the line with which a program begins in the log: `thread`, which it began with, is all that a trace of a
    crash tells of it, and others may have that number later."""
    return f"program {ident} begins with thread 0x{thread:x}"


class _Log(RotatingFileHandler):
    """The open file also takes what a crash of the interpreter leaves behind."""

    def _open(self) -> TextIOWrapper:
        stream = super()._open()
        faulthandler.enable(stream)
        told = program_line(program_ident(), threading.main_thread().ident or 0)
        line = logging.LogRecord(LOGGER.name, logging.INFO, "", 0, told, None, None)
        stream.write(f"{logging.Formatter(FORM).format(line)}\n")
        stream.flush()
        return stream

    def close(self) -> None:
        faulthandler.enable()  # standard error: the file's number may become another file's
        super().close()


def open_log() -> None:
    """Has faults of all threads told on standard error and in the log; a log that cannot be written is done without."""
    console = logging.StreamHandler()
    console.setFormatter(logging.Formatter(FORM))
    LOGGER.addHandler(console)
    try:
        LOGGER.addHandler(_opened(_Log))
    except OSError as error:
        print(f"inkfall: {log_file()}: no log is kept: {error.strerror}", file=sys.stderr)
    LOGGER.propagate = False
    sys.excepthook = _uncaught
    threading.excepthook = _in_thread
    sys.unraisablehook = _unraisable


def log_fault(error: BaseException) -> bool:
    """Logs the fault that ends the program, whether the log is open or not; False if it cannot be written."""
    if any(isinstance(handler, _Log) for handler in LOGGER.handlers):
        _uncaught(type(error), error, error.__traceback__)
        return True
    try:
        handler = _opened(RotatingFileHandler)
    except OSError:
        return False
    LOGGER.addHandler(handler)
    try:
        _uncaught(type(error), error, error.__traceback__)
    finally:
        LOGGER.removeHandler(handler)
        handler.close()
    return True


def _opened(kind: type[RotatingFileHandler]) -> RotatingFileHandler:
    """Returns a handler that writes the log.  OSError if that cannot be written."""
    log_file().parent.mkdir(parents=True, exist_ok=True)
    handler = kind(log_file(), maxBytes=SIZE, backupCount=OLD, encoding="utf-8")
    handler.setFormatter(logging.Formatter(FORM))
    return handler


def _uncaught(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    if issubclass(kind, KeyboardInterrupt):
        sys.__excepthook__(kind, error, trace)
    else:
        LOGGER.critical("a fault that ends the program", exc_info=(kind, error, trace))


def _in_thread(args: threading.ExceptHookArgs) -> None:
    if args.exc_value is not None and not isinstance(args.exc_value, SystemExit):
        LOGGER.error("a fault that ends a thread", exc_info=args.exc_value)


def _unraisable(args: Any) -> None:
    LOGGER.error("%s: %r", args.err_msg or "a fault that nobody could be told", args.object, exc_info=args.exc_value)
