"""Which programs the interpreter crashed in: `faulthandler` leaves the threads of each in the log."""

from __future__ import annotations

import re

from app.faults.log import SIZE, log_file

_BEGUN = re.compile(r" program ([0-9a-f]+) begins with thread 0x([0-9a-f]+)$")  # as `program_line` tells it
_CRASH = re.compile(r"(?:Fatal Python error|Windows fatal exception): ")
_DATED = re.compile(r"\d{4}-\d\d-\d\d ")  # what the log tells is, a trace is not
_THREAD = re.compile(r"(?:Current thread|Thread) 0x([0-9a-f]+) ")


def crashed_programs() -> frozenset[str]:
    """Returns the idents of all programs that crashed, as far as the log goes back: of those that began with a thread
    of a trace, the last before it.  For the files' thread."""
    try:
        with log_file().open(encoding="utf-8", errors="replace") as file:
            text = file.read(2 * SIZE)
    except OSError:
        return frozenset()
    begun, crashed, in_trace = dict[int, str](), set[str](), False
    for line in text.splitlines():
        if (told := _BEGUN.search(line)) is not None:
            begun[int(told[2], 16)] = told[1]
        in_trace = bool(_CRASH.match(line)) or (in_trace and not _DATED.match(line))
        if in_trace and (told := _THREAD.match(line)) is not None:
            crashed |= {begun[thread] for thread in (int(told[1], 16),) if thread in begun}
    return frozenset(crashed)
