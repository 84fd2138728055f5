"""How a wet brush takes up paint that lies there, carries it along and mixes it with its own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from immutables import Map

from engine.brush import checks
from engine.brush.checks import BrushError
from engine.checks.values import described

MIXINGS = ("light", "pigment")


@dataclass(frozen=True, slots=True)
class Wet:
    """`length`: how much of what was taken up is left after each radius of the way, 0..1; `amount`: how much of what a
    dab lays was taken up, the rest is the brush's own, its load; `dilution`: how much of the load is water, through
    which what lies there shows, mixed with it; `mixing`: one of MIXINGS.  `extra`: members of the JSON form that this
    version does not know."""

    length: float = 0.8
    amount: float = 0.5
    dilution: float = 0.0
    mixing: str = "light"
    extra: Map[str, object] = field(default_factory=Map)

    @property
    def pigment(self) -> bool:
        """Tells whether colours mix as paint does."""
        return self.mixing == MIXINGS[1]


def wet(value: object, place: str) -> Wet:
    """Reads how wet a brush is; BrushError names what is wrong."""
    if not isinstance(value, Mapping):
        raise BrushError(place, described(value), 'an object {"length": 0.8, "amount": 0.5, ...}')
    rest = Map({str(k): checks.frozen(v) for k, v in value.items() if k not in (*_PARTS, "mixing")})
    length, amount, dilution = (
        checks.number(value.get(name, getattr(_USUAL, name)), f"{place}.{name}", 0.0, 1.0) for name in _PARTS
    )
    mixing = checks.one_of(value.get("mixing", _USUAL.mixing), f"{place}.mixing", MIXINGS)
    return Wet(length, amount, dilution, mixing, rest)


def wet_json(told: Wet) -> dict[str, object]:
    """Tells it as JSON."""
    own: dict[str, object] = {name: getattr(told, name) for name in (*_PARTS, "mixing")}
    return own | dict(checks.thawed(told.extra))


_PARTS = ("length", "amount", "dilution")
_USUAL = Wet()
