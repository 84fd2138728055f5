"""A written texture as lines of another text, under names that are free there."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from engine.painting.commands import DefineTexture
from engine.texture.expression.library.bundled_texts import generator_library, written_library
from engine.texture.expression.written import FELT, FULL_TURN, OWN_RIM, OWN_WAY, PRESSURE, WrittenError, WrittenText

_PERIOD = 64.0  # pixels: of a text that tells none
_TOLD_BY = {PRESSURE: "weight", OWN_RIM: "rim", OWN_WAY: "direction"}

Given = Mapping[str, object]  # what tells a texture, by names


class Inlined(NamedTuple):
    """`text`: lines, the last of which has the name that was asked for; `coloured`: whether that is a colour."""

    text: str
    coloured: bool


def text_of(command: DefineTexture) -> str:
    """Returns the text of a written texture, which may be one that comes along."""
    name = str(command.arguments.get("bundled", ""))
    found = written_library().get(name) or generator_library().get(name)
    return str(command.arguments.get("text", "" if found is None else found.text))


def text_period(given: Given, own: bool) -> float:
    """Returns how many pixels of a stroke a written texture calls 1; `own`: whether the ink tells that itself."""
    level = 0 if own else int(number_of(given, "level", 0.0))
    return math.ldexp(number_of(given, "period", _PERIOD), -level)


def number_of(given: Given, name: str, usual: float) -> float:
    """Returns a number that is told, else the usual one."""
    found = given.get(name, usual)
    return float(found) if isinstance(found, int | float) else usual


def text_set(text: str, values: Mapping[str, float | str]) -> str:
    """Returns a text with values of its sliders as their usual ones."""
    for name, value in values.items():
        usual = rf"(?m)((?:^|;)[ \t]*{re.escape(name)}[ \t]*=[ \t]*(?:slider|pick)[ \t]*\([ \t]*)[^,)\s]+"
        told = value if isinstance(value, str) else f"{value:.7g}"
        text = re.sub(usual, lambda found, told=told: found[1] + told, text, count=1)  # type: ignore[misc]
    return text


def by_pressure(knots: Sequence[tuple[float, float]]) -> str:
    """Returns a curve of the pressure as sums of pieces: the same at all places."""
    told = f"{knots[0][1]:.9g}"
    for (start, low), (end, high) in itertools.pairwise(knots):
        part = (
            f"clamp(({PRESSURE} - {start:.9g})/{end - start:.9g}, 0, 1)"
            if end > start
            else f"step({end:.9g}, {PRESSURE})"
        )
        told += f" + {high - low:.9g}*{part}" if high != low else ""
    return told.replace("+ -", "- ").replace(" 1*", " ").replace(f"({PRESSURE} - 0)/1", PRESSURE)


def inlined(text: str, given: Given, often: float, names: tuple[str, Callable[[str], str]]) -> Inlined:
    """Returns a text, as a component of an ink with some parameters has it, as lines of another one, in one period of
    which it comes so `often`; `names`: of its last line, and what makes a free one of a line's.  WrittenError tells
    where it is no text."""
    from engine.texture.expression.language import read  # with all that it takes to draw, which is there by now

    values = given.get("values")
    written = read(text_set(text, values if isinstance(values, Mapping) else {}))
    return Inlined(_renamed(written, _told(given, often), names), is_coloured(written.text))


def _told(given: Given, often: float) -> dict[str, str]:
    """Returns what stands for a place's name that means something else in the other text."""
    told = {"fw": f"(fw*{often:.9g})"} if often != 1.0 else {}
    for name, member in _TOLD_BY.items():
        value = given.get(member)
        if isinstance(value, int | float):
            told[name] = f"{value * math.tau / FULL_TURN if name == OWN_WAY else value:.9g}"
        elif isinstance(value, list | tuple):
            told[name] = f"({by_pressure(value)})"
    return told


def _renamed(written: WrittenText, told: Mapping[str, str], names: tuple[str, Callable[[str], str]]) -> str:
    """Returns a text with other names for its lines, and with what stands for some names of places."""
    last, free = names
    text, own, changes = written.text, dict[str, str](), list[tuple[int, int, str]]()
    for n, line in enumerate(written.lines):
        for term in line.term.within:
            new = own.get(term.told, told.get(term.told)) if term.operation == "name" else None
            if new is not None:
                changes.append((term.token.at, len(term.told), new))
        name = last if n == len(written.lines) - 1 else free(line.name)
        changes.append((line.at, len(line.name), name if line.name else f"{name} = "))
        own[line.name] = name
    for at, length, new in sorted(changes, reverse=True):
        text = text[:at] + new + text[at + length :]
    return text.strip()


def is_coloured(text: str) -> bool:
    """Tells whether a text is a colour; one that names others, if any colour stands in it."""
    from engine.texture.expression.defined import chosen_values
    from engine.texture.expression.language import read
    from engine.texture.expression.written_ink import woven_line

    written = read(text)
    felt = tuple((FELT[name], 0.0) for name in written.felt)
    try:
        woven = woven_line(written.text, (*chosen_values(written, {}), *felt), (), 0, 0, _PERIOD)
        return woven.value.coloured
    except WrittenError:
        return any(term.operation == "colour" for line in written.lines for term in line.term.within)
