"""Writes the bundled example textures: NAME.png, and NAME.mask.png where the region is more than alpha > 0.

    python palettes/examples/make/make_examples.py [NAME ...] [--into FOLDER]

Everything is made from seeds; needs scipy and scikit-image beside the program.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import beach
import cloth
import coats
import crusts
import marks
import numpy as np
import orange
import paper
import plants
import stone
import variegated
import watercolour
import weather
from PIL import Image

FOLDER = Path(__file__).resolve().parents[1]
SUBJECTS = (watercolour, variegated, marks, paper, orange, crusts, stone, plants, weather, cloth, coats, beach)
EXAMPLES = {name: make for subject in SUBJECTS for name, make in subject.EXAMPLES.items()}


def write(name: str, folder: Path) -> None:
    """Make one example and write its files."""
    ground, rgb, alpha = EXAMPLES[name]()
    picture, region = ground.finished(rgb, alpha)
    Image.fromarray(picture, "RGBA").save(folder / f"{name}.png", optimize=True)
    mask = folder / f"{name}.mask.png"
    mask.unlink(missing_ok=True)
    if not np.array_equal(picture[..., 3] > 0, region):
        Image.fromarray(region).save(mask, optimize=True)


def main(words: list[str]) -> None:
    arguments = argparse.ArgumentParser(description="Write the bundled example textures.")
    arguments.add_argument("names", nargs="*", help="which; all of them by default")
    arguments.add_argument("--into", type=Path, default=FOLDER, help="the folder to write to")
    given = arguments.parse_args(words)
    for name in given.names or EXAMPLES:
        write(name, given.into)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
