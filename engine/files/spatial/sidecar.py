"""What programs have to be told of a height map, beside it as JSON: size, place, what its codes mean."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

CODES = 65535
_HALF_RANGE = 512.0  # Unreal's heights go from -256 to 256 of its units at a scale of 100


@dataclass(frozen=True)
class MapFacts:
    """A height map: its file's name, its `size` (columns, rows), metres of a pixel's side, lowest and highest height in
    metres, and what else is told."""

    file: str
    size: tuple[int, int]
    pixel: float
    low: float
    high: float
    place: dict[str, object]


def _godot(facts: MapFacts) -> dict[str, object]:
    return {"map_scale": facts.pixel, "heights": "metres in one float channel (.exr); of a .png, code_0 to code_65535"}


def _unreal(facts: MapFacts) -> dict[str, object]:
    z = (facts.high - facts.low) * 100.0 / _HALF_RANGE
    scale = {"x": facts.pixel * 100.0, "y": facts.pixel * 100.0, "z": z}
    return {"import_scale": scale, "location_z_cm": (facts.low + facts.high) * 50.0}


def _unity(facts: MapFacts) -> dict[str, object]:
    columns, rows = facts.size
    size = [facts.pixel * (columns - 1), facts.high - facts.low, facts.pixel * (rows - 1)]
    return {"terrain_size": size, "resolution": rows, "flip_vertically": True, "position_y": facts.low}


def _blender(facts: MapFacts) -> dict[str, object]:
    size = [facts.pixel * (side - 1) for side in facts.size]
    codes = {"strength": facts.high - facts.low, "midlevel": 0.0, "colour_space": "Non-Color"}
    return {"plane_size": size, "displace": codes, "displace_of_floats": codes | {"strength": 1.0}}


def _gis(facts: MapFacts) -> dict[str, object]:
    return {"vertical_unit": "metre", "reference": "engineering, no datum; north is up the canvas"}


# Program: what it is told, the sides that it takes (none: any), whether both have to be the same.
TARGETS: dict[str, tuple[Callable[[MapFacts], dict[str, object]], tuple[int, ...], bool]] = {
    "godot": (_godot, (), False),
    "unreal": (_unreal, (127, 253, 505, 1009, 2017, 4033, 8129), False),
    "unity": (_unity, (33, 65, 129, 257, 513, 1025, 2049, 4097), True),
    "blender": (_blender, (), False),
    "gis": (_gis, (), False),
}


def facts_for(target: str, facts: MapFacts) -> dict[str, object]:
    """Returns what is told to a program of TARGETS."""
    row, sides, _ = TARGETS[target]
    out: dict[str, object] = {
        "for": target,
        "file": facts.file,
        "size": list(facts.size),
        "metres_per_pixel": facts.pixel,
        "height_min": facts.low,
        "height_max": facts.high,
        "code_0": facts.low,
        "code_65535": facts.high,
        "rows": "top to bottom, north first",
    }
    if sides:
        out["sides_taken"] = list(sides)
    return out | row(facts) | facts.place


def misfit(target: str, size: tuple[int, int]) -> str:
    """Returns what a program will say of the size, or ""."""
    _, sides, square = TARGETS[target]
    if not sides or (set(size) <= set(sides) and (not square or size[0] == size[1])):
        return ""
    known = ", ".join(map(str, sides))
    return f"found {size[0]} x {size[1]} pixels, {target} takes sides of {known}{', both the same' if square else ''}"
