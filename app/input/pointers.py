"""All pointers of a window: the mouse, and pens where the system tells of them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import glfw

from app.input.choose import key_times, pen_source
from app.input.events import PenEvent, PenSource, PointerSource
from app.input.glfw_events import GlfwPointer

if TYPE_CHECKING:
    from app.input.key_times import KeyTimes


class Pointers:
    """All calls from the window's thread."""

    def __init__(self, window: Any) -> None:
        self._window = window
        self.mouse: PointerSource = GlfwPointer(window)
        self._pen: PenSource | None = None
        self._keys: KeyTimes | None = None
        self._later: list[PenEvent] = []  # what came after a key that was told

    def hear_pens(self, driver: str = "ink") -> None:
        """From now on pens are heard, where a system has several ways by that `driver`."""
        self._pen = pen_source(self._window, driver)
        self._keys = key_times() if self._pen is not None else None

    def events(self) -> list[PenEvent]:
        """Returns what came since the last call.

        What GLFW tells comes first: where pens are heard, X tells it nothing any more but what happened before.
        """
        found, self._later = [*self._later, *(self._pen.events() if self._pen is not None else [])], []
        return [*self._moused(), *found]

    def events_in_order(self) -> list[PenEvent]:
        """Returns what came since the last call, once GLFW has told of the keys that were pressed before it: what pens
        do is read from a connection of its own, and may be there first.  Not to be called by what GLFW calls."""
        if self._pen is None or self._keys is None:
            return self.events()
        self._later += self._pen.events()
        if not self._later:
            return self._moused()
        last = self._later[-1]
        glfw.poll_events()  # with each key, what came before it is asked for
        count = next((i + 1 for i, event in enumerate(self._later) if event is last), 0)
        found, self._later = self._later[:count], self._later[count:]
        return [*self._moused(), *found]

    def events_before(self, scancode: int | None) -> list[PenEvent]:
        """Returns what came since the last call and before the key that GLFW tells of now; all that came, where that is
        no key, or it is not known when it was pressed: GLFW itself tells everything in its order."""
        time = self._keys.of(scancode) if self._keys is not None and scancode is not None else None
        if time is None:
            return self.events()
        mouse, found = self._moused(), [*self._later, *(self._pen.events() if self._pen is not None else [])]
        first = next((i for i, event in enumerate(found) if after(event, time)), len(found))
        self._later = found[first:]
        return [*mouse, *found[:first]]

    def _moused(self) -> list[PenEvent]:
        """Returns what the mouse did, where no pen moves it."""
        events = self.mouse.events()
        return [] if self._pen is not None and self._pen.near else events

    def heard(self) -> tuple[str, tuple[str, ...]]:
        """Returns how pens are heard, "" where they are not, and the names of those that are there."""
        return (self._pen.name, tuple(self._pen.tablets())) if self._pen is not None else ("", ())

    def at(self) -> tuple[float, float]:
        """Tells where the mouse is, framebuffer pixels: while something is dragged, no events tell."""
        x, y = glfw.get_cursor_pos(self._window)
        width, height = glfw.get_window_size(self._window)
        wide, tall = glfw.get_framebuffer_size(self._window)
        return x * wide / max(width, 1), y * tall / max(height, 1)

    def close(self) -> None:
        """Gives back what pens hold."""
        if self._pen is not None:
            self._pen.close()
        if self._keys is not None:
            self._keys.close()


def after(event: PenEvent, time: int) -> bool:
    """Tells whether it came after a time of the X server's clock, milliseconds, which begins anew after 2^32."""
    return 0 < (round(event.time * 1000) - time) % 2**32 < 2**31
