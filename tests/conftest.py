"""What all tests share: objects of one thread are checked to be touched by no other, also in programs they start; and
no test passes while a fault of the program is told, unless it takes the fault away."""

import atexit
import gc
import logging
import os
import shutil
import signal
import tempfile
from collections import Counter

import pytest
from hypothesis import settings

try:
    from hypothesis.internal.conjecture import providers
except ImportError:  # of another version
    providers = None

os.environ["INKFALL_CHECK_THREADS"] = "1"  # before any module of the program is loaded
_OWN = tempfile.mkdtemp(prefix="inkfall-tests-")  # what is kept, and preferred, is not that of whoever runs the tests
atexit.register(shutil.rmtree, _OWN, ignore_errors=True)
gc.disable()  # until all is collected, which is a quarter of that time; nothing of it is garbage
for _number in (signal.SIGINT, getattr(signal, "SIGHUP", signal.SIGINT)):
    if signal.getsignal(_number) is signal.SIG_IGN:  # in the background of a shell, and under nohup
        signal.signal(_number, lambda *_: None)  # so what tests start does hear it
os.environ |= {"XDG_STATE_HOME": f"{_OWN}/state", "XDG_CONFIG_HOME": f"{_OWN}/config"}
# The same examples every time, and as long as they take, so that what fails is what was changed;
# --hypothesis-profile=default looks for others.
settings.register_profile("same", derandomize=True, deadline=None)
settings.load_profile("same")
if hasattr(providers, "_local_constants") and hasattr(providers, "_get_local_constants"):
    # Then no constant out of the modules that happen to be loaded: each change of one of them changed the examples, and
    # each worker read a thousand modules for it.
    _read = providers._get_local_constants
    providers._get_local_constants = lambda: providers._local_constants if settings.default.derandomize else _read()


FEW = 12  # slow proofs of a file


def pytest_collection_modifyitems(items):
    """Slow proofs have an hour each: they take minutes, more where the machine does something else, too.  Tests with a
    window, the longest, come first, so that none is left at the end for one process while others have nothing to do;
    of slow proofs those of which a file has few, so that each kind has its turn where not all have."""
    for item in items:
        if item.get_closest_marker("nightly") and not item.get_closest_marker("timeout"):
            item.add_marker(pytest.mark.timeout(3600))
    slow = [item for item in items if item.get_closest_marker("nightly")]
    counts = Counter(item.path for item in slow)
    later = {item for item in slow if counts[item.path] > FEW}
    items.sort(key=lambda item: (item in later, item.get_closest_marker("window") is None))


def pytest_collection_finish():
    """What is loaded now stays, and need not be looked through again and again."""
    gc.freeze()
    gc.set_threshold(50_000, 20, 50)  # as where kernels are compiled: a seventh of that time, and some of hypothesis's
    gc.enable()


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
