"""What every node of the tree of layers must be: its name, opacity, blend mode and flags."""

from __future__ import annotations

import math
import unicodedata
from collections.abc import Sequence
from typing import Protocol

from engine.checks.roles import MAX_NAME, ROLES
from engine.numeric.blend import BLENDS


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


class Numbered(Protocol):
    """A node of a tree, which may have `children`."""

    @property
    def id(self) -> int:
        """Gives its number, unique in the tree."""
        ...

    @property
    def name(self) -> str:
        """Gives its name, unique in the tree."""
        ...


def _children_of(node: Numbered) -> tuple[Numbered, ...]:
    found: tuple[Numbered, ...] = getattr(node, "children", ())
    return found


def nesting(root: Numbered) -> int:
    """Returns how many nodes lie in one another at most, the root not counted."""
    deep, nodes = 0, _children_of(root)
    while nodes:
        nodes = tuple(inner for node in nodes for inner in _children_of(node))
        deep += 1
    return deep


def find_wrong(root: Numbered, most: int) -> None:
    """Raises LayerError for a node whose name or id is in use, or that lies in more than `most` groups."""
    names, ids = set[str](), set[int]()
    todo = [(1, node) for node in reversed(_children_of(root))]
    while todo:
        deep, node = todo.pop()
        if node.name in names:
            raise LayerError(f"layer name: found {node.name!r} twice, expected a name not in use")
        insist(node.name, "id", node.id, node.id not in ids and node.id > 0, "a positive number not in use")
        insist(node.name, "nesting", deep, deep <= most + 1, f"at most {most} groups in one another")
        names.add(node.name)
        ids.add(node.id)
        todo += [(deep + 1, inner) for inner in reversed(_children_of(node))]
