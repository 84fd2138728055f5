"""Paints valley.jsonl: a lake among mountains, in the brushes "Terrain", on one layer that is seen as land.

python palettes/gallery/make_valley.py
"""

from __future__ import annotations

import itertools
import json
import math
import random
from pathlib import Path
from typing import Any

FOLDER = Path(__file__).resolve().parent
BRUSHES = FOLDER.parent / "brushes"
FRAME = (960, 720)
SEA, SCALE = 0.17, 240.0  # the lake's brightness; pixels from black to white

Points = list[tuple[float, float, float]]


def preset(name: str, **changes: Any) -> dict[str, Any]:
    """A bundled brush as it was when this was painted: those that are another since lie among the scene's."""
    then = FOLDER / "scene" / f"{name}.json"
    path = then if then.exists() else BRUSHES / then.name
    brush: dict[str, Any] = json.loads(path.read_text())["brush"]
    return brush | changes


def stroke(brush: dict[str, Any], points: Points, origin: tuple[int, int] = (0, 0), level: int = 0) -> dict[str, Any]:
    rounded = [[round(v, 2) for v in point] for point in points]
    return {"do": "stroke", "level": level, "origin": list(origin), "brush": brush, "points": rounded}


def along(places: list[tuple[float, float]], press: tuple[float, float], hand: random.Random, shake: float) -> Points:
    """A line through places, a point every 12 pixels, not quite steady, its pressure from one to another."""
    out: Points = []
    for (x0, y0), (x1, y1) in itertools.pairwise(places):
        for k in range(steps := max(1, round(math.dist((x0, y0), (x1, y1)) / 12))):
            out.append((x0 + (x1 - x0) * k / steps, y0 + (y1 - y0) * k / steps, 0.0))
    out.append((*places[-1], 0.0))
    parts = len(out) - 1
    return [
        (x + hand.gauss(0, shake), y + hand.gauss(0, shake), press[0] + (press[1] - press[0]) * k / parts)
        for k, (x, y, _) in enumerate(out)
    ]


def ground() -> list[dict[str, Any]]:
    """The plain, from rim to rim and beyond, so that the land does not end where one looks."""
    brush = preset("plain", radius=150, colour="#323232")
    rows = range(-200, FRAME[1] + 240, 90)
    ends = -220.0, FRAME[0] + 220.0
    points: Points = []
    for k, y in enumerate(rows):
        pair = ends if k % 2 == 0 else ends[::-1]
        points += [(x, float(y), 0.9) for x in pair]
    return [stroke(brush, points)]


RANGE = (
    [(-190, 20), (40, -20), (240, 40), (430, 0)],
    [(430, 0), (600, -50), (820, 0), (1150, -60)],
    [(110, 120), (290, 150), (400, 110)],
    [(640, 90), (800, 140), (960, 90), (1150, 170)],
    [(850, 270), (970, 310), (1140, 290)],
    [(-190, 220), (-40, 290), (20, 370)],
)


def mountains(hand: random.Random) -> list[dict[str, Any]]:
    """Feet, slopes and crests, each narrower and higher than what is below it: one wide stroke would be a mesa."""
    made = []
    for wide, strong, press in ((190, 0.3, (0.8, 1.0)), (115, 0.5, (0.7, 1.0)), (58, 0.62, (0.6, 1.0))):
        brush = preset("mountain", radius=wide, opacity=strong, flow=0.06)
        made += [stroke(brush, along(line, press, hand, 0.12 * wide)) for line in RANGE]
    spur = preset("ridge", radius=44, flow=0.05, opacity=0.5)
    spurs = (
        [(240, 40), (310, 130), (330, 210)],
        [(800, 140), (750, 210), (690, 270)],
        [(20, 320), (110, 360), (170, 410)],
    )
    made += [stroke(spur, along(list(line), (1.0, 0.3), hand, 6)) for line in spurs]
    hill = preset("mountain", radius=110, opacity=0.24, flow=0.05)
    hills = [(110, 560), (240, 640)], [(800, 500), (930, 620)], [(560, 690), (760, 760)]
    return made + [stroke(hill, along(list(line), (0.6, 0.9), hand, 10)) for line in hills]


def lake(hand: random.Random) -> list[dict[str, Any]]:
    bed = preset("river-bed", radius=95, hardness=0, flow=0.08, colour="#141414")
    deep = along([(330, 350), (440, 420), (560, 430), (610, 500), (500, 530), (400, 480)], (0.7, 1.0), hand, 8)
    river = preset("river-bed", radius=26, hardness=0, flow=0.12)
    run = along([(560, 190), (520, 250), (550, 310), (500, 380)], (0.6, 1.0), hand, 3)
    out = along([(560, 540), (640, 600), (650, 680), (720, 800)], (1.0, 1.0), hand, 4)
    return [stroke(river, run), stroke(river, out), stroke(bed, deep)]


def stones(hand: random.Random) -> list[dict[str, Any]]:
    """Boulders on the near shore, a few pixels high."""
    made = []
    for _ in range(30):
        x, y = hand.gauss(430, 90), hand.gauss(632, 26)
        brush = preset("stones", radius=round(hand.uniform(1.2, 4.0), 1), opacity=0.09, hardness=0.2)
        made.append(stroke(brush, [(0, 0, 0.8), (0.5, 0.3, 1.0)], (round(x), round(y))))
    return made


def main() -> None:
    hand = random.Random(16)
    head = {"inkfall": 1, "frame": [0, 0, *FRAME], "seed": 16}
    role = {"do": "layer", "set": "Height", "role": "height", "scale": SCALE, "sea": SEA}
    done = [head, {"do": "layer", "add": "Height"}, *ground(), *mountains(hand), *lake(hand), *stones(hand), role]
    text = "".join(json.dumps(line, separators=(",", ":")) + "\n" for line in done)
    (FOLDER / "valley.jsonl").write_text(text)


if __name__ == "__main__":
    main()
