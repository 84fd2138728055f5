"""Functions that place things: `scatter`, `row`, and `outer` for what holds them."""

from __future__ import annotations

from engine.texture.expression.placing.placed_things import DEEP_MOST, Spec, ThingScene, env_is_plain
from engine.texture.expression.weaving import Env, Rule, Value, Weaver
from engine.texture.expression.written import Term

_VARY = 0.3


def _place(weaver: Weaver, term: Term, env: Env, along: bool) -> Value:
    scene = weaver.scene
    assert isinstance(scene, ThingScene)
    if not env_is_plain(weaver, env):
        weaver.refuse(term, f"{term.operation} turned, warped or repeated", "it where the texture is as it is")
    if scene.owner.deep >= DEEP_MOST:
        weaver.refuse(term, "things within things within things", f"{DEEP_MOST} within one another at most")
    if along and scene.owner.deep:
        weaver.refuse(term, "row within a thing", "scatter: only the stroke has a line")
    parts = term.parts
    per = weaver.fixed(parts[1], env, 1.0 / 64.0, 256.0)
    vary = weaver.fixed(parts[5], env, 0.0, 1.0) if len(parts) > 5 else _VARY
    where, turn = (parts[n] if len(parts) > n else None for n in (3, 4))
    return Value(scene.child(weaver, term, Spec(along, per, parts[2], where, turn, vary)))


def _scatter(weaver: Weaver, term: Term, env: Env) -> Value:
    return _place(weaver, term, env, False)


def _row(weaver: Weaver, term: Term, env: Env) -> Value:
    return _place(weaver, term, env, True)


def _outer(weaver: Weaver, term: Term, env: Env) -> Value:
    scene = weaver.scene
    assert isinstance(scene, ThingScene)
    nodes = scene.told_by(weaver, term.parts[0])
    return weaver.value(term.parts[0], env) if nodes is None else Value(nodes)


PLACING_WORDS: dict[str, tuple[int, int, Rule, str]] = {
    "scatter": (3, 6, _scatter, "scatter(thing, per, size, where, turn, vary): things all over, so many a unit"),
    "row": (
        3,
        6,
        _row,
        "row(thing, apart, size, where, turn, vary): things along the stroke, each so far from the next",
    ),
    "outer": (1, 1, _outer, "outer(a): what a is where the thing stands, in what holds it"),
}
