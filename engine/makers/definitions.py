"""Definitions of textures that travel with a brush: read, compared with those of a painting, given other names.

Light on purpose: the window imports it before the engine is loaded.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from immutables import Map

from engine.brush import settings
from engine.brush.parts import named_by_control
from engine.brush.settings import Brush
from engine.checks.field_error import FieldError
from engine.checks.values import described
from engine.painting import commands
from engine.painting.commands import DefineTexture, parse

FIELDS = {"tile": "spectrum", "sparse": "sparse"}  # how a sample is spread out, and the kind of texture that does it
USUAL = {
    "spectrum": "tile",
    "sparse": "sparse",
    "impulse": "sparse",
    "solid": "tile",
}  # what makers do where nothing is said
MATCHED = ("match", "mix")  # makers that match noise to examples
LEARN = "learn"  # of a picture that is refined below its own pixels
COUNT_CAP = 16  # of one brush
_REFERRING = ("texture", "density", "grain", "tip", "example")  # members of a brush that may hold a texture's name

Known = Mapping[str, tuple[str, Mapping[str, Any]]]  # textures of a painting: name -> kind, parameters


def read(value: Any, place: str, folder: Path | None = None) -> tuple[DefineTexture, ...]:
    """Returns the definitions of a list [{"name": ..., "maker": ..., ...}, ...]; paths in them start from `folder`.

    FieldError names the member.
    """
    if not isinstance(value, list) or len(value) > COUNT_CAP:
        raise FieldError(place, described(value), f"a list of at most {COUNT_CAP} textures")
    found: list[DefineTexture] = []
    members = value if folder is None else with_files(value, lambda path: str(folder.absolute() / path))
    for i, member in enumerate(members):
        given = {"do": "texture", **member} if isinstance(member, dict) else member
        command = parse(given, f"{place}[{i}]")
        if not isinstance(command, DefineTexture) or any(command.name == other.name for other in found):
            raise FieldError(f"{place}[{i}]", described(member), "a texture with a name of its own")
        found.append(command)
    return tuple(found)


def to_json(textures: Iterable[DefineTexture]) -> list[dict[str, Any]]:
    """Returns the list that `read` takes."""
    return [{name: value for name, value in commands.to_json(command).items() if name != "do"} for command in textures]


def with_files(value: Any, change: Callable[[str], str]) -> Any:
    """Returns definitions as JSON with other paths of pictures."""
    if isinstance(value, list):
        return [with_files(part, change) for part in value]
    if not isinstance(value, dict):
        return value
    return {name: change(part) if _is_path(name, part) else with_files(part, change) for name, part in value.items()}


def kind_of(command: DefineTexture) -> str:
    """Returns the kind of texture that a command defines, as far as its own members tell."""
    if command.maker in MATCHED:
        stages = command.arguments.get("stages", 1)
        return "series" if isinstance(stages, int) and stages > 1 else "matched"
    if command.maker == LEARN:
        return "image" if "path" in command.arguments else "canvas"
    usual = USUAL.get(command.maker)
    return command.maker if usual is None else FIELDS.get(command.arguments.get("field", usual), "")


def defined_by(command: DefineTexture, kind: str, parameters: Mapping[str, Any]) -> bool:
    """Tells whether a texture of a painting is what this command would make: all that is told is as told."""
    told = {name: value for name, value in command.arguments.items() if name not in ("sha", "maps_sha", "control_sha")}
    silent = _NAMING - set(told)
    return (
        kind == kind_of(command)
        and all(parameters.get(name, _MISSING) == value for name, value in told.items())
        and not any(name in parameters for name in silent)
    )


# A maker adds what it found out itself, never a member of those by which pictures are named.
_NAMING = frozenset(
    (
        *("path", "rect", "layer", "pattern", "start", "size", "shapes", "strokes", "part", "forward", "field"),
        *(
            "bundled",
            "mask",
            "mask_strokes",
            "region",
            "params",
            "maps",
            "material",
            "cube",
            "step",
            "touches",
            "detail",
        ),
    )
)
_MISSING = object()


def portable(name: str, kind: str, parameters: Mapping[str, Any]) -> DefineTexture | None:
    """Returns the definition of a painting's texture for use elsewhere; None if it needs the painting, or a picture
    whose place is not known."""
    if not _reachable(parameters):
        return None
    maker = kind
    if kind in FIELDS.values():
        maker = "impulse" if "window" in parameters else "spectrum" if "field" in parameters else kind
        maker = "solid" if "material" in parameters or "cube" in parameters else maker
    elif kind in ("matched", "series"):
        maker = "mix" if "pattern" in parameters else "match"
    given = {
        key: value
        for key, value in parameters.items()
        if key not in ("sha", "mask_sha", "maps_sha", "control_sha", "controls", "examples")
    }
    found = DefineTexture(name, maker, Map(given))
    return found if kind_of(found) == kind else None


def _reachable(value: Any) -> bool:
    """Tells whether all pictures that are named have absolute paths."""
    if isinstance(value, tuple):
        return all(map(_reachable, value))
    if not isinstance(value, Mapping):
        return True
    paths = [part for key, part in value.items() if _is_path(key, part)]
    return (
        not {"rect", "touches"} & set(value)
        and all(Path(path).is_absolute() for path in paths)
        and _reachable(tuple(value.values()))
    )


def named_files(command: DefineTexture) -> tuple[str, ...]:
    """Returns the paths of the pictures that a definition names: what these hold may change."""
    return tuple(_paths(command.arguments))


def _paths(value: object) -> Iterator[str]:
    if isinstance(value, tuple):
        for part in value:
            yield from _paths(part)
    elif isinstance(value, Mapping):
        for key, part in value.items():
            if _is_path(key, part):
                yield part
            else:
                yield from _paths(part)


def _is_path(key: str, value: Any) -> bool:
    named = key in ("path", "pattern", "start", "mask", "params", "cube") or (key == "phase" and "." in str(value))
    return isinstance(value, str) and named


def fitted(
    brush: Brush, needs: Sequence[DefineTexture], known: Known, taken: Iterable[str] = ()
) -> tuple[Brush, tuple[DefineTexture, ...], tuple[DefineTexture, ...]]:
    """Returns a brush for a painting whose textures are `known`: (the brush, the definitions that it needs, those of
    them that the painting lacks).

    A texture is defined anew only if the painting has none like it; under a free name, neither known nor `taken`, if
    another texture has its name.
    """
    names: dict[str, str] = {}
    needed, lacking = [], []
    for command in needs:
        same = [name for name, (kind, parameters) in known.items() if defined_by(command, kind, parameters)]
        if same:
            name = command.name if command.name in same else same[0]
        else:
            name = _free(command.name, {*known, *taken, *names.values()})
            lacking.append(replace(command, name=name))
        names[command.name] = name
        needed.append(replace(command, name=name))
    return renamed(brush, names), tuple(needed), tuple(lacking)


def _free(name: str, taken: set[str]) -> str:
    wanted, number = name, 1
    while wanted in taken:
        number += 1
        wanted = f"{name} {number}"
    return wanted


def used(brush: Brush, needs: Iterable[DefineTexture]) -> tuple[DefineTexture, ...]:
    """Returns those of some definitions that the brush refers to."""
    names: set[str] = set()
    _collect(settings.to_json(brush), names)
    return tuple(command for command in needs if command.name in names)


def refers(brush: Brush, name: str) -> bool:
    """Tells whether the brush refers to a texture."""
    names: set[str] = set()
    _collect(settings.to_json(brush), names)
    return name in names


def _collect(value: Any, names: set[str]) -> None:
    if isinstance(value, list):
        for part in value:
            _collect(part, names)
    elif isinstance(value, dict):
        names.update(part for key, part in value.items() if key in _REFERRING and isinstance(part, str))
        _collect([part for part in value.values() if isinstance(part, list | dict)], names)
        names.update(named_by_control(_control_of(value)))


def renamed(brush: Brush, names: Mapping[str, str]) -> Brush:
    """Returns the brush with other names for the textures it refers to."""
    if all(old == new for old, new in names.items()):
        return brush
    return settings.from_json(_renamed(settings.to_json(brush), names))


def _renamed(value: Any, names: Mapping[str, str]) -> Any:
    if isinstance(value, list):
        return [_renamed(part, names) for part in value]
    if not isinstance(value, dict):
        return value
    found = {
        key: names.get(part, part) if key in _REFERRING and isinstance(part, str) else _renamed(part, names)
        for key, part in value.items()
    }
    told = _control_of(value)
    renamed_told = {
        name: names.get(part, part) if part in named_by_control(told) else part for name, part in told.items()
    }
    return found | ({"control": renamed_told} if told else {})


def _control_of(value: Mapping[str, object]) -> dict[str, str | float]:
    """Returns what a brush, as JSON, tells of control channels."""
    told = value.get("control")
    return told if isinstance(told, dict) else {}
