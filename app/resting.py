"""Whether all that was asked for is done and on the screen: for tests, which look at the window then."""

from __future__ import annotations

from imgui_bundle import imgui

from app import trace

QUIET = 2  # frames after one another of which nothing came: what opens in one may lie elsewhere in the next
LOOK = 0.05  # seconds after which a window that is not at rest looks again, at most


class Resting:
    """Looks at each frame.  `keys`, `presses`: how many the window has taken so far; `stirs`: whether something came of
    the frame, or moves; `rests`, `kept`: what was told last; `soon`: whether it may rest after the next frame."""

    def __init__(self) -> None:
        self.keys = self.presses = 0
        self.stirs = self.rests = self.soon = self.kept = False
        self._quiet = 0
        self._before: object = None

    def look(self, at: tuple[float, float], done: bool, kept: bool) -> None:
        """Tells of a frame that ended.  `at`: where the pointer is; `done`: nothing is being made beside it; `kept`:
        what is painted is on disk."""
        now = at, self.keys, self.presses
        quiet = done and not (self.stirs or trace.moved or _hint_comes() or now != self._before)
        self._before, self._quiet = now, self._quiet + 1 if quiet else 0
        self.rests, self.kept = self._quiet >= QUIET, kept
        self.soon = done and not self.rests
        trace.trace_rest(self.rests, kept, at, (self.keys, self.presses))


def _hint_comes() -> bool:
    """Tells whether the pointer lies still on something whose hint is to come."""
    context, style = imgui.get_current_context(), imgui.get_style()
    here = context.hover_item_delay_id
    if not here:
        return False
    short = style.hover_flags_for_tooltip_mouse & imgui.HoveredFlags_.delay_short
    delay = style.hover_delay_short if short else style.hover_delay_normal
    return bool(context.hover_item_unlocked_stationary_id != here or context.hover_item_delay_timer < delay)
