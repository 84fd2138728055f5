"""Draws village.webp: the village of the gallery, and six zooms into it, from a row of houses to a door's keyhole.

python palettes/pictures/make_village_views.py
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from PIL import Image

FOLDER = Path(__file__).resolve().parent
ROOT = FOLDER.parents[1]
sys.path.insert(0, str(ROOT))

from app.__main__ import main as inkfall  # noqa: E402

AT = 438.8, 538.4  # the handle of a door
LEVELS = (1, 2, 3, 4, 6, 7)
SIZE, WHOLE = (320, 200), (960, 600)
QUALITY = 84


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        painting, view = str(Path(folder, "village.ora")), str(Path(folder, "view.png"))
        inkfall(["play", str(FOLDER.parent / "gallery" / "village.jsonl"), "--save", painting, "--png", view])
        sheet = Image.new("RGB", (WHOLE[0], WHOLE[1] + 2 * SIZE[1]))
        with Image.open(view) as seen:
            sheet.paste(seen.convert("RGB").resize(WHOLE, Image.Resampling.LANCZOS))
        for k, level in enumerate(LEVELS):
            corner = [round(at * 2**level) - size // 2 for at, size in zip(AT, SIZE, strict=True)]
            inkfall(["export", painting, view, "--rect", ",".join(map(str, (level, *corner, *SIZE)))])
            with Image.open(view) as seen:
                sheet.paste(seen.convert("RGB"), (k % 3 * SIZE[0], WHOLE[1] + k // 3 * SIZE[1]))
        sheet.save(FOLDER / "village.webp", quality=QUALITY, method=6)


if __name__ == "__main__":
    main()
