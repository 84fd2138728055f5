"""Texts that teach the language of written textures, one step after another: palettes/lessons/NUMBER-NAME.txt."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

from engine.texture.expression.library.bundled_texts import LibraryText, library_text

_LESSONS = Path(__file__).resolve().parents[4] / "palettes" / "lessons"


@lru_cache(maxsize=1)
def lessons() -> tuple[LibraryText, ...]:
    """Returns them in order; the first is what one begins with."""
    return tuple(library_text(path) for path in sorted(_LESSONS.glob("*.txt")))
