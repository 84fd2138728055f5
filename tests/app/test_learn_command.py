"""`inkfall texture learn` on pictures of all kinds, and on what is none."""

import json

import numpy as np
import pytest
from PIL import Image

from app.__main__ import main


def picture(folder, mode="RGB", size=(40, 36)):
    random = np.random.default_rng(5)
    coarse = random.integers(30, 226, (-(-size[0] // 6), -(-size[1] // 6), 4), np.uint8)
    values = np.repeat(np.repeat(coarse, 6, axis=0), 6, axis=1)[: size[0], : size[1]]
    values = values + random.integers(-20, 21, values.shape).astype(np.uint8)
    if mode == "L16":
        image = Image.fromarray(values[..., 0].astype(np.uint16) * 257)
    else:
        image = Image.fromarray(np.ascontiguousarray(values[..., {"L": 0, "RGB": slice(3), "RGBA": slice(4)}[mode]]))
    image.save(folder / "in.png")
    return folder / "in.png"


def made(folder, path, *words):
    assert main(["texture", "learn", str(path), "--out", str(folder / "out.png"), *words]) == 0
    return np.asarray(Image.open(folder / "out.png"))


@pytest.mark.parametrize("size", [(1, 1), (1, 50), (8, 8), (40, 36)])
@pytest.mark.parametrize("mode", ["L", "RGB", "RGBA", "L16"])
def test_pictures_of_any_kind_and_size(tmp_path, mode, size):
    found = made(tmp_path, picture(tmp_path, mode, size), "--octaves", "2")
    assert found.shape[:2] == (4 * size[0], 4 * size[1])
    assert (tmp_path / "out.png").read_bytes()[24] == (16 if mode == "L16" else 8)


def test_what_is_made(tmp_path, capsys):
    """The means of 2 x 2 pixels are those that were there; strength, seed and tiling count."""
    path = picture(tmp_path)
    own = np.asarray(Image.open(path)).astype(float)
    found = made(tmp_path, path, "--json")
    told = json.loads(capsys.readouterr().out)
    assert (told["size"], told["channels"], told["bits"], told["octaves"]) == ([72, 80], 3, 8, 1)
    means = found.astype(float).reshape(40, 2, 36, 2, 3).mean(axis=(1, 3))
    assert np.abs(means - own).mean() < 0.5
    assert np.array_equal(made(tmp_path, path), found)
    others = [made(tmp_path, path, *more) for more in (("--strength", "0"), ("--seed", "-3"), ("--tile",))]
    assert all(not np.array_equal(one, found) for one in others)
    rough = [float(np.abs(np.diff(one.astype(float), axis=1)).mean()) for one in (found, others[0])]
    assert rough[0] > 1.1 * rough[1]


REFUSED = {
    "octaves": ["{in}", "--octaves", "3"],
    "strength": ["{in}", "--strength", "2"],
    "missing": ["{dir}/none.png"],
    "none": ["{dir}/text.png"],
    "itself": ["{dir}/out.png"],
}


@pytest.mark.parametrize("words", REFUSED.values(), ids=REFUSED)
def test_refused_in_one_line(tmp_path, words, capsys):
    (tmp_path / "text.png").write_text("no picture")
    path = picture(tmp_path)
    path.with_name("out.png").write_bytes(path.read_bytes())
    given = [word.format(dir=tmp_path, **{"in": path}) for word in words]
    assert main(["texture", "learn", *given, "--out", str(tmp_path / "out.png")]) == 2
    assert capsys.readouterr().err.count("\n") == 1
