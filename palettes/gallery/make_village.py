"""Paints village.jsonl: a village on a hill, sketched in broad strokes by generators.

python palettes/gallery/make_village.py
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).resolve().parent
FRAME = (1280, 800)
SEED = 5
Points = list[tuple[float, float, float]]
GENERATORS = ("houses", "trees", "conifers", "hedge", "meadow", "reeds", "fence", "stone-wall", "path", "stones")


def line(*places: tuple[float, float, float]) -> Points:
    """A smooth line through places, with their pressures: a point every 10 pixels."""
    out: Points = []
    padded = [places[0], *places, places[-1]]
    for a, b, c, d in zip(padded, padded[1:], padded[2:], padded[3:], strict=False):
        steps = max(1, round(math.dist(b[:2], c[:2]) / 10))
        for k in range(steps):
            out.append(_between((a, b, c, d), k / steps))
    return [*out, places[-1]]


def _between(four: tuple[tuple[float, float, float], ...], t: float) -> tuple[float, float, float]:
    """A place on the curve of Catmull and Rom."""
    weights = -t + 2 * t**2 - t**3, 2 - 5 * t**2 + 3 * t**3, t + 4 * t**2 - 3 * t**3, t**3 - t**2
    x, y, press = (sum(w * p[n] for w, p in zip(weights, four, strict=True)) / 2 for n in range(3))
    return round(x, 2), round(y, 2), round(min(press, 1.0), 3)


def brushed(layer: str, points: Points, radius: float, colour: str, **more: Any) -> dict[str, Any]:
    """A stroke of paint."""
    brush = {"radius": radius, "colour": colour, "hardness": 0.3, "dynamics": {}, **more}
    return {"do": "stroke", "layer": layer, "points": points, "brush": brush}


def placed(layer: str, name: str, radius: float, points: Points, **values: float) -> dict[str, Any]:
    """A stroke of a generator, as thick as it is pressed."""
    ink = [{"texture": name, **({"values": values} if values else {})}]
    brush = {"mode": "generate", "radius": radius, "spacing": 0.1, "ink": ink, "dynamics": {"radius": "pressure"}}
    return {"do": "stroke", "layer": layer, "points": points, "brush": brush}


def sky() -> list[dict[str, Any]]:
    ramp = [[0, "#6b9aca"], [0.35, "#9fc0dc"], [0.7, "#e2e2d6"], [1, "#f3e2c0"]]
    blue = {"do": "texture", "name": "dusk", "maker": "gradient", "from": [0, 0], "to": [0, 430], "ramp": ramp}
    wide = brushed("Sky", [(-300.0, 240.0, 1.0), (1580.0, 240.0, 1.0)], 340, "#9fc0dc", ink=[{"texture": "dusk"}])
    veil = {"opacity": 0.55, "flow": 0.25, "hardness": 0, "shape": {"ratio": 0.5, "scatter": 0.9, "count": 2}}
    clouds = line((90, 165, 1), (330, 140, 1), (560, 168, 1)), line((740, 95, 1), (980, 78, 1), (1230, 110, 1))
    return [blue, wide, *(brushed("Sky", points, 34, "#fbf4e8", **veil) for points in clouds)]


def hills() -> list[dict[str, Any]]:
    far = line((-120, 470, 1), (160, 420, 1), (420, 452, 1), (760, 400, 1), (1080, 440, 1), (1420, 400, 1))
    near = line((-160, 760, 1), (180, 650, 1), (560, 580, 1), (900, 600, 1), (1200, 690, 1), (1450, 720, 1))
    ink = [{"texture": "rock", "amount": 0.55, "colour": "#a8b878", "period": 120}]
    grass = [{"texture": "rock", "amount": 0.6, "colour": "#93a850", "period": 70}]
    return [
        brushed("Hills", far, 70, "#7f9a9c", hardness=0.85, ink=ink),
        brushed("Hills", [(x, y + 110, p) for x, y, p in far], 90, "#7a9468", hardness=0.6, ink=ink),
        brushed("Hills", near, 130, "#5f7f3a", hardness=0.93, ink=grass),
        brushed("Hills", [(x, y + 190, p) for x, y, p in near], 150, "#557436", hardness=0.8, ink=grass),
    ]


def village() -> list[dict[str, Any]]:
    """The ten-odd strokes: from the back to the front."""
    return [
        placed("Woods", "conifers", 42, line((20, 452, 0.7), (180, 428, 0.8), (330, 436, 0.9), (440, 452, 0.8))),
        placed("Woods", "conifers", 42, line((900, 432, 0.7), (1040, 420, 0.8), (1180, 438, 0.9), (1290, 420, 1))),
        placed("Houses", "houses", 62, line((470, 494, 0.66), (600, 470, 0.7), (740, 474, 0.74), (880, 500, 0.72))),
        placed("Trees", "trees", 54, line((400, 520, 0.8), (452, 508, 0.7)), many=1),
        placed("Trees", "trees", 56, line((905, 520, 0.9), (985, 532, 1), (1060, 556, 1)), season=0.35),
        placed("Lower", "houses", 92, line((330, 604, 0.84), (520, 566, 0.86), (700, 574, 0.92), (830, 596, 0.9))),
        placed("Path", "path", 72, line((640, 606, 0.22), (690, 660, 0.42), (640, 730, 0.65), (700, 830, 1))),
        placed("Walls", "stone-wall", 58, line((735, 650, 0.8), (850, 645, 0.85), (980, 672, 0.9), (1110, 716, 1))),
        placed("Walls", "fence", 60, line((90, 700, 1), (250, 676, 0.95), (400, 658, 0.9), (560, 662, 0.9))),
        placed("Front", "hedge", 58, line((1010, 640, 0.85), (1130, 660, 0.95), (1260, 700, 1))),
        placed("Front", "meadow", 96, line((-40, 770, 1), (200, 744, 1), (430, 742, 1), (560, 772, 1)), flowery=0.8),
        placed("Front", "meadow", 96, line((800, 782, 1), (960, 770, 1), (1150, 790, 1), (1320, 800, 1)), flowery=0.6),
        placed("Front", "stones", 60, line((770, 712, 0.7), (860, 730, 0.9), (960, 748, 1))),
        placed("Front", "trees", 150, line((120, 780, 1), (150, 776, 1)), many=1, season=0.2),
        placed("Front", "reeds", 80, line((1080, 800, 1), (1180, 796, 1), (1300, 806, 1))),
    ]


def main() -> None:
    names = "Sky", "Hills", "Woods", "Houses", "Trees", "Lower", "Path", "Walls", "Front"
    commands = [
        {"inkfall": 2, "frame": [0, 0, *FRAME], "seed": SEED},
        *({"do": "texture", "name": name, "maker": "expression", "bundled": name} for name in GENERATORS),
        *({"do": "layer", "add": name} for name in names),
        *sky(), *hills(), *village(),
    ]  # fmt: skip
    (FOLDER / "village.jsonl").write_text("".join(json.dumps(command) + "\n" for command in commands), "utf-8")


if __name__ == "__main__":
    main()
