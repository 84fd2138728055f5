"""The members of a layer that say what it is for: `role`, and of heights `scale` and `sea`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from engine.files.strict_json import Fields

if TYPE_CHECKING:  # commands are read before anything is compiled
    from engine.canvas.layers import Node

_SCALES = 1e-6, 1e9  # pixels of level 0 from black to white
_SEAS = -16.0, 16.0  # brightness, which may be beyond black and white


def read_role(members: Fields, name: str) -> str:
    """Reads a role; null and "" are none."""
    return "" if members.take(name) in (None, "") else str(members.text(name))


def read_scale(members: Fields, name: str) -> float:
    """Reads how high white is."""
    out: float = members.number(name, lo=_SCALES[0], hi=_SCALES[1])
    return out


def read_sea(members: Fields, name: str) -> float:
    """Reads which brightness lies at height 0."""
    out: float = members.number(name, lo=_SEAS[0], hi=_SEAS[1])
    return out


def written_role(node: Node) -> dict[str, str | float]:
    """Tells those members of a node that say something."""
    given = {name: getattr(node, name, None) for name in ("role", "scale", "sea")}
    return {name: value for name, value in given.items() if value not in (None, "")}


def role_kept(members: Fields, kind: str) -> dict[str, str | float]:
    """Reads what `written_role` told of a node of a kind."""
    given: dict[str, str | float] = {}
    if kind != "group" and "role" in members:
        given["role"] = members.text("role")
    for name, read in (("scale", read_scale), ("sea", read_sea)):
        if kind == "layer" and name in members:
            given[name] = read(members, name)
    return given
