"""Which programs the interpreter crashed in: `faulthandler` leaves the threads of each in the log."""

from __future__ import annotations

import re

from app.faults.log import SIZE, log_file

_TRACE = re.compile(r"^Fatal Python error: .*?(?=^\d{4}-\d\d-\d\d |\Z)", re.MULTILINE | re.DOTALL)
_THREAD = re.compile(r"^(?:Current thread|Thread) 0x([0-9a-f]+) ", re.MULTILINE)


def crashed_threads() -> frozenset[int]:
    """Returns the threads of all programs that crashed, by their idents, as far as the log goes back.  For the files'
    thread."""
    try:
        with log_file().open(encoding="utf-8", errors="replace") as file:
            text = file.read(2 * SIZE)
    except OSError:
        return frozenset()
    return frozenset(int(ident, 16) for trace in _TRACE.findall(text) for ident in _THREAD.findall(trace))
