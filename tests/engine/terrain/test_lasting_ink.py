"""Ink that is not renewed: recorded, kept in files, and as rough at any depth as heights want it."""

import io
import json

import numpy as np
import pytest

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.evaluate import evaluate
from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.painting.recording import read_from, version_of
from engine.session.replay import replay
from engine.terrain.plane import land

FRAME = [0, 0, 192, 128]
ROCK = {"texture": "rock", "amount": 1, "period": 128, "roughness": 0.86, "colour": "#ffffff", "seed": 4}


def played(*commands):
    lines = [{"inkfall": 2, "frame": FRAME, "seed": 3}, *commands]
    return replay(read_from(io.BytesIO("\n".join(map(json.dumps, lines)).encode()), "here"))


def ground(**ink):
    brush = {"radius": 60, "colour": "#000000", "ink": [ROCK | ink]}
    return {"do": "stroke", "points": [[90, 60]], "brush": brush}


def test_it_is_recorded_and_kept_in_files(tmp_path):
    done = played(ground(renew=False))
    again = [json.loads(line) for line in done.recording().lines()]
    assert again[1]["brush"]["ink"][0]["renew"] is False
    assert [version_of(parse(ground(renew=renew))) for renew in (False, True)] == [2, 1]
    path = tmp_path / "land.ora"
    save(path, Snapshot(done.painting, done.recording()))
    opened = open_painting(path).painting
    rect = Rect.at(70 << 14, 60 << 14, 24, 24)
    made, read = (evaluate(next(layers.layers(p.root)).pyramid, 14, rect) for p in (done.painting, opened))
    assert np.array_equal(made.data, read.data)
    assert made.inks == read.inks
    assert not made.inks[0].renew


@pytest.mark.parametrize(("renew", "least", "most"), [(False, 0.05, 0.25), (True, 0.8, 1.1)])
def test_slopes_grow_no_faster_than_the_spectrum_says(renew, least, most):
    """By 2^(1 - H) a level, H = 0.86; where octaves are renewed, slopes double."""
    seen = land(played(ground(renew=renew)).painting, "Layer 1", scale=1.0)
    slopes = []
    for level in (12, 20):
        x, y = 70 << level, 60 << level
        heights = seen.height(level, Rect.at(x, y, 96, 96))
        slopes.append(np.abs(np.diff(heights)).mean() * 2.0**level)
    assert least < np.log2(slopes[1] / slopes[0]) / 8 < most
