"""Draws valley.webp: the valley of the gallery as land, seen from above, from its lake, and from beside a rock.

python palettes/pictures/make_valley_views.py
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

VIEWS = "0,480,770,170,0,-15,66", "0,430,680,26,12,-6,60", "2,1650,2560,16,30,-5,60"  # cameras
SIZE = (640, 400)
QUALITY = 82


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        painting, view = str(Path(folder, "valley.ora")), str(Path(folder, "view.png"))
        inkfall(["play", str(FOLDER.parent / "gallery" / "valley.jsonl"), "--save", painting])
        sheet = Image.new("RGB", (SIZE[0], len(VIEWS) * SIZE[1]))
        for k, camera in enumerate(VIEWS):
            inkfall(["terrain", painting, view, "--size", f"{SIZE[0]}x{SIZE[1]}", "--samples", "9", "--camera", camera])
            with Image.open(view) as seen:
                sheet.paste(seen, (0, k * SIZE[1]))
        sheet.save(FOLDER / "valley.webp", quality=QUALITY, method=6)


if __name__ == "__main__":
    main()
