"""Wet paint: how a brush takes up what lies there, carries it, and mixes it with its own."""

from __future__ import annotations

from imgui_bundle import imgui

from app.desk.desk import Desk
from app.panels.controls import widgets as w
from engine.brush.wet import Wet

_SECTION = "Takes up the paint that lies there, carries it along and mixes it with its own"
_SLIDERS = (
    ("amount", "Picks up", "How much of the stroke is paint from the canvas; at 100% it only smears"),
    ("length", "Carries", "How far picked-up paint is dragged: how much is left after one radius"),
    ("dilution", "Water", "Thins the brush's own paint: what lies below shows through and mixes with it"),
)
_MIXINGS = (
    ("light", "As light", "Colours average: blue and yellow turn grey"),
    ("pigment", "As pigment", "Colours mix as paint does: blue and yellow make green"),
)


class WetSection:
    """Draws it; what was set before it was switched off comes back."""

    def __init__(self) -> None:
        self._kept = Wet(mixing="pigment")

    def draw(self, desk: Desk) -> float:
        """Draws it into the present window; how high what is unfolded is."""
        if not desk.hand.stroke_mode().lays_ink:
            return 0.0
        held = desk.hand.brush.wet
        shown, on = w.switched_section("Wet paint", _SECTION, held is not None)
        now, top = held or self._kept, imgui.get_cursor_pos().y
        if shown:
            imgui.begin_disabled(not on)
            now = _settings(now)
            imgui.end_disabled()
            if on and held is None and imgui.get_cursor_screen_pos().y > _bottom():
                imgui.set_scroll_here_y(1.0)
        if on:
            self._kept = now
        if (now if on else None) != held:
            desk.hand.change(wet=now if on else None)
        return imgui.get_cursor_pos().y - top


def _bottom() -> float:
    return imgui.get_window_pos().y + imgui.get_window_height()


def _settings(wet: Wet) -> Wet:
    parts: dict[str, float] = {}
    for name, label, hint in _SLIDERS:
        before: float = getattr(wet, name)
        changed, value = w.slider(label, before * 100, (0.0, 100.0), hint, form="%.0f%%")
        parts[name] = round(value / 100, 3) if changed else before
    mixing = w.segments("mixing", wet.mixing, _MIXINGS) or wet.mixing
    return Wet(parts["length"], parts["amount"], parts["dilution"], mixing, wet.extra)
