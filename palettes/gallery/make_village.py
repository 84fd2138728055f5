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
VAPOUR: dict[str, Any] = {
    "flow": 0.2,
    "hardness": 0,
    "shape": {"ratio": 0.62, "scatter": 1.1, "count": 3},
    "dynamics": {"radius": "pressure"},
}
LOW = 0.2, 0.5, 0.9, 0.7, 1.0, 0.8, 0.45, 0.6, 0.4, 0.25, 0.3, 0.1, 0.1  # humps of clouds, from left to right
TOWERING = 0.1, 0.3, 0.15, 0.1, 0.35, 0.5, 0.4, 0.8, 1.0, 0.75, 0.95, 0.6, 0.4
VEIL = 0.5, 0.9, 1.0, 0.6, 0.4, 0.7, 0.9, 0.5, 0.3, 0.2
Points = list[tuple[float, float, float]]
GENERATORS = ("wood", "village", "path", "stone-wall", "hedge", "meadow", "trees")
BLADES = {"do": "texture", "name": "grass", "maker": "expression", "bundled": "grass", "period": 40}


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
    """A stroke of a generator, as thick as it is pressed, with houses of its own."""
    ink = [{"texture": name, **({"values": values} if values else {})}]
    brush = {"mode": "generate", "radius": radius, "spacing": 0.1, "ink": ink, "dynamics": {"radius": "pressure"}}
    return {"do": "stroke", "layer": layer, "points": points, "brush": brush, "seed": round(points[0][0])}


def soft(layer: str, points: Points, radius: float, colour: str, opacity: float) -> dict[str, Any]:
    """A stroke of light or shade over the hills."""
    return brushed(layer, points, radius, colour, hardness=0, opacity=opacity, flow=0.5)


def heap(x: float, y: float, wide: float, high: float, ends: tuple[float, float], humps: tuple[float, ...]) -> Points:
    """A line over which a cloud heaps up: `ends`: which parts of it rise at the left and fall at the right."""
    places = []
    for k, hump in enumerate(humps):
        t = k / (len(humps) - 1)
        swell = min(1.0, t / ends[0]) ** 0.6 * min(1.0, (1 - t) / ends[1]) ** 0.9
        places.append((x + wide * t, y - high * swell * hump, 0.08 + 0.92 * swell * (0.3 + 0.7 * hump)))
    return line(*places)


def cloud(points: Points, radius: float) -> list[dict[str, Any]]:
    """A heaped cloud: its shaded base, its body, and its lit tops."""
    layers = (0.3, 0.95, "#b9c3cf", 0.42), (0.0, 1.0, "#f1eae2", 0.55), (-0.36, 0.66, "#fff8ec", 0.62)
    return [
        brushed(
            "Sky",
            [(x - 0.1 * radius, y + rise * radius * p, p) for x, y, p in points],
            radius * size,
            colour,
            opacity=opacity,
            **VAPOUR,
        )
        for rise, size, colour, opacity in layers
    ]


def sky() -> list[dict[str, Any]]:
    ramp = [[0, "#5489c4"], [0.4, "#8fb6da"], [0.72, "#d5dfde"], [1, "#f7e3bd"]]
    blue = {"do": "texture", "name": "morning", "maker": "gradient", "from": [0, 0], "to": [0, 330], "ramp": ramp}
    wide = brushed("Sky", [(-300.0, 240.0, 1.0), (1580.0, 240.0, 1.0)], 340, "#9fc0dc", ink=[{"texture": "morning"}])
    veils = (
        heap(560, 206, 330, 14, (0.6, 0.3), VEIL),
        heap(150, 246, 300, 8, (0.2, 0.7), VEIL[::-1]),
        heap(980, 242, 330, 8, (0.4, 0.4), VEIL),
        heap(430, 268, 420, 6, (0.3, 0.6), VEIL[::-1]),
    )
    return [
        blue,
        wide,
        *cloud(heap(70, 152, 470, 62, (0.2, 0.8), LOW), 46),
        *cloud(heap(800, 118, 560, 58, (0.75, 0.1), TOWERING), 50),
        *cloud(heap(704, 142, 130, 16, (0.4, 0.5), (0.3, 0.8, 1, 0.5, 0.6, 0.2)), 19),
        *(brushed("Sky", veil, 15, "#fbf0e0", opacity=0.42, **VAPOUR) for veil in veils),
    ]


def hills() -> list[dict[str, Any]]:
    far = line((-120, 372, 1), (150, 340, 1), (420, 362, 1), (760, 326, 1), (1060, 352, 1), (1420, 318, 1))
    middle = line((-150, 452, 1), (160, 436, 1), (400, 452, 1), (860, 452, 1), (1120, 424, 1), (1450, 436, 1))
    hill = line(
        (-160, 800, 1), (180, 640, 1), (420, 520, 1), (640, 474, 1), (850, 520, 1), (1090, 640, 1), (1450, 790, 1)
    )
    rock = {"texture": "rock", "amount": 0.5, "period": 90}
    blades = [{"texture": "grass", "amount": 0.34, "fixed": True}, {**rock, "colour": "#a9b45c"}]
    fields = (
        (line((20, 436, 0.2), (130, 424, 0.9), (300, 430, 0.2)), "#d3bf78"),
        (line((960, 420, 0.2), (1080, 402, 0.9), (1230, 408, 0.2)), "#cdb873"),
        (line((1080, 436, 0.2), (1190, 428, 0.8), (1320, 432, 0.6)), "#b7a562"),
    )
    pressed = {"dynamics": {"radius": "pressure"}}
    low = [(x, max(y + 260, 820), p) for x, y, p in hill]
    return [
        brushed("Far", far, 46, "#93abbb", hardness=0.9, ink=[{**rock, "amount": 0.3, "colour": "#aabfca"}]),
        brushed("Far", [(x, y + 70, p) for x, y, p in far], 70, "#8fa9a6", hardness=0.5),
        brushed("Far", middle, 62, "#829c72", hardness=0.9, ink=[{**rock, "colour": "#a3b383"}]),
        brushed(
            "Far",
            [(x, y + 90, p) for x, y, p in middle],
            90,
            "#78965c",
            hardness=0.7,
            ink=[{**rock, "colour": "#9cae6c"}],
        ),
        *(brushed("Far", points, 17, colour, hardness=0.6, opacity=0.75, **pressed) for points, colour in fields),
        soft("Far", line((-60, 470, 1), (300, 470, 1), (1000, 462, 1), (1340, 470, 1)), 60, "#e6dcb4", 0.4),
        brushed("Hill", hill, 172, "#6f8d3e", hardness=0.95, ink=blades),
        brushed("Hill", low, 240, "#5d7a36", hardness=0.8, ink=blades[1:]),
        soft("Hill", line((180, 520, 1), (330, 430, 1), (520, 352, 1)), 90, "#e9dd84", 0.42),
        soft("Hill", line((830, 350, 1), (980, 450, 1), (1160, 580, 1)), 100, "#26452f", 0.34),
        soft("Hill", line((150, 640, 1), (460, 610, 1), (600, 600, 1)), 60, "#e4d87e", 0.3),
        soft("Hill", line((-60, 800, 1), (500, 790, 1), (1340, 800, 1)), 100, "#24401f", 0.45),
    ]


def village() -> list[dict[str, Any]]:
    """The strokes of generators: from the back to the front."""
    way = line(
        (690, 352, 0.1), (800, 420, 0.16), (600, 480, 0.23), (690, 590, 0.37), (560, 690, 0.58), (660, 840, 0.85)
    )
    field = line(
        (-40, 780, 1), (180, 750, 1), (370, 752, 1), (490, 800, 1), (590, 910, 1), (740, 910, 1), (840, 800, 1),
        (930, 766, 1), (1130, 786, 1), (1320, 800, 1),
    )  # fmt: skip
    left = line(
        (620, 410, 0.47), (420, 430, 0.51), (250, 500, 0.6), (330, 556, 0.7), (430, 566, 0.74), (560, 550, 0.79)
    )
    right = line((806, 426, 0.47), (930, 456, 0.51), (980, 510, 0.6), (900, 580, 0.7), (760, 574, 0.79))
    far = line((-30, 412, 0.33), (330, 416, 0.31), (930, 404, 0.31), (1310, 396, 0.35))
    return [
        placed("Woods", "wood", 97, far, firs=0.6),
        placed("Top", "wood", 130, line((940, 452, 0.3), (1050, 500, 0.4), (1230, 580, 0.5)), firs=0.3),
        placed("Path", "path", 97, way),
        placed("Houses", "village", 97, line((540, 344, 0.35), (640, 320, 0.39), (760, 336, 0.37))),
        placed("Houses", "village", 97, left),
        placed("Houses", "village", 97, right),
        placed("Walls", "stone-wall", 50, line((770, 652, 0.8), (880, 658, 0.85), (1000, 682, 0.95), (1120, 730, 1))),
        placed("Front", "hedge", 56, line((1000, 622, 0.8), (1120, 655, 0.95), (1270, 712, 1)), bloom=0.4),
        placed("Front", "meadow", 97, field, flowery=0.8),
        placed("Front", "trees", 150, line((96, 784, 1), (116, 782, 1)), many=1, season=0.2),
    ]


def main() -> None:
    names = "Sky", "Far", "Woods", "Hill", "Top", "Path", "Houses", "Walls", "Front"
    commands = [
        {"inkfall": 2, "frame": [0, 0, *FRAME], "seed": SEED},
        *({"do": "texture", "name": name, "maker": "expression", "bundled": name} for name in GENERATORS),
        BLADES,
        *({"do": "layer", "add": name} for name in names),
        *sky(), *hills(), *village(),
    ]  # fmt: skip
    (FOLDER / "village.jsonl").write_text("".join(json.dumps(command) + "\n" for command in commands), "utf-8")


if __name__ == "__main__":
    main()
