"""Draws following.png: a cottage whose thatch runs down its roof, a lion's mane combed outwards, a burnt letter.

python palettes/pictures/make_following.py
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

FOLDER = Path(__file__).resolve().parent
ROOT = FOLDER.parents[1]
SIZE = 1120, 430

Points = list[list[float]]


def grow(name: str, points: Points, radius: float, **more: Any) -> dict[str, Any]:
    """A stroke with an example that follows it."""
    brush = {"mode": "example", "example": name, "radius": radius, "hardness": 1, "spacing": 0.15, "dynamics": {}}
    return {"do": "stroke", "points": points, "brush": {**brush, "control": {"orientation": "stroke"}, **more}}


def paint(points: Points, radius: float, colour: str, **more: Any) -> dict[str, Any]:
    """A stroke of plain paint."""
    return {"do": "stroke", "points": points, "brush": {"radius": radius, "colour": colour, "dynamics": {}, **more}}


def on(layer: str) -> dict[str, Any]:
    """A layer of its own for what follows."""
    return {"do": "layer", "add": layer}


def cottage() -> list[dict[str, Any]]:
    """Walls, and a roof from ridge to eaves, stroke beside stroke."""
    found = [on("walls")]
    found += [paint([[70, y], [330, y]], 12, "#d9d0bd", hardness=1) for y in range(250, 400, 12)]
    found += [paint([[x, 262], [x, 400]], 5, "#5b4231", hardness=1) for x in (70, 158, 246, 331)]
    found += [paint([[188, 330], [188, 398]], 17, "#6d4a30", hardness=1)]
    found += [paint([[x, 316], [x + 1, 316]], 15, "#33424d", hardness=1) for x in (112, 288)]
    found += [on("roof")]
    for k in range(13):
        top, foot = 92 + 17.5 * k, 32 + 27.5 * k
        bow = [[top + (foot - top) * t**1.35, 92 + 176 * t] for t in np.linspace(0.0, 1.0, 12)]
        found.append(grow("thatch", bow, 19))
    return [*found, grow("thatch", [[84, 96], [200, 84], [310, 96]], 13, depth=1)]


def lion() -> list[dict[str, Any]]:
    """The mane from within outwards, then ears and face, combed from the nose."""
    found, x, y = [on("mane")], 566.0, 222.0
    for reach, wide in ((146, 22), (116, 20)):
        for t in np.linspace(0.0, 2.0 * np.pi, 25)[:-1] + (0.13 if wide < 22 else 0.0):
            far = reach * (1.0 + 0.06 * np.sin(5.0 * t))
            bow = [[x + r * np.cos(t + 0.002 * r), y + r * np.sin(t + 0.002 * r)] for r in np.linspace(50.0, far, 7)]
            found.append(grow("fur", bow, wide))
    found += [grow("fur", [[x + a, y - 62], [x + 1.5 * a, y - 96]], 20, depth=1) for a in (-52, 52)]
    for t in np.linspace(0.0, 2.0 * np.pi, 15)[:-1]:
        found.append(
            grow("fur", [[x + r * np.cos(t), y + 18 + 1.1 * r * np.sin(t)] for r in (6.0, 30.0, 64.0)], 15, depth=2)
        )
    found.append(on("face"))
    for a in (-30, 30):
        found += [
            paint([[x + a, y - 12], [x + a + 1, y - 12]], 8.5, "#f3e6c4"),
            paint([[x + a, y - 11]], 5.0, "#1c1310"),
        ]
        found.append(paint([[x, y + 40], [x + 0.2 * a, y + 56], [x + 0.75 * a, y + 60]], 2.6, "#2a1610", hardness=0.8))
        found += [paint([[x + 0.5 * a, y + 38 + k], [x + 2.3 * a, y + 30 + 3 * k]], 0.9, "#fbf1da") for k in (0, 6, 12)]
    found += [
        paint([[x - 9, y + 24], [x + 9, y + 24]], 4.5, "#2a1610"),
        paint([[x, y + 24], [x, y + 31]], 5.0, "#2a1610"),
    ]
    return found


def letter() -> list[dict[str, Any]]:
    """Burnt, and what is left of the writing."""
    found = [on("letter")]
    for row in (110, 190, 270, 330):
        found.append(grow("burnt", [[850, row], [1010, row - 6]], 74, control={}))
    found.append(
        {
            "do": "stroke",
            "points": [[1086, 150], [1090, 158]],
            "brush": {"mode": "erase", "radius": 34, "hardness": 1, "dynamics": {}},
        }
    )
    found.append(on("writing"))
    for k, row in enumerate(range(128, 330, 26)):
        ends = 836 + 5 * (k % 3), 1012 - 17 * (k % 4)
        xs = np.arange(*ends, 3.0)
        wave = 4.0 * np.sin(xs * 0.55) * (0.5 + 0.5 * np.sin(xs * 0.131 + k)) + 1.5 * np.sin(xs * 0.21 + 2 * k)
        found.append(
            paint([[float(a), float(row + b)] for a, b in zip(xs, wave, strict=True)], 1.5, "#4a2f1c", opacity=0.75)
        )
    return found


def main() -> None:
    """Plays the recording and writes the picture."""
    told: list[dict[str, Any]] = [{"inkfall": 2, "frame": [0, 0, *SIZE], "seed": 11, "paper": "#c8d3cd"}]
    for name, bundled in (("thatch", "thatch"), ("fur", "fur"), ("burnt", "burnt-paper")):
        told.append({"do": "texture", "name": name, "maker": "example", "bundled": bundled})
    told += [*cottage(), *lion(), *letter()]
    with tempfile.TemporaryDirectory() as folder:
        recording, made = Path(folder) / "a.jsonl", Path(folder) / "a.png"
        recording.write_text("\n".join(map(json.dumps, told)) + "\n")
        subprocess.run([sys.executable, "-m", "app", "play", recording, "--png", made], cwd=ROOT, check=True)
        picture = Image.open(made).convert("RGB")
        picture.quantize(256, dither=Image.Dither.FLOYDSTEINBERG).save(FOLDER / "following.png", optimize=True)


if __name__ == "__main__":
    main()
