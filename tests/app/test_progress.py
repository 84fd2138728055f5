"""The progress bar: on a terminal only, and gone when the work is done."""

import io
import sys

from app.cli.progress import Progress


class Terminal(io.StringIO):
    def __init__(self, is_one):
        super().__init__()
        self._is_one = is_one

    def isatty(self):
        return self._is_one


def test_a_bar_on_a_terminal(monkeypatch):
    screen = Terminal(True)
    monkeypatch.setattr(sys, "stderr", screen)
    with Progress("playing", 4) as tell:
        tell(2)
        tell(3)
    assert "playing [####################....................] 2/4" in screen.getvalue()
    assert "3/4" not in screen.getvalue()  # too soon after the first
    assert screen.getvalue().endswith("\r\x1b[K")


def test_nothing_on_a_pipe(monkeypatch):
    pipe = Terminal(False)
    monkeypatch.setattr(sys, "stderr", pipe)
    with Progress("playing", 4) as tell:
        tell(2)
        tell.part(0.9)
    assert pipe.getvalue() == ""
