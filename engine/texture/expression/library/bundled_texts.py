"""The written textures that come along: a text each, palettes/written/NAME.txt, whose first line tells what it is.

    // Cross-hatching, in lines: one layer more wherever it is darker

One `in lines` is 1 where a pen drew and 0 between: its brush leaves the paper free there.

A text that is part of a release is never changed: paintings and recordings may name it, and keep their pixels.  What is
better has another name.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from types import MappingProxyType

from engine.texture.expression.written import close_to

_TEXTS = Path(__file__).resolve().parents[4] / "palettes" / "written"
_GENERATORS = _TEXTS.with_name("generators")


@dataclass(frozen=True, slots=True)
class LibraryText:
    """`title`: as it is called in the window; `about`: what its first line says, title and all."""

    title: str
    about: str
    text: str

    @property
    def in_lines(self) -> bool:
        """Tells whether it is where a pen drew, not what lies all over."""
        return self.about.partition(":")[0].endswith(", in lines")


@lru_cache(maxsize=1)
def written_library() -> Mapping[str, LibraryText]:
    """Returns all texts that come along, by name."""
    return MappingProxyType({path.stem: library_text(path) for path in sorted(_TEXTS.glob("*.txt"))})


@lru_cache(maxsize=1)
def generator_library() -> Mapping[str, LibraryText]:
    """Returns all texts that come along and place things along a stroke, by name."""
    return MappingProxyType({path.stem: library_text(path) for path in sorted(_GENERATORS.glob("*.txt"))})


def like_in_library(name: str) -> str:
    """Returns what is expected in place of a name that the library has not: one like it."""
    like = close_to(name, list(written_library()))
    return "the name of a written texture that comes along" + (f", such as {like}" if like else "")


def library_text(path: Path) -> LibraryText:
    """Returns a text of a file."""
    text = path.read_text("utf-8")
    return LibraryText(title_of(text), _about(text), text)


def title_of(text: str) -> str:
    """Returns what a text's first line says that it is; "" where that is no note."""
    return _about(text).partition(":")[0].partition(",")[0].strip()


def _about(text: str) -> str:
    first = text.partition("\n")[0]
    return first.removeprefix("//").strip() if first.startswith("//") else ""
