"""The command that lays a height map as ground of a layer of heights."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import PurePath

from immutables import Map

from engine.brush.checks import thawed
from engine.files.strict_json import Fields
from engine.numeric.address import Rect
from engine.painting.layering.erode_command import read_land_rect
from engine.painting.layering.painting_member import A_FILE, HOLDS
from engine.painting.points import plain

SHORTEST_GROUND, MOST_GROUND = 2, 1 << 32  # pixels of a side, and in all
ROCK, ROUGHNESS, NO_RIM = 1.0, 0.85, 0.0
MOST_ROCK = 4.0
_HIGHEST = 1e12
_SEEDS = (1 << 31) - 1


@dataclass(frozen=True, slots=True)
class LayGround:
    """Lays the map that a texture holds as a file over `rect` of `level`, on a layer of heights (None: the one there
    is).

    `ends`: how high, in pixels of the level, the file's heights `of` lie (None: to scale where the file tells how wide
    its pixels are, else from 0 to a sixth of the longer side); `of`: two heights of the file (None: its lowest and its
    highest); `rock`: how much finer ground there is below its pixels, 1 for as rough as the map goes on, of
    `roughness`; `rim`: over how many pixels it grows from nothing.
    """

    texture: str
    rect: Rect
    level: int = 0
    layer: str | None = None
    ends: tuple[float, float] | None = None
    of: tuple[float, float] | None = None
    rock: float = ROCK
    roughness: float = ROUGHNESS
    rim: float = NO_RIM
    seed: int = 0
    extra: Map[str, object] = Map()  # noqa: RUF009  # it never changes


def read_ground(members: Fields) -> LayGround:
    """Reads the command; `write_ground` is the inverse."""
    level, rect = read_land_rect(members, SHORTEST_GROUND, MOST_GROUND)
    return LayGround(
        members.text("texture"),
        rect,
        level,
        None if members.take("layer", None) is None else members.text("layer"),
        _two(members, "range"),
        _two(members, "of"),
        members.number("rock", ROCK, lo=0.0, hi=MOST_ROCK),
        members.number("roughness", ROUGHNESS, lo=0.0, hi=1.0),
        members.number("rim", NO_RIM, lo=0.0, hi=_HIGHEST),
        members.integer("seed", 0, lo=0, hi=_SEEDS),
        members.rest(),
    )


def _two(members: Fields, name: str) -> tuple[float, float] | None:
    told = members.take(name, None)
    if told is None:
        return None
    sound = isinstance(told, list | tuple) and len(told) == 2
    if not sound or not all(isinstance(one, int | float) and abs(one) <= _HIGHEST for one in told):
        raise members.fault(name, f"two numbers, at most {_HIGHEST:.0e}")
    return float(told[0]), float(told[1])


def write_ground(command: LayGround) -> dict[str, object]:
    """Tells its members; defaults are left out."""
    rect = command.rect
    out: dict[str, object] = {
        "texture": command.texture,
        "rect": [command.level, rect.x0, rect.y0, rect.width, rect.height],
    }
    if command.layer is not None:
        out["layer"] = command.layer
    for name, two in (("range", command.ends), ("of", command.of)):
        if two is not None:
            out[name] = [plain(two[0]), plain(two[1])]
    for name, value, usual in (
        ("rock", command.rock, ROCK),
        ("roughness", command.roughness, ROUGHNESS),
        ("rim", command.rim, NO_RIM),
        ("seed", command.seed, 0),
    ):
        if value != usual:
            out[name] = plain(value)
    return {**out, **thawed(command.extra)}


def in_full(told: object) -> Iterator[object]:
    """Yields what a line of a recording tells, as it is told: of a ground that names its file by `path`, the texture
    that holds the file, then the ground of that texture."""
    if not (isinstance(told, dict) and told.get("do") == "ground" and isinstance(told.get("path"), str)):
        yield told
        return
    members = {name: value for name, value in told.items() if name not in ("path", "sha")}
    name = f"ground {PurePath(told['path']).name}"[-64:]
    named = {key: told[key] for key in ("path", "sha") if key in told}
    yield {"do": "texture", "name": name, "maker": "image", HOLDS: A_FILE, **named}
    yield {**members, "texture": name}
