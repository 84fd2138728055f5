"""What a word that is being typed may become."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

from engine.studio.workshop.workshop_records import WorkshopWord, WorkshopWords

OFFERED = 7  # that are offered at a time
_WORD = re.compile(r"(?<![\w#.])[A-Za-z_]\w*$", re.ASCII)
_CALL = re.compile(r"([A-Za-z_]\w*)?[ \t]*$", re.ASCII)


class Offer(NamedTuple):
    """`text`: that takes the place of what was typed; `form` and `about`: what is shown of it."""

    text: str
    form: str
    about: str


def word_before(line: str, at: int) -> str:
    """Returns the word that ends at a place of a line; "" if none does, or within a comment."""
    before = line[:at]
    if "//" in before:
        return ""
    found = _WORD.search(before)
    return "" if found is None else found[0]


def offers(word: str, words: WorkshopWords, own: Iterable[str]) -> tuple[Offer, ...]:
    """Returns what a word may become, those that begin with it first; none where it is whole."""
    rows = [Offer(name, name, "a line above") for name in sorted(own)]
    rows += [Offer(f"{row.name}(", row.form, row.about) for row in words.functions]
    rows += [Offer(row.name, row.form, row.about) for row in words.names]
    low = word.lower()
    named = [(row, row.text.rstrip("(")) for row in rows]
    begins = [row for row, name in named if name.startswith(low)]
    holds = [row for row, name in named if low in name and not name.startswith(low)] if len(low) > 1 else []
    found = (*begins, *holds)
    return () if not word or [row.text.rstrip("(") for row in found] == [word] else found[:OFFERED]


def function_around(line: str, at: int, words: WorkshopWords) -> WorkshopWord | None:
    """Returns the innermost function in whose brackets a place of a line lies; else the one that is named there."""
    depth = 0
    known = {row.name: row for row in words.functions}
    for i in range(min(at, len(line)) - 1, -1, -1):
        if line[i] == ")":
            depth += 1
        elif line[i] == "(":
            depth -= 1
            found = _CALL.search(line[:i]) if depth < 0 else None
            if found is not None and found[1] in known:
                return known[found[1]]
    end = at
    while end < len(line) and (line[end].isalnum() or line[end] == "_"):
        end += 1
    return known.get(word_before(line, end))
