"""`inkfall solid`: objects of solids as pictures, and what is refused."""

import json

import numpy as np
import pytest
from command_line import pixels, refused
from PIL import Image

from app.__main__ import main

POINTS = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1))
BOX = POINTS + "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"
SMALL = ("--size", "48x36", "--samples", "1")


def test_a_material_on_an_object(tmp_path, capsys):
    """The same words give the same picture; the object stands out, casts a shadow, and turns."""
    seen = {}
    (tmp_path / "m.obj").write_text(BOX)
    for name, words in {
        "one": ("--seed", "4"),
        "same": ("--seed", "4"),
        "seed": ("--seed", "5"),
        "turn": ("--seed", "4", "--turn", "-80,20.5"),
        "slider": ("--seed", "4", "--set", "bands=60"),
    }.items():
        out = tmp_path / f"{name}.png"
        assert main(["solid", "agate", str(out), "--on", str(tmp_path / "m.obj"), *SMALL, *words, "--json"]) == 0
        assert json.loads(capsys.readouterr().out)["size"] == [48, 36]
        seen[name] = pixels(out).astype(int)
    assert np.array_equal(seen["one"], seen["same"])
    for other in ("seed", "turn", "slider"):
        assert np.abs(seen[other] - seen["one"]).mean() > 1.0
    light = seen["one"].sum(axis=-1)
    assert light[24, 39] < 0.8 * light[24, 3]  # the lamp is on the left


def test_a_cube_on_a_mesh(tmp_path):
    """Red where the cube is red, through the object's own place in it."""
    cube = np.zeros((4, 4, 4, 3), np.uint8)
    cube[:2, ..., 0], cube[2:, ..., 2] = 255, 255  # red below the middle, blue above
    np.save(tmp_path / "c.npy", cube)
    (tmp_path / "m.obj").write_text("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\nf 4 3 2 1\n")
    out = tmp_path / "o.png"
    words = ["--on", str(tmp_path / "m.obj"), "--turn", "0,0", "--scale", "0.35", *SMALL]
    assert main(["solid", str(tmp_path / "c.npy"), str(out), *words]) == 0
    found = pixels(out).astype(int)
    assert found[12, 24, 2] > 2 * found[12, 24, 0]
    assert found[27, 24, 0] > 2 * found[27, 24, 2]


def test_what_cannot_be_is_refused(tmp_path, capsys):
    out = tmp_path / "o.png"
    np.save(tmp_path / "flat.npy", np.zeros((4, 4)))
    np.save(tmp_path / "text.npy", np.array([[["a"] * 2] * 2] * 2))
    np.save(tmp_path / "nan.npy", np.full((4, 4, 4), np.nan, np.float32))
    (tmp_path / "no.npy").write_bytes(b"nothing")
    (tmp_path / "m.obj").write_text("f 1 2 3")
    for words in (
        ("slate", out),
        ("wood", tmp_path / "o.jpg"),
        ("wood", out, "--on", "tree"),
        ("wood", out, "--on", tmp_path / "m.obj"),
        ("wood", out, "--set", "rings=1"),
        ("wood", out, "--set", "colour=1"),
        ("wood", out, "--turn", "1"),
        ("wood", out, "--scale", "0"),
        ("wood", out, "--size", "100000x100000"),
        *((tmp_path / f"{name}.npy", out) for name in ("flat", "text", "nan", "no")),
        (tmp_path / "m.obj", out),
    ):
        assert "expected" in refused(capsys, "solid", *words) or "no such file" in refused(capsys, "solid", *words)
        assert not out.exists()


@pytest.mark.nightly
def test_a_cube_grows_from_an_example(tmp_path):
    rng = np.random.default_rng(0)
    Image.fromarray(rng.integers(0, 255, (32, 32, 3), dtype=np.uint8)).save(tmp_path / "e.png")
    out = tmp_path / "o.png"
    assert main(["solid", str(tmp_path / "e.png"), str(out), *SMALL]) == 0
    assert pixels(out).std() > 5.0
