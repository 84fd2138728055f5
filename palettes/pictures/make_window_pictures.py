"""Draws the README's pictures of the window: a painting of the gallery opened in it, with what the picture shows.

python palettes/pictures/make_window_pictures.py [NAME...]    all, or those of these names

Needs Xvfb and xdotool; a painting's recording is played first, which takes up to some minutes.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from PIL import Image

FOLDER = Path(__file__).resolve().parent
ROOT = FOLDER.parents[1]
sys.path[:0] = [str(ROOT), str(ROOT / "tests" / "app")]

from driven import Program  # noqa: E402
from xserver import need, started_screen  # noqa: E402

from app.__main__ import main as inkfall  # noqa: E402

QUALITY = 88
PREPARED = 900.0  # seconds until all brushes have their pictures, at most
CALM = 4.0  # seconds for which nothing changes once all is drawn
BRIGHT = 100  # of 255: paper, on the average
WHOLE = 60  # notches from one end of a list to the other, at least
EARTH, ROSE, WATER = "#c2703d", "#c9506e", "#4f7f96"
PAINTED = ((0.27, 0.26), (0.3, 0.23), (0.36, 0.21)), ((0.62, 0.3), (0.68, 0.34), (0.72, 0.4))  # strokes of a spectrum

Act = Callable[[Program], None]


def calm(app: Program, seconds: float = PREPARED) -> np.ndarray:
    """The screen once nothing has changed for a while."""
    end = time.monotonic() + seconds
    seen, since = app.settled(seconds), time.monotonic()
    while time.monotonic() < since + CALM:
        time.sleep(0.2)
        if not np.array_equal(now := app.settled(seconds), seen):
            seen, since = now, time.monotonic()
        if time.monotonic() > end:
            raise SystemExit("the window does not come to rest")
    return seen


def prepared(app: Program) -> None:
    """Waits until all brushes have their pictures."""
    end = time.monotonic() + PREPARED
    while "all brushes ready" not in app.log.read_text():
        if time.monotonic() > end:
            raise SystemExit("not all brushes get ready")
        time.sleep(0.5)


def lower(app: Program, edge: str, pixels: int) -> None:
    """Drags the edge below a panel."""
    x, y = app.at(edge)
    app.drag((x, y), (x, y + pixels))
    app.do("mouseup", 1)


def scroll(app: Program, over: str, notches: int) -> None:
    app.move_to(app.at(over))
    app.wheel(notches)
    app.until_rest()


def without(app: Program, panel: str) -> None:
    """Hides a panel."""
    app.move_to(app.at(panel))
    app.do("mousedown", 3)
    app.do("mouseup", 3)
    app.click("Hide")


def coloured(app: Program, colour: str) -> None:
    """Takes a colour, and the palette of what is in view."""
    app.click("hex")
    app.fill(colour)
    app.keys("Return")
    app.click("make palette")
    app.click("What is in view")
    app.box("swatch 12")


def lab(app: Program) -> None:
    """A wedge of the spectrum with strokes in it, and the brush pen with what it makes."""
    coloured(app, EARTH)
    lower(app, "below brushes", 84)
    lower(app, "below ink", 26)
    lower(app, "below colour", 24)
    scroll(app, "Dry bristle", -5)
    app.click("Brush pen")
    app.keys("l")
    app.click("Wedge")
    for stroke in PAINTED:
        app.stroke(*(app.at("spectrum", *point) for point in stroke))
    app.click("Use as ink")
    scroll(app, "picture of Sun", -WHOLE)


def examples(app: Program) -> None:
    """The palette of examples, one of which is chosen."""
    coloured(app, ROSE)
    without(app, "Ink mixer")
    lower(app, "below colour", 24)
    app.keys("p")
    app.wait_for("examples ready")
    app.click("Wash rose")
    scroll(app, "Stabiliser", -4)
    (left, bottom, *_), right = app.box("Painting", "strip"), app.box("Swap")[2]
    stroke = slice(bottom - 200, bottom - 20), slice(left + 20, right - 20)
    app.until(lambda screen: bool(screen[stroke].mean() > BRIGHT), seconds=PREPARED)  # it has grown


def light(app: Program) -> None:
    """Without the ink mixer, brushes and layers with more room."""
    coloured(app, WATER)
    without(app, "Ink mixer")
    lower(app, "below colour", 30)
    lower(app, "below brushes", 130)
    scroll(app, "Dry bristle", -8)


def land(app: Program) -> None:
    """The painting as land."""
    app.keys("ctrl+t")
    app.park()
    time.sleep(10 * CALM)  # while it is drawn finer


SCENES: dict[str, tuple[str, str, Act]] = {  # file: painting, look, what is done
    "lab.png": ("still-life", "dark", lab),
    "examples-window.png": ("watercolour-tree", "dark", examples),
    "light-window.webp": ("lake-morning", "light", light),
    "land-window.webp": ("valley", "dark", land),
}


def shown(display: str, path: Path, look: str, act: Act) -> Image.Image:
    """The screen with a painting open, once that is done and nothing changes any more."""
    preferences = path.parent / "config" / "inkfall" / "preferences.toml"
    preferences.parent.mkdir(parents=True, exist_ok=True)
    preferences.write_text(f'[display]\nlook = "{look}"\n')
    app = Program(display, path.parent, str(path))
    try:
        prepared(app)
        calm(app)
        act(app)
        app.park()
        return Image.fromarray(calm(app))
    finally:
        app.close()


def saved(picture: Image.Image, path: Path) -> None:
    if path.suffix == ".png":
        picture.save(path, optimize=True)
    else:
        picture.save(path, quality=QUALITY, method=6)


def main() -> None:
    need("Xvfb", "xdotool")
    server, display = started_screen()
    try:
        for name, (painting, look, act) in SCENES.items():
            if any(part in name for part in sys.argv[1:] or [""]):
                with tempfile.TemporaryDirectory() as folder:
                    path = Path(folder, f"{painting}.ora")
                    if inkfall(["play", str(ROOT / "palettes" / "gallery" / f"{painting}.jsonl"), "--save", str(path)]):
                        raise SystemExit(f"{painting} could not be played")
                    saved(shown(display, path, look, act), FOLDER / name)
    finally:
        server.terminate()
        server.wait(10)


if __name__ == "__main__":
    main()
