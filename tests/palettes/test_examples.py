"""The bundled example textures: each has a region whose rim is another matter than its inside, all the way around."""

from __future__ import annotations

import importlib.util
import os
import subprocess
import sys
import tomllib
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from scipy import ndimage

EXAMPLES = Path(__file__).resolve().parents[2] / "palettes" / "examples"
NAMES = sorted(file.stem for file in EXAMPLES.glob("*.toml"))
BANDS = ((3.0, 6.0), (6.0, 10.0), (10.0, 15.0))  # pixels from the outline: more than a soft edge
INSIDE = 26.0  # no rim is as wide as that


@cache
def picture(name: str) -> np.ndarray:
    """Premultiplied RGBA in 0..1, (h, w, 4)."""
    opened = Image.open(EXAMPLES / f"{name}.png")
    assert opened.mode == "RGBA"
    pixels = np.asarray(opened, np.float32) / 255.0
    return pixels * np.where(np.arange(4) < 3, pixels[..., 3:], 1.0)


@cache
def depth(name: str) -> np.ndarray:
    """How far inside its region each pixel is, 0 outside: (h, w)."""
    mask = EXAMPLES / f"{name}.mask.png"
    if mask.exists():
        opened = Image.open(mask)
        assert opened.mode == "1"
        region = np.asarray(opened)
    else:
        region = picture(name)[..., 3] > 0.0
    return ndimage.distance_transform_edt(region)


def quantiles(colours: np.ndarray) -> np.ndarray:
    """What a set of colours (k, 4) has in each channel, in order: (49, 4)."""
    places = np.linspace(0.02, 0.98, 49) * (len(colours) - 1)
    return np.sort(colours, axis=0)[np.round(places).astype(int)]


def unlikeness(a: np.ndarray, b: np.ndarray) -> float:
    """Mean difference between two such, the most of any channel."""
    return float(np.abs(a - b).mean(axis=0).max())


@cache
def sectors(name: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Quantiles of the whole inside (49, 4); of its eighths about the middle (8, 49, 4); of the bands along the rim
    in each eighth (8, bands, 49, 4)."""
    h, w = depth(name).shape
    y, x = np.mgrid[:h, :w]
    eighth = np.floor((np.arctan2(y - h / 2, x - w / 2) / np.pi + 1.0) * 4.0).astype(int) % 8
    inside, rim = [], []
    for k in range(8):
        far, colours = depth(name)[eighth == k], picture(name)[eighth == k]
        assert (far > INSIDE).sum() > 500
        inside.append(quantiles(colours[far > INSIDE]))
        rim.append([quantiles(colours[(far > low) & (far <= high)]) for low, high in BANDS])
    return quantiles(picture(name)[depth(name) > INSIDE]), np.stack(inside), np.array(rim)


def test_there_are_enough():
    assert len(NAMES) >= 14
    assert {file.stem for file in EXAMPLES.glob("*.png")} == {
        stem for name in NAMES for stem in (name, f"{name}.mask") if (EXAMPLES / f"{stem}.png").exists()
    }
    assert sum(name.startswith("wash-") for name in NAMES) == 12


@pytest.mark.parametrize("name", NAMES)
def test_parameters_are_what_the_synthesis_takes(name):
    given = tomllib.loads((EXAMPLES / f"{name}.toml").read_text("utf-8"))
    assert given.keys() - {"levels", "maps"} == {"group", "kappa", "neighbourhood", "every", "channels"}
    assert isinstance(given["group"], str)
    assert 0.0 <= given["kappa"] <= 5.0
    assert given["neighbourhood"] in (3, 5, 7)
    assert 1 <= given.get("levels", 6) <= 6
    assert given["every"] >= 1
    assert given["channels"] in ("colour", "luminance")


@pytest.mark.parametrize("name", NAMES)
def test_files_are_small_and_regions_are_whole(name):
    assert (EXAMPLES / f"{name}.png").stat().st_size <= 300 * 1024
    far = depth(name)
    assert max(far.shape) <= 400
    edges = (far[0], far[-1], far[:, 0], far[:, -1])
    assert all((edge == 0.0).all() for edge in edges)
    assert ndimage.label(far > 0.0)[1] == 1
    assert 0.4 <= (far > 0.0).mean() <= 0.85
    alpha = picture(name)[..., 3]
    assert not alpha[far == 0.0].any()
    assert np.median(alpha[far > INSIDE]) > 0.3


@pytest.mark.parametrize("name", NAMES)
def test_the_inside_is_alike_everywhere(name):
    inside, parts, _ = sectors(name)
    assert max(unlikeness(part, inside) for part in parts) < 0.06


@pytest.mark.parametrize("name", [name for name in NAMES if name != "thatch"])  # whose stalks end, and are no other
def test_the_rim_is_unlike_the_inside_in_every_direction(name):
    """Some band along the rim differs from the inside more than any part of the inside does."""
    inside, parts, rim = sectors(name)
    within = max(unlikeness(part, inside) for part in parts)
    for bands in rim:
        across = max(unlikeness(band, inside) for band in bands)
        assert across > max(2.0 * within, 0.06)


@pytest.mark.nightly
def test_the_script_makes_the_same_picture_again(tmp_path):
    """Within rounding: transforms differ in their last bits from machine to machine."""
    name = "torn-kraft-paper"
    command = [sys.executable, EXAMPLES / "make" / "make_examples.py", name, "--into", tmp_path]
    assert subprocess.run(command, env=os.environ | {"PYTHONDONTWRITEBYTECODE": "1"}, check=False).returncode == 0
    for ending in (".png", ".mask.png"):
        made, bundled = (np.asarray(Image.open(folder / f"{name}{ending}"), int) for folder in (tmp_path, EXAMPLES))
        assert (np.abs(made - bundled) > 2).mean() < 0.001


def test_the_sheet_of_examples_shows_them():
    spec = importlib.util.spec_from_file_location("contact_sheet", EXAMPLES / "make" / "contact_sheet.py")
    assert spec is not None
    assert spec.loader is not None
    sheet = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(sheet)
    assert {name for _, name in sheet.entries()} == set(NAMES)
    assert sheet.PICTURE.stat().st_size <= 500 * 1024
    with Image.open(sheet.PICTURE) as shown:
        assert np.abs(np.asarray(shown.convert("RGB"), int) - np.asarray(sheet.sheet(), int)).mean() < 12.0
