"""Texts of the window in the artist's language: catalogues as gettext has them, from English.

What is drawn comes here as a whole, so that tables, hints and messages need not know of it.  A text that tells a name
or a number is found by its form: the catalogue has "Opening {name}", whatever the name is.
"""

from __future__ import annotations

import gettext
import locale
import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

CATALOGUES = Path(__file__).resolve().parents[2] / "palettes" / "languages"
LANGUAGES = {"en": "English", "de": "Deutsch", "fr": "Français", "ja": "日本語", "zh_CN": "中文"}
_MOST = 20_000  # texts that are remembered
_PLACE = re.compile(r"\{(\w+)\}")
_EDGES = re.compile(r"([\s\ue000-\uf8ff+]*)(.*?)(\s*)", re.DOTALL)  # signs before a text, and what is empty
_KEYS = re.compile(r"(.*\S)(  \([^()]+\))", re.DOTALL)  # a hint and its keys
_LETTERS = re.compile(r"[A-Za-z]{2}")
_OWN = {"name", "path", "stem", "title_of", "file", "layer", "only", "key"}  # places of what is the artist's own


class _Form(NamedTuple):
    """A text with places: what finds it, and what it becomes."""

    pattern: re.Pattern[str]
    becomes: str


class Words:
    """A catalogue.  `code`: its language."""

    def __init__(self, code: str, catalogue: dict[str, str]) -> None:
        self.code = code
        self._whole = {told: becomes for told, becomes in catalogue.items() if not _PLACE.search(told)}
        self._forms: dict[str, list[_Form]] = {}  # by the first letter, none where that is a place
        for told, becomes in sorted(catalogue.items(), key=lambda row: -len(_PLACE.sub("", row[0]))):
            if _PLACE.search(told):
                self._forms.setdefault(_first(told), []).append(_Form(_pattern(told), becomes))
        self._known: dict[str, str] = {}

    def of(self, text: str) -> str:
        """Returns a text in its language; as it is where the catalogue has none."""
        found = self._known.get(text)
        if found is None:
            if len(self._known) >= _MOST:
                self._known.clear()
            found = self._known[text] = self._found(text)
        return found

    def _found(self, text: str) -> str:
        if text in self._whole:
            return self._whole[text]
        edges = _EDGES.fullmatch(text)
        assert edges is not None  # it takes any text
        before, middle, after = edges.groups()
        return f"{before}{next(self._ways(middle), middle)}{after}" if middle else text

    def _ways(self, text: str) -> Iterator[str]:
        """Yields what a text may become: as a whole, line by line, without its keys, by its form, sentence by
        sentence."""
        if text in self._whole:
            yield self._whole[text]
        if "\n" in text:
            yield "\n".join(map(self.of, text.split("\n")))
        keys = _KEYS.fullmatch(text)
        if keys is not None and (found := self.of(keys[1])) != keys[1]:
            yield found + keys[2]
        for form in (*self._forms.get(text[:1], ()), *self._forms.get("", ())):
            match = form.pattern.fullmatch(text)
            if match is not None:
                yield self._filled(form.becomes, match.groupdict())
        head, colon, rest = text.partition(": ")
        if ": " in rest and (known := self.of(rest)) != rest and (title := self.of(head)) != head:
            yield title + colon + known
        for between in (": ", ".  ", "; ", ", "):
            if between in text:
                parts = text.split(between)
                told = list(map(self.of, parts))
                if all(one != other or not _LETTERS.search(one) for one, other in zip(parts, told, strict=True)):
                    yield between.join(told)
        if (sentence := text[:1].upper() + text[1:]) in self._whole:  # in the middle of another one
            found = self._whole[sentence]
            yield found if self.code == "de" else found[:1].lower() + found[1:]
        if (small := text[:1].lower() + text[1:]) in self._whole:  # at the beginning of one
            yield self._whole[small][:1].upper() + self._whole[small][1:]

    def _filled(self, becomes: str, found: dict[str, str]) -> str:
        """Returns a text with its places filled: with the artist's own as it is, else in this language, if that is
        known."""
        own = {name: text if name.rstrip("0123456789") in _OWN else self.of(text) for name, text in found.items()}
        return _PLACE.sub(lambda place: own.get(place[1], place[0]), becomes)


def _first(told: str) -> str:
    return "" if told.startswith("{") else told[0]


def _pattern(told: str) -> re.Pattern[str]:
    parts = _PLACE.split(told)
    names = iter(parts[1::2])
    return re.compile(
        "".join(f"(?P<{next(names)}>.*?)" if i % 2 else re.escape(part) for i, part in enumerate(parts)), re.DOTALL
    )


_spoken: Words | None = None
_meant: dict[str, str] = {}  # windows, by what they are called in the artist's language


def say(text: str) -> str:
    """Returns a text in the language that is spoken."""
    return text if _spoken is None else _spoken.of(text)


def labelled(text: str) -> str:
    """Returns the label of a control in the language that is spoken: imgui knows it by the English one, whatever that
    shows."""
    if _spoken is None:
        return text
    shown = _spoken.of(text.partition("##")[0])
    if shown == text.partition("##")[0]:
        return text
    hidden = text.partition("###")[2] or text
    _meant[shown] = text.partition("##")[0]
    return f"{shown}###{hidden}"


def meant(title: str) -> str:
    """Returns the English title of a window."""
    return _meant.get(title, title)


def read_words(code: str) -> Words | None:
    """Returns the words of a language, of the system's where that is none; None for English.  It reads a file."""
    code = code if code in LANGUAGES else system_language()
    return None if code == "en" else Words(code, read_catalogue(code))


def speak(words: Words | None) -> None:
    """From now on speaks a language, English where there are no words."""
    global _spoken
    _meant.clear()
    _spoken = words


def read_catalogue(code: str) -> dict[str, str]:
    """Returns what texts become in a language; nothing where its catalogue is not there."""
    try:
        with (CATALOGUES / f"{code}.mo").open("rb") as file:
            found = gettext.GNUTranslations(file)
    except (OSError, UnicodeError, ValueError):
        return {}
    return {told: becomes for told, becomes in vars(found)["_catalog"].items() if isinstance(told, str) and told}


def known_languages() -> dict[str, str]:
    """Returns the languages of which there are catalogues, by their codes."""
    return {code: name for code, name in LANGUAGES.items() if code == "en" or (CATALOGUES / f"{code}.mo").exists()}


def system_language() -> str:
    """Returns the language that the system is set to, English where there is no catalogue of it."""
    told = next(filter(None, (os.environ.get(name) for name in ("LC_ALL", "LC_MESSAGES", "LANG"))), "")
    told = told or (locale.getlocale()[0] or "")
    for code in known_languages():
        if told.replace("-", "_").startswith(code):
            return code
    return "en"
