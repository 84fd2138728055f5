"""The language of written textures as a whole: its words, texts read, and what a text is at a level.

    written = read("fbm(x * 4, y * 4)")
    woven = weave(written, Setting(values={}, level=0, seed=0, width=1 / 64))

`FUNCTIONS` has a row for each function: how many values it takes, from, to; its rule; and one line that tells what it
does, which begins with how it is written.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

from engine.texture.expression.arithmetic_words import ARITHMETIC, FUNCTIONS_OF_NUMBERS
from engine.texture.expression.colour_words import COLOUR_WORDS
from engine.texture.expression.graph import Graph, cost_of
from engine.texture.expression.library.named_words import named_texture
from engine.texture.expression.noise_words import NOISE_WORDS
from engine.texture.expression.pattern_words import PATTERN_WORDS
from engine.texture.expression.shape_words import SHAPE_WORDS
from engine.texture.expression.weaving import Rule, Setting, Value, Weaver, last_line
from engine.texture.expression.written import WrittenText, parse_text, words

COST_MOST = 50_000.0  # nanoseconds a pixel, about: a texture that takes more is refused
_Row = tuple[int, int, Rule, str]
_TABLES = (FUNCTIONS_OF_NUMBERS, NOISE_WORDS, PATTERN_WORDS, SHAPE_WORDS, COLOUR_WORDS)
FUNCTIONS: dict[str, _Row] = {name: row for table in _TABLES for name, row in table.items()}
_RULES: dict[str, Rule] = {**ARITHMETIC, **{name: row[2] for name, row in FUNCTIONS.items()}}
_WORDS = words({name: row[:2] for name, row in FUNCTIONS.items()})


@dataclass(frozen=True, slots=True)
class Woven:
    """What a text, or one of its lines, is at a level: `value`, the nodes of `graph` that are shown, and the samples
    along a pixel; `cost`: nanoseconds a pixel, about."""

    graph: Graph
    value: Value
    cost: float


@lru_cache(64)
def read(text: str) -> WrittenText:
    """Returns a text, checked.  WrittenError tells the first mistake."""
    return parse_text(text, _WORDS)


_RULES["texture"] = named_texture(read)


def weave(written: WrittenText, setting: Setting, line: int = -1) -> Woven:
    """Returns what a line, usually the last one, is.  WrittenError tells what is wrong with it."""
    weaver = Weaver(written, setting, _RULES)
    value = last_line(weaver, weaver.here, line)
    return Woven(weaver.graph, value, cost_of(weaver.graph, value.nodes) * value.side**2)
