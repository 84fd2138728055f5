"""Objects of one thread: any touch by another one fails, reading, calling and changing alike."""

import os
import subprocess
import sys
import threading

import pytest

from engine.checks.owned import Owned

PROBE = """
import threading
from engine.checks.owned import Owned

class Thing(Owned):
    pass

thing = Thing()
thread = threading.Thread(target=lambda: setattr(thing, "width", 4))
thread.start()
thread.join()
print(thing.width)
"""


class Thing(Owned):
    def __init__(self, width):
        self.width = width

    def area(self):
        return self.width**2


def elsewhere(touch):
    """What another thread that touches an object comes to: its result, or the line of its fault."""
    found = []

    def run():
        try:
            found.append(touch())
        except AssertionError as error:
            found.append(str(error))

    thread = threading.Thread(target=run, name="other")
    thread.start()
    thread.join()
    return found[0]


@pytest.mark.parametrize(
    ("name", "touch"),
    [
        ("width", lambda thing: thing.width),
        ("area", lambda thing: thing.area()),
        ("height", lambda thing: setattr(thing, "height", 3)),
    ],
)
def test_another_thread_may_not_touch_it(name, touch):
    thing = Thing(3)
    touch(thing)
    expected = f"Thing.{name}: touched by thread 'other', it belongs to 'MainThread'"
    assert elsewhere(lambda: touch(thing)).startswith(expected)
    assert thing.area() == 9


def test_it_belongs_to_the_thread_that_made_it():
    thing = elsewhere(lambda: Thing(2))
    assert type(thing) is Thing
    with pytest.raises(AssertionError, match="belongs to 'other'"):
        thing.area()


def test_nothing_is_checked_in_use():
    environment = {name: value for name, value in os.environ.items() if name != "INKFALL_CHECK_THREADS"}
    done = subprocess.run([sys.executable, "-c", PROBE], env=environment, capture_output=True, text=True, timeout=90)
    assert (done.stdout, done.returncode) == ("4\n", 0), done.stderr
