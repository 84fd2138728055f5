"""Texts that have less room than they take."""

from __future__ import annotations

from imgui_bundle import imgui

_DOTS = "…"


def ended(text: str, width: float) -> str:
    """Returns as much of a text's beginning as fits into a width, pixels; what is left out shows as dots."""
    if imgui.calc_text_size(text).x <= width:
        return text
    low, high = 0, len(text)  # characters that fit, and that do not
    while high - low > 1:
        half = (low + high) // 2
        fits = imgui.calc_text_size(text[:half].rstrip() + _DOTS).x <= width
        low, high = (half, high) if fits else (low, half)
    return text[:low].rstrip() + _DOTS
