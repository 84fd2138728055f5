"""The language of written textures as a whole: its words, texts read, and what a text is at a level.

    written = read("fbm(x * 4, y * 4)")
    woven = weave(written, Setting(values={}, level=0, seed=0, width=1 / 64))

`FUNCTIONS` has a row for each function: how many values it takes, from, to; its rule; and one line that tells what it
does, which begins with how it is written.
"""

from __future__ import annotations

from functools import lru_cache

from engine.texture.expression.arithmetic_words import ARITHMETIC, FUNCTIONS_OF_NUMBERS
from engine.texture.expression.colour_words import COLOUR_WORDS
from engine.texture.expression.graph import cost_of
from engine.texture.expression.library.named_words import named_texture
from engine.texture.expression.noise_words import NOISE_WORDS
from engine.texture.expression.pattern_words import PATTERN_WORDS
from engine.texture.expression.placing.placed_things import Texts, Thing, ThingScene, cost_of_things
from engine.texture.expression.placing.placing_words import PLACING_WORDS
from engine.texture.expression.shape_words import SHAPE_WORDS
from engine.texture.expression.weaving import Rule, Setting, Weaver, Woven, last_line
from engine.texture.expression.written import WrittenError, WrittenText, parse_text, words

COST_MOST = 50_000.0  # nanoseconds a pixel, about: a texture that takes more is refused
_Row = tuple[int, int, Rule, str]
_TABLES = (FUNCTIONS_OF_NUMBERS, NOISE_WORDS, PATTERN_WORDS, SHAPE_WORDS, COLOUR_WORDS, PLACING_WORDS)
FUNCTIONS: dict[str, _Row] = {name: row for table in _TABLES for name, row in table.items()}
_RULES: dict[str, Rule] = {**ARITHMETIC, **{name: row[2] for name, row in FUNCTIONS.items()}}
_WORDS = words({name: row[:2] for name, row in FUNCTIONS.items()})


@lru_cache(64)
def read(text: str) -> WrittenText:
    """Returns a text, checked.  WrittenError tells the first mistake."""
    return parse_text(text, _WORDS)


_RULES["texture"] = named_texture(read)


def weave(written: WrittenText, setting: Setting, line: int = -1) -> Woven:
    """Returns what a line, usually the last one, is.  WrittenError tells what is wrong with it."""
    if not written.follows:
        weaver = Weaver(written, setting, _RULES)
        value = last_line(weaver, weaver.here, line)
        return Woven(weaver.graph, value, weaver.errors.rough, cost_of(weaver.graph, (*value.nodes, value.error)))
    whole = _whole(written.text, tuple(sorted(setting.values.items())), setting.seed)
    scene = ThingScene(whole, False, None, True)
    weaver = Weaver(written, setting, _RULES, scene)
    try:
        value = last_line(weaver, weaver.here, line)
    except WrittenError:
        whole.children.clear()  # what was built by then is not all of it
        raise
    cost = cost_of(weaver.graph, value.nodes) + cost_of_things(whole)
    return Woven(weaver.graph, value, weaver.errors.rough, cost, whole, tuple(scene.takes))


@lru_cache(64)
def _whole(text: str, values: tuple[tuple[str, float | str], ...], seed: int) -> Thing:
    """Returns what holds all things of a text: one for all levels."""
    return Thing(Texts(read(text), dict(values), seed, _RULES), None, None)
