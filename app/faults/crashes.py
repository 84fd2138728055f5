"""When the interpreter crashed: what `faulthandler` left in the log, which tells no time."""

from __future__ import annotations

import re
import time
from datetime import datetime

from app.faults.log import LOGGER, SIZE, log_file

_TRACE = re.compile(r"^Fatal Python error: ", re.MULTILINE)
_LINE = re.compile(r"^(\d{4}-\d\d-\d\d \d\d:\d\d:\d\d),\d{3} ", re.MULTILINE)
_NOTED = "the interpreter crashed at "
_FORM = "%Y-%m-%d %H:%M:%S"
_TIME = re.compile(re.escape(_NOTED) + r"(\d{4}-\d\d-\d\d \d\d:\d\d:\d\d)")


def crashes() -> tuple[float, ...]:
    """Returns when, seconds since 1970, as far as the log goes back; notes the last crash in it, with its time, unless
    that has been done.  For the files' thread."""
    try:
        with log_file().open(encoding="utf-8", errors="replace") as file:
            text = file.read(2 * SIZE)
            changed = log_file().stat().st_mtime
    except OSError:
        return ()
    times = [datetime.strptime(when, _FORM).timestamp() for when in _TIME.findall(text)]
    last = next(reversed(list(_TRACE.finditer(text))), None)
    if last is None or _NOTED in text[last.end() :]:
        return tuple(times)
    later = _LINE.search(text, last.end())
    when = changed if later is None else datetime.strptime(later[1], _FORM).timestamp()
    LOGGER.error("%s%s; its trace stands above", _NOTED, time.strftime(_FORM, time.localtime(when)))
    return (*times, when)
