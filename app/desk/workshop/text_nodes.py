"""A text of the language as nodes, one for each line, and changes of these as changes of the text.

What can be set in a line, its *slots*, are its numbers, colours and names; a name of another line is a link to that.
Each change replaces a few letters of the text: comments, blanks and all else stay as they are.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

from engine.numeric.reader import Token
from engine.studio.workshop.workshop_records import WorkshopWord, WorkshopWords
from engine.texture.expression.written import PICK, SLIDER, WrittenError, parse_text, text_tokens, words

_VALUES_MOST = 129
_WORDS = ("if", "else")
_GREY, _HALF = "#808080", "0.5"
_USUAL = dict(
    pair.split("=")
    for pair in (
        *("x=x", "y=y", "a=x", "height=x", "texture=x", "d=x-0.5", "colour=#808080", "octaves=8", "finer=2", "seed=0"),
        *("jitter=1", "degrees=30", "corners=5", "low=0.3", "high=0.7", "radius=0.4", "inner=0.2", "gap=0.1", "n=1"),
        *("azimuth=315", "depth=0.1", "thick=0.1", "x0=0", "y0=0", "x1=1", "y1=1", "soft=0.1", "round=0.1"),
        *("right=0.1", "down=0.1", "across=2", "shift=0"),
    )
)  # what is given for a value of that name in a new line; 0.5 for others
_LISTS = {"ramp": "x, #202020, #e0e0e0", "curve": "x, 0, 0, 0.5, 1, 1, 0", "scale": "x, 2", "repeat": "x, 4"}


class Slot(NamedTuple):
    """`at`: characters of the text before it; `kind`: number, colour or name; `source`: the line that it names; `set_`:
    whether a number or a colour must stand there, as in a slider."""

    at: int
    text: str
    kind: str
    source: str = ""
    set_: bool = False

    @property
    def number(self) -> float:
        """Gives the number that it is."""
        return float(self.text.replace(" ", ""))


Piece = Slot | str


class NodeRow(NamedTuple):
    """One value of a line's function, called so; or all of a line that is no function."""

    label: str
    pieces: tuple[Piece, ...]

    @property
    def slots(self) -> tuple[Slot, ...]:
        """Gives what can be set in it."""
        return tuple(piece for piece in self.pieces if isinstance(piece, Slot))


@dataclass(frozen=True, slots=True)
class LineNode:
    """`name`: "" for the texture, where it has none; `head`: the function that it is, "" if it is none; `at`, `end`:
    where it lies in the text."""

    name: str
    head: str
    at: int
    end: int
    rows: tuple[NodeRow, ...]

    @property
    def sources(self) -> frozenset[str]:
        """Gives the lines that it names."""
        return frozenset(slot.source for row in self.rows for slot in row.slots if slot.source)

    @property
    def told(self) -> str:
        """Gives the line as it is read again."""
        rows = [" ".join(p if isinstance(p, str) else p.text for p in row.pieces) for row in self.rows]
        value = f"{self.head}({', '.join(rows)})" if self.head else rows[0]
        return f"{self.name} = {value}" if self.name else value


@dataclass(frozen=True, slots=True)
class TextNodes:
    """The nodes of a text, in its order: each names those before it alone."""

    text: str
    nodes: tuple[LineNode, ...]

    def columns(self) -> tuple[int, ...]:
        """Returns for each node how many links lead to it, one behind the other, at most."""
        found: dict[str, int] = {}
        for node in self.nodes:
            found[node.name] = max((found[source] + 1 for source in node.sources), default=0)
        last = self.nodes[-1].name
        found[last] = max(found.values()) if len(found) == 1 else max(found[last], *found.values())
        return tuple(found[node.name] for node in self.nodes)

    def users(self, name: str) -> tuple[str, ...]:
        """Returns the names of the lines that name another."""
        return tuple(node.name for node in self.nodes if name in node.sources)

    def replaced(self, slot: Slot, told: str) -> str:
        """Returns the text with something else in place of a slot."""
        before, behind = self.text[: slot.at], self.text[slot.at + len(slot.text) :]
        return before + _apart(before[-1:], told[:1]) + told + _apart(told[-1:], behind[:1]) + behind

    def linked(self, slot: Slot, name: str) -> str | None:
        """Returns the text with a line's name in place of a slot, the line before it; None where that cannot be."""
        number = next(n for n, node in enumerate(self.nodes) if node.at <= slot.at < node.end)
        needed = self._needed(name)
        if slot.set_ or not name or self.nodes[number].name in needed:
            return None
        moved = [node for node in self.nodes[number:] if node.name in needed]
        text = self.replaced(slot, name)
        grown = len(text) - len(self.text)  # before all that is moved
        lines = "".join(f"{self.text[node.at : node.end]}\n" for node in moved)
        for node in reversed(moved):
            text = _without(text, node.at + grown, node.end + grown)
        at = self.nodes[number].at
        return text[:at] + lines + text[at:]

    def added(self, word: WorkshopWord) -> str:
        """Returns the text with another line, of a function, before the last one."""
        taken, number = {node.name for node in self.nodes}, 1
        while f"{word.name}_{number}" in taken:
            number += 1
        at = self.nodes[-1].at
        return f"{self.text[:at]}{word.name}_{number} = {word.name}({_given(word)})\n{self.text[at:]}"

    def removed(self, node: LineNode) -> str | None:
        """Returns the text without a line; None if another names it, or it is the texture."""
        if node is self.nodes[-1] or self.users(node.name):
            return None
        return _without(self.text, node.at, node.end)

    def _needed(self, name: str) -> set[str]:
        """Returns the names of a line and of all that it is made of."""
        found = {name}
        for node in reversed(self.nodes):
            if node.name in found:
                found |= node.sources
        return found


def unlinked(coloured: bool) -> str:
    """Returns what stands in place of a name that is taken away."""
    return _GREY if coloured else _HALF


@lru_cache(8)
def text_nodes(text: str, known: WorkshopWords) -> TextNodes | None:
    """Returns a text as nodes; None if it cannot be read."""
    try:
        parse_text(text, words({word.name: (1, _VALUES_MOST) for word in known.functions}))
    except WrittenError:
        return None
    forms = {word.name: word.form for word in known.functions}
    nodes: list[LineNode] = []
    for tokens in _lines(text_tokens(text)):
        nodes.append(_node(text, tokens, forms, {node.name for node in nodes}))
    return TextNodes(text, tuple(nodes))


def _lines(tokens: Iterable[Token]) -> Iterator[list[Token]]:
    line: list[Token] = []
    for token in tokens:
        if token.kind not in ("break", "end"):
            line.append(token)
        elif line:
            yield line
            line = []


def _node(text: str, tokens: list[Token], forms: dict[str, str], own: set[str]) -> LineNode:
    at, end = tokens[0].at, tokens[-1].at + len(tokens[-1].text)
    named = len(tokens) > 1 and tokens[1].text == "="
    name, body = (tokens[0].text, tokens[2:]) if named else ("", tokens)
    if _is_function(body):
        head = body[0].text
        labels = forms.get(head, "").partition("(")[2].rstrip(")").split(", ")
        parts = _parts(body[2:-1])
        labels = labels[:-1] if labels[-1] == "..." else labels
        rows = tuple(
            NodeRow(labels[n] if n < len(labels) else "", _pieces(text, part, own, head in (SLIDER, PICK)))
            for n, part in enumerate(parts)
        )
        return LineNode(name, head, at, end, rows)
    return LineNode(name, "", at, end, (NodeRow("", _pieces(text, body, own, False)),))


def _is_function(body: list[Token]) -> bool:
    """Tells whether a line is one function of values, and nothing else."""
    if len(body) < 4 or body[0].kind != "name" or body[1].text != "(":
        return False
    depth = 0
    for n, token in enumerate(body):
        depth += {"(": 1, ")": -1}.get(token.text, 0)
        if depth == 0 and n > 1:
            return n == len(body) - 1
    return False


def _parts(tokens: list[Token]) -> list[list[Token]]:
    """Returns the values of a function."""
    out, depth = [[]], 0  # type: list[list[Token]], int
    for token in tokens:
        depth += {"(": 1, ")": -1}.get(token.text, 0)
        if token.text == "," and depth == 0:
            out.append([])
        else:
            out[-1].append(token)
    return out


def _pieces(text: str, tokens: list[Token], own: set[str], set_: bool) -> tuple[Piece, ...]:
    out: list[Piece] = []
    for n, token in enumerate(tokens):
        behind = tokens[n + 1].text if n + 1 < len(tokens) else ""
        told = token.text
        if token.kind == "number" and behind != "**" and _is_sign(tokens, n - 1):
            out.pop()
            at = tokens[n - 1].at
            out.append(Slot(at, text[at : token.at + len(told)], "number", set_=set_))
        elif token.kind in ("number", "colour"):
            out.append(Slot(token.at, told, token.kind, set_=set_))
        elif token.kind == "name" and behind != "(" and told not in _WORDS:
            out.append(Slot(token.at, told, "name", told if told in own else "", set_))
        else:
            out.append(told)
    return tuple(out)


def _is_sign(tokens: list[Token], n: int) -> bool:
    """Tells whether a token is a minus before one number, on the same row."""
    if n < 0 or tokens[n].text != "-":
        return False
    before = tokens[n - 1] if n else None
    return before is None or (before.kind == "sign" and before.text != ")") or before.text in _WORDS


def _given(word: WorkshopWord) -> str:
    """Returns values for a function of a new line."""
    if word.name in _LISTS:
        return _LISTS[word.name]
    return ", ".join(_USUAL.get(name, _HALF) for name in word.form.partition("(")[2].rstrip(")").split(", "))


def _apart(one: str, other: str) -> str:
    """Returns what keeps two letters from being read as one word."""
    return " " if _in_word(one) and _in_word(other) else ""


def _in_word(letter: str) -> bool:
    return letter.isalnum() or letter in ("_", ".", "#") if letter else False


def _without(text: str, at: int, end: int) -> str:
    """Returns a text without a line, and without the end of it, or the row if nothing else is in that."""
    behind = text[end:].lstrip(" \t\r")
    start = text.rfind("\n", 0, at) + 1
    if behind[:1] in (";", "\n"):
        return text[: at if text[start:at].strip() or behind[0] == ";" else start] + behind[1:]
    return text[:at] + behind  # a note behind it stays
