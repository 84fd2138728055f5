"""Textures by their names within others: the written ones that come along, woven into the text that names them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from engine.numeric.reader import quoted
from engine.texture.expression.library.bundled_texts import like_in_library, written_library
from engine.texture.expression.weaving import Env, Rule, Value, Weaver, last_line, woven_within
from engine.texture.expression.written import Term, WrittenError, WrittenText


def named_texture(read: Callable[[str], WrittenText]) -> Rule:
    """Returns the rule of a texture by its name, whose text is read by `read`: what it is at a place, usually where it
    is asked for, its sliders as they usually are."""

    def rule(weaver: Weaver, term: Term, env: Env) -> Value:
        name = term.told.strip('"')
        found = written_library().get(name)
        if found is None:
            weaver.refuse(term, quoted(name), like_in_library(name))
        place = [weaver.number(part, env.point) for part in term.parts]
        there = env if not place else replace(env, x=place[0].nodes[0], y=place[1].nodes[0])
        try:
            value = last_line(woven_within(weaver, read(found.text)), there)
        except WrittenError as error:
            weaver.refuse(term, error.found, error.expected)
        return replace(value, error=weaver.errors.worst(value.error, *(one.error for one in place)))

    return rule
