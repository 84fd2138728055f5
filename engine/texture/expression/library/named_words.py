"""Textures by their names within others: the written ones that come along, and those of other texts, woven into the
text that names them; those of other makers as pictures, of places that the text tells."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from engine.numeric.reader import quoted
from engine.texture.expression.codes import Code
from engine.texture.expression.graph import Graph
from engine.texture.expression.library.bundled_texts import like_in_library, written_library
from engine.texture.expression.naming.asking import asked_of
from engine.texture.expression.naming.elsewhere import Elsewhere, unit_of
from engine.texture.expression.spreads import Spread, spread_within
from engine.texture.expression.weaving import Env, NamedText, Rule, Value, Weaver, last_line, woven_within
from engine.texture.expression.written import Term, WrittenError, WrittenText
from engine.texture.matched import Series

PLACES_MOST = 8  # textures of other makers, and places at which one is asked for, of one text
_DEVIATION = 0.15  # of such a texture, about
_HALF, _SEEN = 0.25, (0.1, 0.6)  # periods: see `spread_within`


def named_texture(read: Callable[[str], WrittenText]) -> Rule:
    """Returns the rule of a texture by its name, whose text is read by `read`: what it is at a place, usually where it
    is asked for."""

    def rule(weaver: Weaver, term: Term, env: Env) -> Value:
        name = term.told.strip('"')
        bundled = written_library().get(name)
        other = weaver.setting.named.get(name)
        place = [weaver.number(part, env.point) for part in term.parts[:2]]
        there = env if not place else replace(env, x=place[0].nodes[0], y=place[1].nodes[0])
        if len(term.parts) > 2:
            other, bundled = _of_series(weaver, term, env, None if bundled is not None else other), None
        if bundled is not None:
            value = _woven(weaver, term, there, read(bundled.text))
        elif isinstance(other, Elsewhere):
            value = _pictured(weaver, term, there, other)
        elif other is not None:
            value = _woven(weaver, term, there, read(other.text), other)
        else:
            weaver.refuse(term, quoted(name), like_in_library(name))
        return replace(value, error=weaver.errors.worst(value.error, *(one.error for one in place)))

    return rule


def _of_series(weaver: Weaver, term: Term, env: Env, other: Elsewhere | NamedText | None) -> Elsewhere:
    """Returns a texture of a series at the weight that is told, from its first example, 0, to the second, 1."""
    made = other.made if isinstance(other, Elsewhere) else None
    if not isinstance(made, Series):
        weaver.refuse(term.parts[2], "a third value", f"two: {quoted(term.told)} is no series between two examples")
    weight = weaver.fixed(term.parts[2], env, 0.0, 1.0)
    return Elsewhere(replace(made, weight=weight), unit_of(made))


def _woven(weaver: Weaver, term: Term, env: Env, written: WrittenText, told: NamedText | None = None) -> Value:
    about = written.text if told is None else told, env
    if about not in weaver.texts:
        try:
            weaver.texts[about] = last_line(woven_within(weaver, written, told), env)
        except WrittenError as error:
            weaver.refuse(term, error.found, error.expected)
    return weaver.texts[about]


def _pictured(weaver: Weaver, term: Term, env: Env, other: Elsewhere) -> Value:
    """Returns the nodes of a texture of another maker at a place, as wide as a sample is there."""
    graph = weaver.graph
    if weaver.scene is not None:
        weaver.refuse(term, f"the texture {term.told} in what is placed", "a written texture")
    wide = graph.most(weaver.width(env.x), weaver.width(env.y))
    if graph.value(wide) == 0.0:
        wide = graph.constant(weaver.setting.width)
    if not other.is_mean:  # its levels are as they are: seen by whole pixels, however many samples these have
        wide = graph.times(wide, float(weaver.setting.side))
    elif not _on_pixels(graph, env, (graph.value(wide) or 0.0) * other.unit):
        weaver.errors.flat(_DEVIATION)
    if other not in graph.elsewhere:
        graph.elsewhere.append(other)
    number = graph.elsewhere.index(other)
    nodes = tuple(
        graph.node(Code.PICTURE, env.x, env.y, wide, key=(number, channel)) for channel in range(other.channels)
    )
    weaver.spreads.told.update(dict.fromkeys(nodes, _spread(graph.value(wide))))
    if len(asked_of(graph, range(len(graph.operations)))) > PLACES_MOST:
        weaver.refuse(term, "one texture more", f"{PLACES_MOST} of other makers, at as many places, in one text")
    return Value(nodes)


def _on_pixels(graph: Graph, env: Env, wide: float) -> bool:
    """Tells whether samples are pixels of a level of a texture: neither turned nor moved, and as wide."""
    axes = set()
    for node in (env.x, env.y):
        told = graph.operations[node]
        axes.add(told.parts[0] if told.code == Code.TIMES else node)
    return axes == {graph.x, graph.y} and math.frexp(wide)[0] == 0.5


def _spread(width: float | None) -> Spread:
    """Returns how much such a texture varies within a sample, of a width if it is the same everywhere."""
    return Spread(_DEVIATION, 0.0) if width is None else spread_within(_DEVIATION, width, _HALF, 1.0, _SEEN)
