"""A palette: colours under names."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

MOST_COLOURS = 10_000
NAME_LENGTH = 80  # characters of a name that are kept


class NamedColour(NamedTuple):
    """sRGB, each channel 0..1; the name may be empty."""

    rgb: tuple[float, float, float]
    name: str = ""


@dataclass(frozen=True, slots=True)
class ColourList:
    """`columns`: how many lie side by side, 0 where the file does not say."""

    name: str
    colours: tuple[NamedColour, ...]
    columns: int = 0


def plain_name(text: str) -> str:
    """Returns a name of a stranger as it may be shown: one line of printable characters."""
    return " ".join("".join(ch if ch.isprintable() else " " for ch in text).split())[:NAME_LENGTH]
