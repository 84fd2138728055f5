"""Draws solids.webp: a still life of solids, by rays and without a graphics card.

python palettes/pictures/make_solids.py
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from PIL import Image

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parents[1]))

from engine.solids.objects import object_named  # noqa: E402
from engine.solids.solid_lookup import Procedural  # noqa: E402
from engine.solids.solid_rendering import Arrangement, Body, framed, turning  # noqa: E402

SIZE, SAMPLES = (1200, 640), 3


def scene() -> Arrangement:
    """A vase, a bust, a teapot and what lies before them."""
    green = Procedural("marble", 5, {"green": 1.0, "veins": 3.0, "turbulence": 1.1})
    things = (
        ("vase", Procedural("wood", 3), (20.0, 0.0), 1.16, (-1.75, 0.55), 0.40),
        ("bust", Procedural("marble", 2, {"turbulence": 1.0}), (-14.0, 0.0), 1.30, (0.0, 0.95), 0.52),
        ("teapot", Procedural("agate", 3), (-28.0, 0.0), 1.06, (1.72, 0.35), 0.42),
        ("sphere", green, (40.0, 20.0), 0.46, (-0.78, -0.62), 0.36),
        ("knot", Procedural("granite", 1), (15.0, 0.0), 0.54, (0.42, -0.72), 0.36),
        ("cube", Procedural("wood", 11, {"rings": 40.0}), (31.0, 0.0), 0.30, (-1.72, -0.85), 0.30),
        ("torus", Procedural("agate", 12), (0.0, 0.0), 0.46, (1.5, -0.95), 0.40),
    )
    bodies = []
    for name, solid, turn, size, (x, y), scale in things:
        bodies.append(Body(object_named(name), solid, turning(*turn), size, (x, y, 0.0), scale).standing())
    whole = framed(bodies)
    return Arrangement(bodies, whole.target + np.array((0.0, 0.0, -0.12)), whole.reach * 0.64)


def main() -> None:
    pixels = scene().picture(SIZE, SAMPLES)
    Image.fromarray(pixels).save(FOLDER / "solids.webp", quality=88, method=6)


if __name__ == "__main__":
    main()
