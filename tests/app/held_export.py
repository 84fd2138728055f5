"""The program whose exports wait within their rows until a file `leave` is there: `python -m held_export`."""

import sys
import time
from pathlib import Path

from app.__main__ import main
from engine.archive.export import FORMATS

PNG = FORMATS[".png"]


def held(file, size, depth, rows):
    def waiting():
        for strip in rows:
            yield strip
            while not Path("leave").exists():
                time.sleep(0.01)

    PNG(file, size, depth, waiting())


if __name__ == "__main__":
    FORMATS[".png"] = held
    sys.exit(main())
