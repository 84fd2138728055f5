"""Writes NAME.png beside it: squares from inside the bundled example textures, opaque, for brushes that match them.

python palettes/brushes/examples/make_examples.py
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from PIL import Image
from scipy.ndimage import distance_transform_cdt, uniform_filter

HERE = Path(__file__).resolve().parent
PICTURES = HERE.parents[1] / "examples"
SIDE = 112  # pixels
NAMES = {"gravel": "mossy-gravel", "snow": "old-snow", "turf": "turf"}
SPOILT = 8.0  # how much less a square likes to be where it is darker or brighter than the rest


def inside(picture: Image.Image, side: int = SIDE) -> Image.Image:
    """The square that lies farthest inside what is opaque, and is as bright as the rest of it."""
    pixels = np.asarray(picture, np.float32)
    opaque = np.pad(pixels[..., 3] == 255.0, 1)
    depth = distance_transform_cdt(opaque, metric="chessboard")[1:-1, 1:-1].astype(np.float32)
    bright = uniform_filter(pixels[..., :3].mean(-1), side)
    typical = np.median(bright[depth > side // 2])
    y, x = np.unravel_index(
        np.argmax(np.where(depth > side // 2, depth - SPOILT * np.abs(bright - typical), -np.inf)), depth.shape
    )
    left, top = int(x) - side // 2, int(y) - side // 2
    return picture.crop((left, top, left + side, top + side)).convert("RGB")


def main() -> None:
    for name, example in NAMES.items():
        inside(Image.open(PICTURES / f"{example}.png")).save(HERE / f"{name}.png", optimize=True)


if __name__ == "__main__":
    main()
