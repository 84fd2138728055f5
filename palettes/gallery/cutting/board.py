"""The board on which pieces are laid: touches become strokes, in commands of a recording."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from cutting.shapes import Spot, Touch, filling


class Board:
    """Collects the commands; an example is defined when it is first used."""

    def __init__(self, width: int, height: int) -> None:
        self.size = (width, height)
        self.lines: list[dict[str, Any]] = [{"inkfall": 1, "frame": [0, 0, width, height], "seed": 7}]
        self._defined: set[str] = set()

    def layer(self, name: str, **settings: Any) -> None:
        """A new layer on top, which becomes the one that is painted on."""
        self.lines.append({"do": "layer", "add": name})
        if settings:
            self.lines.append({"do": "layer", "set": name, **settings})

    def grow(
        self, example: str, outlines: Sequence[Sequence[Spot]], depth: int = 0, seed: int = 0, level: int = 0
    ) -> None:
        """One stroke that fills outlines with a bundled example; those that overlap become one piece.

        At level 1 the example is half as large in the picture.
        """
        if example not in self._defined:
            self._defined.add(example)
            self.lines.append({"do": "texture", "name": example, "maker": "example", "bundled": example})
        touches = [touch for outline in outlines for touch in filling(outline, self.size)]
        how = {"mode": "example", "example": example, "depth": depth, "hardness": 1, "spacing": 0.15}
        how |= {"example_level": level} if level else {}
        self._stroke(touches, how, seed)

    def soft(self, path: Sequence[Spot] | Touch, radius: float, colour: str, opacity: float, **more: Any) -> None:
        """One ordinary soft stroke."""
        points = [(*p[:2], radius * (p[2] if len(p) > 2 else 1.0)) for p in path]
        how = {"hardness": 0, "spacing": 0.12, "colour": colour, "opacity": opacity} | more
        self._stroke([points], how)

    def _stroke(self, touches: Sequence[Touch], how: dict[str, Any], seed: int = 0) -> None:
        top = max(place[2] for touch in touches for place in touch)
        path = [place for touch in touches for place in (_lifted(touch) if len(touches) > 1 else touch)]
        left, above = (math.floor(v) for v in path[0][:2])
        brush = {"radius": round(top, 1), "dynamics": {"radius": "pressure"}} | how
        points = [[_short(x - left), _short(y - above), _short(r / top, 3)] for x, y, r in path]
        line = {"do": "stroke", "level": 0, "origin": [left, above], "brush": brush, "points": points}
        self.lines.append(line | ({"seed": seed} if seed else {}))


def _short(value: float, digits: int = 1) -> float:
    rounded = round(value, digits)
    return int(rounded) if rounded == int(rounded) else rounded


def _lifted(touch: Touch) -> Touch:
    """The touch with the pen lifted before and after it."""
    return [(*touch[0][:2], 0.0), *touch, (*touch[-1][:2], 0.0)]
