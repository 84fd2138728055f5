"""What a word that is being typed may become."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

from engine.studio.workshop.workshop_records import WorkshopWord, WorkshopWords

_WORD = re.compile(r"(?<![\w#.])[A-Za-z_]\w*$", re.ASCII)
_CALL = re.compile(r"(\"[^\"]*\"|[A-Za-z_]\w*)?[ \t]*$", re.ASCII)
_QUOTE = '"'


class Offer(NamedTuple):
    """`text`: that takes the place of what was typed; `form` and `about`: what is shown of it."""

    text: str
    form: str
    about: str

    @property
    def name(self) -> str:
        """Gives what it is found by."""
        return self.text.strip('"(')


def word_before(line: str, at: int) -> str:
    """Returns the word that ends at a place of a line, of a texture's name with the quote before it; "" if none does,
    or within a comment."""
    before = line[:at]
    closed, _, name = before.rpartition(_QUOTE)
    if before.count(_QUOTE) % 2 and "//" not in closed:
        return _QUOTE + name
    if "//" in before:
        return ""
    found = _WORD.search(before)
    return "" if found is None else found[0]


def word_at(line: str, at: int, words: WorkshopWords) -> WorkshopWord | None:
    """Returns the word in which a place of a line lies, a texture's name too; None if that is none of them."""
    closed = line[:at].count(_QUOTE) % 2
    end = line.find(_QUOTE, at) if closed else at
    while not closed and end < len(line) and (line[end].isalnum() or line[end] == "_"):
        end += 1
    name = word_before(line, max(end, at))
    rows = words.textures if name.startswith(_QUOTE) else (*words.functions, *words.names)
    return next((row for row in rows if row.name == name.lstrip(_QUOTE)), None)


def offers(word: str, words: WorkshopWords, own: Iterable[str], textures: Iterable[str] = ()) -> tuple[Offer, ...]:
    """Returns what a word may become, those that begin with it first; none where it is whole.  `own`: the names of
    lines; `textures`: of the painting's."""
    low = word.lstrip(_QUOTE).lower()
    rows = [_texture(name, "of this painting") for name in sorted(textures)]
    rows += [_texture(row.name, row.about) for row in words.textures]
    if not word.startswith(_QUOTE):
        named = [Offer(name, name, "a line above") for name in sorted(own)]
        named += [Offer(f"{row.name}(", row.form, row.about) for row in words.functions]
        named += [Offer(row.name, row.form, row.about) for row in words.names]
        rows = [*named, *(rows if len(low) > 1 else ())]
    begins = [row for row in rows if row.name.lower().startswith(low)]
    holds = [row for row in rows if row not in begins and low in f"{row.name} {row.about}".lower()]
    holds = [row for row in holds if low in row.name.lower() or row.text[0] == _QUOTE] if len(low) > 1 else []
    if any(row.name == word for row in begins):  # it may stand as it is: what only tells of it is in the way
        holds = []
    found = (*begins, *sorted(holds, key=lambda row: low not in row.name.lower()))
    return () if [row.name for row in found] == [word] else found


def accepted(line: str, at: int, offer: Offer) -> tuple[int, int, str]:
    """Returns what of a line, from, to, gives way to an offer, and to which text, behind which the caret stands."""
    start, end, text = at - len(word_before(line, at)), at, offer.text
    if text[0] == _QUOTE and line[end : end + 1] == _QUOTE:
        end += 1
    if text.endswith("(") and line[end:].startswith("("):
        text = text[:-1]
    return start, end, text


def _texture(name: str, about: str) -> Offer:
    return Offer(f'"{name}"(', f'"{name}"(x, y)', about)


def function_around(line: str, at: int, words: WorkshopWords) -> WorkshopWord | None:
    """Returns the innermost function, or texture, in whose brackets a place of a line lies; else the one that is named
    there."""
    depth = 0
    known = {row.form.partition("(")[0]: row for row in (*words.textures, *words.functions)}
    for i in range(min(at, len(line)) - 1, -1, -1):
        if line[i] == ")":
            depth += 1
        elif line[i] == "(":
            depth -= 1
            found = _CALL.search(line[:i]) if depth < 0 else None
            if found is not None and found[1] in known:
                return known[found[1]]
    named = word_at(line, at, words)
    return None if named in words.names else named
