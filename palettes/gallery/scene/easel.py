"""The easel: touches of the bundled brushes become commands of a recording.

The picture is 500 x 500 units; a touch is painted `fine` levels below level 0, so that its edges stay crisp to there.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

Point = tuple[float, ...]  # x, y and perhaps pressure

SIZE = 500
BRUSHES = Path(__file__).resolve().parents[2] / "brushes"
_PARTS = ("density", "tip")  # of a brush, whose textures are in pixels of the stroke's level


@cache
def _preset(name: str) -> dict[str, Any]:
    """Returns a bundled brush as it was when this was painted: those that are another since lie beside this file."""
    file = f"{name.lower().replace(' ', '-')}.json"
    then = Path(__file__).with_name(file)
    told: dict[str, Any] = json.loads((then if then.exists() else BRUSHES / file).read_text("utf-8"))
    told["brush"].pop("fixed", None)  # textures lay on the canvas
    return told


@dataclass
class Easel:
    """Collects the commands; a texture is defined when a brush first needs it."""

    lines: list[dict[str, Any]] = field(default_factory=list)
    points: int = 0
    _defined: set[str] = field(default_factory=set)

    def layer(self, name: str, **settings: Any) -> None:
        """A new layer on top, which becomes the one that is painted on."""
        self.lines.append({"do": "layer", "add": name})
        if settings:
            self.lines.append({"do": "layer", "set": name, **settings})

    def lock(self, name: str) -> None:
        """From now on the layer's outline stays as it is: what is painted on it models the form."""
        self.lines.append({"do": "layer", "set": name, "alpha_locked": True})

    def touch(self, brush: str, points: Sequence[Point], fine: int = 1, **more: Any) -> None:
        """One stroke of a bundled brush with other settings, `radius` and periods in units of the picture.

        `tints`: other colours of the ink's textures, by their names; `periods`: other periods of all its textures;
        `seed`: of the stroke.
        """
        preset = _preset(brush)
        for definition in preset.get("textures", []):
            if definition["name"] not in self._defined:
                self._defined.add(definition["name"])
                self.lines.append({"do": "texture", **definition})
        made = _sized(preset["brush"] | _settings(more), 2**fine, more)
        corner = [math.floor(v * 2**fine) for v in points[0][:2]]
        line = {"do": "stroke", "level": fine, "origin": corner, "brush": made}
        if "seed" in more:
            line["seed"] = more["seed"]
        line["points"] = [_placed(point, corner, 2**fine) for point in points]
        self.points += len(points)
        self.lines.append(line)


def _settings(more: Mapping[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in more.items() if name not in ("tints", "periods", "seed")}


def _sized(brush: dict[str, Any], scale: int, more: Mapping[str, Any]) -> dict[str, Any]:
    tints, periods = more.get("tints", {}), more.get("periods", {})

    def scaled(part: dict[str, Any]) -> dict[str, Any]:
        name = part["texture"]
        colour = {"colour": tints[name]} if name in tints else {}
        return {**part, **colour, "period": round(periods.get(name, part.get("period", 32)) * scale)}

    made = {**brush, "radius": round(brush["radius"] * scale, 2)}
    if made.get("ink"):
        made["ink"] = [scaled(part) for part in made["ink"]]
    for name in _PARTS:
        if made.get(name):
            made[name] = {key: value for key, value in scaled(made[name]).items() if key != "colour"}
    return {name: value for name, value in made.items() if value is not None}


def _placed(point: Point, corner: Sequence[int], scale: int) -> list[float]:
    x, y = (round(p * scale - c, 1) for p, c in zip(point, corner, strict=False))
    return [x, y, round(point[2], 2)] if len(point) > 2 and point[2] < 0.995 else [x, y]
