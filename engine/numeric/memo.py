"""What functions made, kept for a while: bounded by the bytes of all together, and given up where memory is short."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from functools import wraps
from typing import ParamSpec, TypeVar, cast

import numpy as np

from engine.numeric.recent import Recent

_MOST = 1 << 30  # bytes, if nobody wants them
_LEAST = 24 << 20  # bytes that are not given up: about what one stroke asks for again and again
_OVERHEAD = 400  # bytes of what is kept about each, roughly
_P = ParamSpec("_P")
_Made = TypeVar("_Made")

REMEMBERED: Recent[tuple[object]] = Recent(lambda: _MOST, _LEAST)


def remembered(make: Callable[_P, _Made]) -> Callable[_P, _Made]:
    """Has a function keep what it makes of arguments that can be told apart by `==`, which nobody may write to.

    An argument with a `told_apart` is known by that, and is not kept itself.
    """

    @wraps(make)
    def known_or_made(*args: _P.args, **named: _P.kwargs) -> _Made:
        key = make, tuple(map(_told, args)), tuple((name, _told(held)) for name, held in named.items())
        known = REMEMBERED.get(key)
        if known is None:
            known = (make(*args, **named),)
            REMEMBERED.keep(key, known, _OVERHEAD + bytes_of(known))
        return cast("_Made", known[0])

    return known_or_made


def _told(argument: object) -> Hashable:
    found: Hashable = getattr(argument, "told_apart", argument)
    return found


def bytes_of(made: object) -> int:
    """Counts the bytes of all arrays in tuples, lists, dictionaries and fields of dataclasses."""
    sizes: dict[int, int] = {}
    seen, waiting = set[int](), [made]
    while waiting:
        held = waiting.pop()
        if id(held) in seen:
            continue
        seen.add(id(held))
        if isinstance(held, np.ndarray):
            whole = _whole(held)
            sizes[id(whole)] = whole.nbytes
        elif isinstance(held, bytes):
            sizes[id(held)] = len(held)
        elif isinstance(held, tuple | list):
            waiting.extend(held)
        elif isinstance(held, dict):
            waiting.extend(held.values())
        else:
            waiting.extend(getattr(held, name, None) for name in getattr(held, "__dataclass_fields__", ()))
    return sum(sizes.values())


def _whole(part: np.ndarray) -> np.ndarray:
    """Returns the array that an array is a part of, which is there as long as it is."""
    while isinstance(part.base, np.ndarray):
        part = part.base
    return part
