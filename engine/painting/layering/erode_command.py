"""The command that lets rain and gravity wear down a part of the heights of a layer."""

from __future__ import annotations

from dataclasses import dataclass

from immutables import Map

from engine.brush.checks import thawed
from engine.files.strict_json import Fields
from engine.numeric.address import Rect
from engine.painting.places import LEVEL_LIMIT, PLACE_LIMIT
from engine.painting.points import plain

SHORTEST_ERODED, MOST_ERODED = 16, 1 << 22  # pixels of a side, and in all
RAIN, STRENGTH, TALUS = 0.6, 0.5, 1.0
MOST_RAIN, MOST_TALUS = 4.0, 100.0
_SEEDS = (1 << 31) - 1


@dataclass(frozen=True, slots=True)
class Erode:
    """Wears down `rect` of `level`, of a layer of heights (None: the one there is): `rain` drops a pixel, which take
    ground with `strength`, 0..1; what is steeper than `talus`, in pixels of height a pixel, slides, unless it is 0."""

    rect: Rect
    level: int = 0
    layer: str | None = None
    rain: float = RAIN
    strength: float = STRENGTH
    talus: float = TALUS
    seed: int = 0
    extra: Map[str, object] = Map()  # noqa: RUF009  # it never changes


def read_land_rect(members: Fields, shortest: int, most: int) -> tuple[int, Rect]:
    """Reads the level of a rectangle of land, and its pixels: at least `shortest` each way, at most `most` in all."""
    level, x, y, width, height = members.integers("rect", 5, limit=PLACE_LIMIT)
    if min(width, height) < shortest or width * height > most or abs(level) > LEVEL_LIMIT:
        raise members.fault("rect", f"[L, X, Y, W, H], W and H at least {shortest}, and at most {most} pixels")
    return level, Rect.at(x, y, width, height)


def read_erode(members: Fields) -> Erode:
    """Reads the command; `write_erode` is the inverse."""
    level, rect = read_land_rect(members, SHORTEST_ERODED, MOST_ERODED)
    return Erode(
        rect,
        level,
        None if members.take("layer", None) is None else members.text("layer"),
        members.number("rain", RAIN, lo=0.0, hi=MOST_RAIN),
        members.number("strength", STRENGTH, lo=0.0, hi=1.0),
        members.number("talus", TALUS, lo=0.0, hi=MOST_TALUS),
        members.integer("seed", 0, lo=0, hi=_SEEDS),
        members.rest(),
    )


def write_erode(command: Erode) -> dict[str, object]:
    """Tells its members; defaults are left out."""
    rect = command.rect
    out: dict[str, object] = {"rect": [command.level, rect.x0, rect.y0, rect.width, rect.height]}
    if command.layer is not None:
        out["layer"] = command.layer
    for name, value, usual in (
        ("rain", command.rain, RAIN),
        ("strength", command.strength, STRENGTH),
        ("talus", command.talus, TALUS),
        ("seed", command.seed, 0),
    ):
        if value != usual:
            out[name] = plain(value)
    return {**out, **thawed(command.extra)}
