"""Texts that have less room than they take."""

from __future__ import annotations

from pathlib import Path

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


def shortened(text: str, width: float) -> str:
    """Returns a text with as much left out in its middle as it is too wide."""
    if imgui.calc_text_size(text).x <= width:
        return text
    for kept in range(len(text) - 1, 1, -1):
        shorter = f"{text[: kept // 2]}{_DOTS}{text[-(kept - kept // 2) :]}"
        if imgui.calc_text_size(shorter).x <= width:
            return shorter
    return _DOTS


def home_text(path: Path) -> str:
    """Returns a path as people write it."""
    home = Path.home()
    return f"~/{path.relative_to(home)}" if path.is_relative_to(home) else str(path)
