"""What every node of the tree of layers must be: its name, opacity, blend mode and flags."""

from __future__ import annotations

import math
import unicodedata
from collections.abc import Sequence
from typing import Protocol

from engine.checks.roles import ROLES
from engine.numeric.blend import BLENDS

MAX_NAME = 200  # characters


class LayerError(ValueError):
    """A layer command that cannot be done; the message is one line for the artist or the script's author."""


class Common(Protocol):
    """What every node has."""

    @property
    def name(self) -> str:
        """Gives its name, unique in the tree."""
        ...

    @property
    def opacity(self) -> float:
        """Gives how much of it shows, 0..1."""
        ...

    @property
    def blend(self) -> str:
        """Gives a row of `BLENDS`."""
        ...


def insist(name: str, what: str, found: object, right: bool, expected: str) -> None:
    """Raises LayerError, with what was found and expected, unless it is right."""
    if not right:
        raise LayerError(f"layer {name!r}: {what}: found {found!r}, expected {expected}")


def allowed(character: str) -> bool:
    """Tells whether a name may hold it: no control characters, line ends, lone surrogates or what XML 1.0 cannot
    hold."""
    return unicodedata.category(character) not in ("Cc", "Cs", "Zl", "Zp") and character not in "\ufffe\uffff"


def check_name(name: object) -> None:
    """Raises LayerError unless it can be a node's name."""
    right = isinstance(name, str) and 0 < len(name) <= MAX_NAME and name.strip() == name and all(map(allowed, name))
    if not right:
        text = ascii(name)
        text = text if len(text) <= 60 else text[:57] + "..."
        raise LayerError(
            f"layer name: found {text}, expected 1 to {MAX_NAME} characters, no controls, no blanks around"
        )


def check_common(node: Common) -> None:
    """Raises LayerError unless name, opacity and blend mode can be."""
    check_name(node.name)
    opacity = node.opacity
    number = isinstance(opacity, int | float) and not isinstance(opacity, bool) and math.isfinite(opacity)
    insist(node.name, "opacity", opacity, number and 0 <= opacity <= 1, "a number from 0 to 1")
    insist(node.name, "blend", node.blend, node.blend in BLENDS, "one of " + ", ".join(BLENDS))


def check_role(node: Common, role: object) -> None:
    """Raises LayerError unless it can be a node's role."""
    insist(node.name, "role", role, role in ROLES, " or ".join(f'"{known}"' for known in ROLES[1:]) + ", or none")


def check_flags(node: Common, names: Sequence[str]) -> None:
    """Raises LayerError unless the properties of these names are true or false."""
    for name in names:
        value = getattr(node, name)
        insist(node.name, name, value, isinstance(value, bool), "true or false")
