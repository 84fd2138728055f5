"""Written textures as definitions and keys tell them, checked."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache

from engine.checks.field_error import FieldError
from engine.checks.values import described, is_integer, is_within
from engine.texture.expression.language import COST_MOST, read
from engine.texture.expression.sampling.errors import POINT_SIDE
from engine.texture.expression.written import (
    CHARACTERS_MOST,
    FELT,
    FULL_TURN,
    OWN_RIM,
    OWN_WAY,
    PRESSURE,
    STAGES_LEAST,
    STAGES_MOST,
    STROKE_WAYS,
    USUAL_STAGES,
    Adjustable,
    WrittenError,
    WrittenText,
    is_colour,
    most_stages,
)
from engine.texture.expression.written_ink import (
    Expression,
    Named,
    Values,
    one_way,
    woven_line,
)
from engine.texture.record import Instance

PERIOD = 64.0  # pixels, usually
PERIOD_LEAST, PERIOD_MOST = 2.0**-10, 2.0**40
_NEAR = 12  # levels finer: where all octaves are in sight
_DEEPEST = 1 << 16
_TOLD_BY = {PRESSURE: "weight", OWN_RIM: "rim", OWN_WAY: "direction"}  # members of a definition that tell one of each
_NAMED_DEEP = 12  # texts that name textures, within one another


def expression(parameters: Mapping[str, object], base: int) -> Expression:
    """Returns the texture that the parameters of a definition tell; FieldError names what is wrong."""
    text = parameters.get("text")
    if not isinstance(text, str):
        raise FieldError("text", described(text), f"a text of at most {CHARACTERS_MOST} characters")
    period, level, seed = parameters.get("period", PERIOD), parameters.get("level", 0), parameters.get("seed", 0)
    if not is_within(period, PERIOD_LEAST, PERIOD_MOST):
        raise FieldError("period", described(period), f"a number from {PERIOD_LEAST:g} to {PERIOD_MOST:g}")
    if not is_integer(level) or not is_within(level, -_DEEPEST, _DEEPEST):
        raise FieldError("level", described(level), f"an integer from {-_DEEPEST} to {_DEEPEST}")
    if not is_integer(seed) or not is_within(seed, -(1 << 63), (1 << 64) - 1):
        raise FieldError("seed", described(seed), "an integer of at most 64 bits")
    assert isinstance(period, int | float)
    assert isinstance(level, int)
    assert isinstance(seed, int)
    try:
        written = read(text)
        values = chosen_values(written, parameters.get("values", {}))
        for name in written.felt:  # as values more, which are the stroke's to set
            values = (*values, (FELT[name], _felt(name, parameters)))
        named = _named(parameters.get("named", {}))
        check_woven(text, one_way(values), named, seed, float(period))
    except WrittenError as error:
        raise FieldError(f"text, line {error.line}, column {error.column}", error.found, error.expected) from None
    most = most_stages(written.felt)
    stages = parameters.get("stages", min(USUAL_STAGES, most))
    if not is_within(stages, STAGES_LEAST, STAGES_MOST, whole=True):
        raise FieldError("stages", described(stages), f"an integer from {STAGES_LEAST} to {STAGES_MOST}")
    assert isinstance(stages, int)
    if stages > most:
        told = ", ".join(written.felt)
        raise FieldError("stages", described(stages), f"at most {most} of a text that goes by {told}")
    return Expression(base, text, float(period), level, seed, values, False, named, stages)


def _named(given: object) -> Named:
    """Returns the textures that a text names, in an order that does not hang on what was given."""
    if not isinstance(given, Mapping) or not all(hasattr(made, "appearance") for made in given.values()):
        raise FieldError("named", described(given), "{name: a texture, ...}")
    deep = max((made.deep for made in given.values() if isinstance(made, Expression)), default=0)
    if deep >= _NAMED_DEEP:
        raise FieldError("named", f"names within names, {deep + 1} deep", f"{_NAMED_DEEP} at most")
    return tuple(sorted(given.items(), key=lambda pair: str(pair[0])))


def expression_of_key(key: Sequence[object], of_key: Callable[[object], Instance]) -> Expression:
    """Returns the texture whose key this is; `of_key` makes those that it names.  FieldError names what is wrong."""
    base = key[1]
    if len(key) < 6 or len(key) % 2 or not isinstance(base, int):
        raise FieldError("key", described(list(key)), "[kind, base level, text, period, level, seed, name, value, ...]")
    pairs = [(str(name), value) for name, value in zip(key[6::2], key[7::2], strict=True)]
    values = {name: value for name, value in pairs if not name.startswith('"')}
    named = {name.strip('"'): of_key(inner) for name, inner in pairs if name.startswith('"')}
    felt = {member: values.pop(FELT[name], 0.0) for name, member in _TOLD_BY.items() if FELT[name] in values}
    told = {"text": key[2], "period": key[3], "level": key[4], "seed": key[5], **felt}
    made = expression({**told, "values": values, "named": named}, base)
    return replace(made, covers=key[0] == "expression-cover")


def _felt(name: str, parameters: Mapping[str, object]) -> float:
    """Returns what a definition tells for the pressure or the like; of directions, in degrees, the nearest one."""
    member, usual, most = (_TOLD_BY[name], 0.0, FULL_TURN) if name == OWN_WAY else (_TOLD_BY[name], 1.0, 1.0)
    value = parameters.get(member, usual)
    if not is_within(value, 0.0, most):
        raise FieldError(member, described(value), f"a number from 0 to {most:g}")
    assert isinstance(value, int | float)
    if name == OWN_WAY:
        return math.floor(value * STROKE_WAYS / FULL_TURN + 0.5) % STROKE_WAYS * FULL_TURN / STROKE_WAYS
    return float(value) + 0.0


@lru_cache(256)
def check_woven(text: str, values: Values, named: Named = (), seed: int = 0, period: float = PERIOD) -> None:
    """Weaves a text from near and far.  WrittenError if it cannot be, or is too dear."""
    for finer in (0, _NEAR):
        checked_cost(text, values, named, seed, finer, period)


def checked_cost(text: str, values: Values, named: Named, seed: int, finer: int, period: float) -> float:
    """Returns about how many nanoseconds a pixel takes, so many levels finer than where the period is told.
    WrittenError as `check_woven`."""
    woven = woven_line(text, values, named, seed, finer, period)
    cost = woven.cost * (POINT_SIDE**2 if woven.rough or woven.jumps else 1)  # about; measuring needs kernels
    if cost > COST_MOST:
        told = f"{cost / 1000.0:.0f} microseconds a pixel"
        raise WrittenError((1, 1), told, f"{COST_MOST / 1000.0:.0f} at most: fewer octaves, lines or samples")
    return cost


def chosen_values(written: WrittenText, given: object) -> Values:
    """Returns the values of all sliders, by name: those that are given, else the usual ones."""
    if not isinstance(given, Mapping):
        raise FieldError("values", described(given), "{name: a number or a colour, ...}")
    sliders = written.sliders
    for name in given:
        if name not in sliders:
            expected = ", ".join(sliders) if sliders else "none: the text has no sliders"
            raise FieldError("values", described(name), expected)
    return tuple((name, _chosen(name, slider, given.get(name, slider.usual))) for name, slider in sliders.items())


def _chosen(name: str, slider: Adjustable, value: object) -> float | str:
    if isinstance(slider.usual, str):
        if not isinstance(value, str) or not is_colour(value):
            raise FieldError(f"values.{name}", described(value), "a colour, #rrggbb or #rrggbbaa")
        return value.lower()
    if not is_within(value, slider.least, slider.most):
        raise FieldError(f"values.{name}", described(value), f"a number from {slider.least:g} to {slider.most:g}")
    assert isinstance(value, int | float)
    number = float(value) + 0.0
    if slider.step > 0.0:
        number = min(slider.least + round((number - slider.least) / slider.step) * slider.step, slider.most)
    return number


def anew(defined: Mapping[str, object], given: Mapping[str, object], level: int) -> dict[str, object]:
    """Returns a definition's parameters with what a brush's ink gives in their place: of values those alone that it
    names, and a period in pixels of the stroke's level."""
    out = {**defined, **given}
    before, after = defined.get("values"), given.get("values")
    if isinstance(before, Mapping) and isinstance(after, Mapping):
        out["values"] = {**before, **after}
    if "period" in given and "level" not in given:
        out["level"] = level
    return out
