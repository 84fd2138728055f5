"""Another language is read beside the window, which speaks it as soon as it is there."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from app.desk.desk import Desk, FileWork
from app.language.wide_fonts import load_wide_font, wide_font
from app.language.words import LANGUAGES, Words, read_words, speak


@dataclass(frozen=True, slots=True)
class SpeakLanguage(FileWork):
    """`code`: of the language, nothing for the system's."""

    code: str

    def carry_out(self) -> tuple[Words | None, Path | None]:
        """Reads its words, and finds the font that has its letters."""
        words = read_words(self.code)
        return words, None if words is None else wide_font(words.code)

    def arrive(self, desk: Desk, found: tuple[Words | None, Path | None]) -> None:
        """Speaks it; English where no font has its letters."""
        if not spoken(*found) and found[0] is not None:
            desk.say(f"No font for {LANGUAGES[found[0].code]} is found: install Noto Sans CJK", bad=True)


def spoken(words: Words | None, font: Path | None) -> bool:
    """Has the window speak a language, English where it wants a font that is not found: False then."""
    can = words is None or load_wide_font(words.code, font)
    speak(words if can else None)
    return can
