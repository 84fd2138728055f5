"""The commands that copy and cut what is selected of a layer, and paste what was copied last."""

from __future__ import annotations

from dataclasses import dataclass

from immutables import Map


@dataclass(frozen=True, slots=True)
class CopyPaint:
    """Holds what is selected of a layer, all of it where nothing is, in place of what was copied before: no step, which
    no undo takes back."""

    name: str
    extra: Map[str, object] = Map()  # noqa: RUF009  # it never changes


@dataclass(frozen=True, slots=True)
class CutPaint:
    """Holds it likewise and takes it off the layer; undo brings it back there, and it stays held."""

    name: str
    extra: Map[str, object] = Map()  # noqa: RUF009  # it never changes


@dataclass(frozen=True, slots=True)
class PastePaint:
    """Lays what is held on a new layer of this name, above the active one."""

    name: str
    extra: Map[str, object] = Map()  # noqa: RUF009  # it never changes
