"""Runs of the command line, in this process or in one of its own, and what they leave."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
from PIL import Image

from app.__main__ import main

ROOT = Path(__file__).parents[3]
HEADER = '{"inkfall": 1, "frame": [0, 0, 64, 48], "seed": 7}\n'
ROCK = '"ink": [{"texture": "rock", "amount": 0.8, "colour": "#ffffff", "period": 16}]'
STROKES = (
    '{"do": "layer", "add": "Sky"}\n'
    '{"do": "stroke", "points": [[8, 8], [50, 40]], "brush": {"radius": 12, "colour": "#803010", ' + ROCK + "}}\n"
    '{"do": "layer", "add": "Top"}\n'
    '{"do": "stroke", "level": 3, "origin": [200, 160], "points": [[0, 0], [60, 30]], "brush": {"radius": 9}}\n'
    '{"do": "undo"}\n{"do": "redo"}\n{"do": "view", "level": 2.5, "origin": [0, 0], "size": [64, 64]}\n'
)


def refused(capsys, *words, status=2):
    """Runs a command that must fail; the one line it writes."""
    capsys.readouterr()
    assert main([str(word) for word in words]) == status
    told = capsys.readouterr()
    assert told.out == ""
    assert told.err.startswith("inkfall: ")
    assert told.err.count("\n") == 1
    assert "Traceback" not in told.err
    assert "fault in Inkfall" not in told.err
    return told.err


def start(*words, cache=None, **options):
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    if cache is not None:
        environment["NUMBA_CACHE_DIR"] = str(cache)
    environment.pop("DISPLAY", None)
    environment.pop("WAYLAND_DISPLAY", None)
    command = [sys.executable, "-m", "app", *map(str, words)]
    return subprocess.Popen(command, env=environment, text=True, stderr=subprocess.PIPE, **options)


def pixels(path):
    return np.asarray(Image.open(path))
