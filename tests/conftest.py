"""What all tests share: objects of one thread are checked to be touched by no other, also in programs they start; and
no test passes while a fault of the program is told, unless it takes the fault away."""

import logging
import os

import pytest

os.environ["INKFALL_CHECK_THREADS"] = "1"  # before any module of the program is loaded


class _Kept(logging.Handler):
    def __init__(self):
        super().__init__()
        self.records = []

    def emit(self, record):
        self.records.append(record)


@pytest.fixture(autouse=True)
def faults():
    """The faults that this process has told so far, as records of the logger; a test that provokes some clears it."""
    logger, kept = logging.getLogger("inkfall"), _Kept()
    logger.addHandler(kept)
    yield kept.records
    logger.removeHandler(kept)
    told = [logging.Formatter().format(record) for record in kept.records]
    assert not told, "\n".join(told)
