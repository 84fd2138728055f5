"""The sheet of structures shows what its script says: kinds in rows, and each way of matching in a column."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

PICTURES = Path(__file__).resolve().parents[2] / "palettes" / "pictures"


@pytest.fixture(scope="module")
def script(script_of):
    return script_of("make_structures")


def test_a_dozen_kinds_are_squares_without_holes(script):
    assert len(script.KINDS) == 12
    for name in script.KINDS.values():
        square = script.example(name)
        assert (square.mode, square.size) == ("RGB", (script.TEXTURE, script.TEXTURE))
        assert np.asarray(square).std() > 3.0


def test_the_picture_has_a_row_for_each_kind_and_is_small(script):
    path = PICTURES / "structures.webp"
    with Image.open(path) as picture:
        assert picture.size[1] == script.HEADS + len(script.KINDS) * (script.SEEN + script.SPACE)
    assert path.stat().st_size < 700_000


def test_what_is_seen_from_near_is_where_most_is_to_be_seen(script):
    pixels = np.zeros((script.SEEN, script.SEEN), np.uint8)
    pixels[60:, :] = 255
    _, y = script.busiest(Image.fromarray(pixels))
    assert abs(y - 60) <= 2


def test_a_texture_is_seen_whole_and_from_near(script, tmp_path):
    path = tmp_path / "felt.png"
    script.example("felt").save(path)
    found = np.asarray(script.pair(script.filled(path, script.COLUMNS["example"])))
    whole, near = found[:, : script.SEEN], found[:, script.SEEN + 1 :]
    assert np.abs(whole.mean((0, 1)) - np.asarray(Image.open(path)).mean((0, 1))).max() < 6.0
    assert near.std() > 3.0
