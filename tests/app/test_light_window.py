"""The painting in the light, in the real window: as an export shows it, set by the sun, gone without a trace."""

import json

import numpy as np
import pytest

from app.__main__ import main
from engine.files.images import read_image

pytestmark = pytest.mark.window
WIDTH, HEIGHT = 300, 200
EDGE = 8  # within which the frame is marked
BRUSH = {"radius": 30, "colour": "#a06040", "ink": [{"texture": "rock", "amount": 0.6, "period": 24}]}
LINES = (
    {"inkfall": 2, "frame": [0, 0, WIDTH, HEIGHT], "seed": 1, "paper": "#707880"},
    {"do": "layer", "add": "Layer 1"},
    {"do": "stroke", "points": [[40, 50], [260, 150]], "brush": {**BRUSH, "impasto": 4}},
    {"do": "layer", "add": "Land"},
    {"do": "stroke", "points": [[40, 150], [260, 50]], "brush": BRUSH},
    {"do": "layer", "set": "Land", "visible": False},
)
SUN = "--light", "315,45,12"
LIT = {"plain": (), "lit": SUN, "land": (*SUN, "--height", "Land"), "thick": (*SUN, "--height", "impasto")}


def places_of(picture, screen):
    """Where the picture lies on the screen, pixel for pixel: upper left corners."""
    high, wide, _ = picture.shape
    row, middle = picture[high // 2], screen[high // 2 :]
    alike = (middle[:, : 1 - wide] == row[0]).all(axis=2) & (middle[:, wide - 1 :] == row[-1]).all(axis=2)
    return [(y, x) for y, x in np.argwhere(alike) if np.array_equal(screen[y : y + high, x : x + wide], picture)]


def exported(app, path):
    """Writes the picture as the dialog proposes it."""
    app.keys("ctrl+e")
    app.click("Choose file…")
    app.box("name", "Export picture")
    app.fill(str(path))
    app.keys("Return")
    app.until(lambda screen: path.exists())


@pytest.mark.nightly
def test_the_window_shows_what_the_export_does(program, tmp_path):
    (tmp_path / "a.jsonl").write_text("\n".join(map(json.dumps, LINES)) + "\n")
    app = program(str(tmp_path / "a.jsonl"))
    app.settled()
    app.keys("1")
    assert main(["play", str(tmp_path / "a.jsonl"), "--save", str(tmp_path / "a.ora")]) == 0
    pictures = {}
    for name, words in LIT.items():
        rect = f"0,{EDGE},{EDGE},{WIDTH - 2 * EDGE},{HEIGHT - 2 * EDGE}"
        assert main(["export", str(tmp_path / "a.ora"), str(tmp_path / f"{name}.png"), "--rect", rect, *words]) == 0
        pictures[name] = read_image(tmp_path / f"{name}.png")[0][..., :3].astype(int)
    plain = app.until(lambda screen: len(places_of(pictures["plain"], screen)) == 1)
    ((top, left),) = places_of(pictures["plain"], plain)
    frame = slice(top, top + HEIGHT - 2 * EDGE), slice(left, left + WIDTH - 2 * EDGE)
    app.keys("shift+l")
    lit = app.until(lambda screen: abs(screen[frame] - pictures["lit"]).max() <= 1)
    app.click("Impasto", window="light")
    app.until(lambda screen: abs(screen[frame] - pictures["thick"]).max() <= 2)
    app.click("Layer", window="light")
    app.until(lambda screen: abs(screen[frame] - pictures["land"]).max() <= 1)
    exported(app, tmp_path / "window.png")
    assert main(["export", str(tmp_path / "a.ora"), str(tmp_path / "whole.png"), *LIT["land"]]) == 0
    assert np.array_equal(*(read_image(tmp_path / name)[0] for name in ("window.png", "whole.png")))
    app.click("Lightness", window="light")
    app.until(lambda screen: np.array_equal(screen[frame], lit[frame]))
    left_end, up, right_end, down = app.box("sun")
    middle, radius = ((left_end + right_end) // 2, (up + down) // 2), 0.46 * (right_end - left_end)
    app.drag(middle, (round(middle[0] + radius * np.cos(np.radians(20))), middle[1]))
    app.do("mouseup", 1)
    app.until(lambda screen: abs(screen[frame] - lit[frame]).max() > 20)
    app.keys("shift+l")
    again = app.until(lambda screen: np.array_equal(screen[frame], plain[frame]))
    assert np.array_equal(again[60:740, 270:970], plain[60:740, 270:970])
