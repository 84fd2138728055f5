"""Work with files: what the artist is told of a refusal, and of a fault."""

import errno
import os

import pytest

from app.desk.desk import FileWork
from app.desk.files import carried_out
from app.faults.log import log_file
from engine.checks.field_error import FieldError
from engine.files.fault import FileError


class Failing(FileWork):
    def __init__(self, error):
        self.error = error

    def carry_out(self):
        raise self.error


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (PermissionError(13, "Permission denied", "a.json"), "a.json: Permission denied"),
        (OSError(errno.ENOSPC, os.strerror(errno.ENOSPC)), "the disk is full"),
        (FileError("a.json", "found 3"), "a.json: found 3"),
        (FieldError("radius", "-1", "0 or more"), "radius: found -1, expected 0 or more"),
        (MemoryError(), "Not enough memory for this"),
    ],
)
def test_a_refusal_is_told_in_one_line_and_is_no_fault(error, words):
    assert carried_out(Failing(error)).fault == words


def test_a_fault_is_logged_and_told(faults):
    assert carried_out(Failing(KeyError("missing"))).fault == f"A fault in Inkfall: {log_file()} tells more"
    assert [record.exc_info[0] for record in faults] == [KeyError]
    faults.clear()
