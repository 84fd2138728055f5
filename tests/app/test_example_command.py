"""`inkfall texture example`: regions filled with examples of all kinds, and one line for what is none."""

import json

import numpy as np
import platformdirs
import pytest
from PIL import Image

from app.__main__ import main
from engine.files.fault import FileError
from engine.strokes.example_files import kept, key, read_parameters
from engine.texture.example.parameters import FIELDS, Parameters


@pytest.fixture(autouse=True)
def own_cache(tmp_path_factory, monkeypatch):
    """Analyses go to a folder of the test's own."""
    folder = tmp_path_factory.mktemp("cache")
    monkeypatch.setattr(platformdirs, "user_cache_path", lambda name: folder / name)
    return folder / "inkfall" / "examples"


def example(folder, size=(40, 36), mode="RGBA", name="in.png", depth=8):
    """A PNG with a transparent frame, if it has alpha, and grain in it."""
    height, width = size
    random = np.random.default_rng(5)
    values = random.integers(0, 256, (height, width, 4), np.uint8)
    values[..., 3] = 120 + values[..., 3] // 2
    values[::2] //= 2
    if min(size) > 8:
        values[:3] = values[-3:] = values[:, :3] = values[:, -3:] = 0
    image = Image.fromarray(values).convert(mode)
    if depth == 16:
        image = Image.fromarray(random.integers(0, 65536, size, np.uint16))
    image.save(folder / name)
    return folder / name


def region(folder, size=(50, 60), name="region.png"):
    """White, with a black frame and a black bar."""
    values = np.zeros(size, np.uint8)
    values[min(5, size[0] // 3) : size[0] - size[0] // 4, : size[1] // 2 + 1] = 255
    values[:, size[1] // 4 : size[1] // 3] = 0
    Image.fromarray(values).save(folder / name)
    return folder / name, values > 0


def filled(folder, *words, out="out.png", code=0):
    path = folder / out
    assert main(["texture", "example", *map(str, words), "--out", str(path)]) == code
    return np.asarray(Image.open(path)) if code == 0 else None


@pytest.mark.parametrize("method", ["correction", "scanline"])
@pytest.mark.parametrize("size", [(1, 1), (2, 7), (40, 36), (64, 9)])
def test_the_white_part_is_filled_with_pixels_of_the_example(tmp_path, method, size):
    given, (place, inside) = example(tmp_path, size), region(tmp_path)
    parameters = tmp_path / "p.toml"
    parameters.write_text("feather = 0\n")
    out = filled(tmp_path, given, "--region", place, "--method", method, "--params", parameters)
    assert out.shape == (50, 60, 4)
    assert (out[~inside] == 0).all()
    held = {tuple(pixel) for pixel in np.asarray(Image.open(given)).reshape(-1, 4) if pixel[3]}
    assert {tuple(pixel) for pixel in out[inside]} <= held


@pytest.mark.parametrize("mode", ["L", "RGB", "RGBA", "16"])
def test_examples_of_all_kinds(tmp_path, mode):
    given = example(tmp_path, mode="L" if mode == "16" else mode, depth=16 if mode == "16" else 8)
    place, inside = region(tmp_path)
    out = filled(tmp_path, given, "--region", place, "--seed", 3)
    assert np.array_equal(out[..., 3] > 0, inside)
    if mode != "RGBA":
        assert (out[inside][:, 3] == 255).all()


def test_threads_and_the_cache_do_not_matter_but_the_options_do(tmp_path, own_cache):
    given, (place, _) = example(tmp_path), region(tmp_path, (90, 120))
    first = filled(tmp_path, given, "--region", place, "--threads", 1)
    assert len(list(own_cache.glob("*.npz"))) == 1
    assert np.array_equal(first, filled(tmp_path, given, "--region", place, "--threads", 2))
    assert len(list(own_cache.glob("*"))) == 1
    words = [["--seed", 1], ["--levels", 2], ["--neighbourhood", 3], ["--kappa", 0], ["--kappa", 0, "--every", 1]]
    found = {filled(tmp_path, given, "--region", place, *more).tobytes() for more in words}
    assert len(found | {first.tobytes()}) == len(words) + 1


def test_a_mask_tells_the_region_of_the_example(tmp_path):
    values = np.zeros((30, 40, 3), np.uint8)
    values[:, :20] = (200, 0, 0)
    values[:, 20:] = np.random.default_rng(0).integers(100, 255, (30, 20, 1))
    Image.fromarray(values).save(tmp_path / "in.png")
    Image.fromarray(np.where(np.indices((30, 40))[1] >= 20, 255, 0).astype(np.uint8)).save(tmp_path / "mask.png")
    place, inside = region(tmp_path)
    out = filled(tmp_path, tmp_path / "in.png", "--mask", tmp_path / "mask.png", "--region", place)
    assert (out[inside][:, 1] >= 99).all()


def test_a_damaged_or_locked_cache_is_no_matter(tmp_path, own_cache, monkeypatch):
    given, (place, _) = example(tmp_path), region(tmp_path)
    first = filled(tmp_path, given, "--region", place)
    (file,) = own_cache.iterdir()
    whole = file.read_bytes()
    for damage in (b"", b"PK", whole[: len(whole) // 2], whole[:3000] + b"\0" * 99 + whole[3099:]):
        file.write_bytes(damage)
        assert np.array_equal(first, filled(tmp_path, given, "--region", place))
        assert file.read_bytes() == whole
    pixels = np.asarray(Image.open(given))
    assert file.stem == key(pixels, None, Parameters())
    (tmp_path / "file").touch()
    assert kept(pixels, None, Parameters(), tmp_path / "file").levels
    again = kept(pixels, None, Parameters(kappa=5.0), own_cache)
    assert again.parameters.kappa == 5.0
    assert key(pixels, None, Parameters(alpha=False)) != file.stem


def test_what_it_tells(tmp_path, capsys):
    given, (place, inside) = example(tmp_path), region(tmp_path)
    filled(tmp_path, given, "--region", place, "--json")
    told = json.loads(capsys.readouterr().out)
    assert told["filled"] == inside.sum()
    assert (told["size"], told["bits"], told["boundary"], told["kappa"]) == ([60, 50], 8, True, 2.0)
    black = tmp_path / "black.png"
    Image.new("L", (7, 5)).save(black)
    assert not filled(tmp_path, given, "--region", black).any()
    assert "nothing was filled" in capsys.readouterr().out
    filled(tmp_path, given, "--region", place, "--levels", 8)
    assert "levels: the example has no room for 8" in capsys.readouterr().out


WRONG = {
    "no region": (["in.png"], "--region"),
    "missing example": (["none.png", "--region", "region.png"], "none.png"),
    "missing region": (["in.png", "--region", "none.png"], "none.png"),
    "missing mask": (["in.png", "--region", "region.png", "--mask", "none.png"], "none.png"),
    "mask of another size": (["in.png", "--region", "region.png", "--mask", "region.png"], "region.png"),
    "black mask": (["in.png", "--region", "region.png", "--mask", "black.png"], "black.png"),
    "transparent": (["clear.png", "--region", "region.png"], "clear.png: found only transparent pixels"),
    "huge": (["huge.png", "--region", "region.png"], "huge.png: found 1025 x 2 pixels"),
    "text": (["text.png", "--region", "region.png"], "text.png"),
    "over itself": (["in.png", "--region", "region.png", "--out", "in.png"], "in.png"),
    "over the region": (["in.png", "--region", "region.png", "--out", "region.png"], "region.png"),
    "ending": (["in.png", "--region", "region.png", "--out", "o.jpg"], ".jpg"),
    "kappa": (["in.png", "--region", "region.png", "--kappa", "-1"], "--kappa"),
    "kappa nan": (["in.png", "--region", "region.png", "--kappa", "nan"], "--kappa"),
    "neighbourhood": (["in.png", "--region", "region.png", "--neighbourhood", "4"], "--neighbourhood"),
    "levels": (["in.png", "--region", "region.png", "--levels", "99"], "--levels"),
    "every": (["in.png", "--region", "region.png", "--every", "0"], "--every"),
    "method": (["in.png", "--region", "region.png", "--method", "magic"], "--method"),
    "threads": (["in.png", "--region", "region.png", "--threads", "0"], "--threads"),
    "missing parameters": (["in.png", "--region", "region.png", "--params", "none.toml"], "none.toml"),
    "parameters": (["in.png", "--region", "region.png", "--params", "text.png"], "text.png: line 1"),
}


@pytest.mark.parametrize(("words", "place"), WRONG.values(), ids=WRONG)
def test_one_line_for_what_is_wrong(tmp_path, monkeypatch, capsys, words, place):
    monkeypatch.chdir(tmp_path)
    example(tmp_path)
    region(tmp_path)
    Image.new("L", (36, 40)).save("black.png")
    Image.new("RGBA", (9, 9)).save("clear.png")
    Image.new("RGB", (1025, 2)).save("huge.png")
    (tmp_path / "text.png").write_text("not a picture\n")
    there = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    if "--out" not in words:
        words = [*words, "--out", "o.png"]
    assert main(["texture", "example", *words]) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert place in told
    assert there == {path.name: path.read_bytes() for path in tmp_path.iterdir()}


TOML = {
    "kappa = 1\n\nneighbourhood = 6\n": "line 3, neighbourhood: found 6, expected 3 or 5 or 7",
    "[more]\nx = 1\n": "line 1, more: found an unknown field",
    "levels = 3\nkapa = 1": "line 2, kapa: found an unknown field, expected one of kappa",
    'channels = "red"': 'line 1, channels: found "red", expected "colour" or "luminance"',
    "alpha = 1": "line 1, alpha: found 1, expected true or false",
    "passes = true": "line 1, passes: found true, expected a whole number from 1 to 4",
    "e_max = nan": "line 1, e_max: found nan",
    "kappa = 1\nkappa = 2": "line 2: found cannot overwrite a value",
    "kappa = 'x": "line 1",
    "\n\nkappa 2": "line 3, column",
    "a = " + "[" * 3000: "line 1",
}


@pytest.mark.parametrize(("text", "told"), TOML.items())
def test_parameter_files_that_are_wrong(tmp_path, text, told):
    path = tmp_path / "p.toml"
    path.write_text(text)
    with pytest.raises(FileError) as error:
        read_parameters(path)
    assert str(error.value).startswith(f"{path}: {told}")
    assert "\n" not in str(error.value)


def test_parameter_files(tmp_path):
    path = tmp_path / "p.toml"
    path.write_bytes(b"# mine\r\nkappa = 3\n'method' = \"scanline\"\nalpha = false\n")
    assert read_parameters(path) == Parameters(kappa=3.0, method="scanline", alpha=False)
    path.write_bytes(b"")
    assert read_parameters(path) == Parameters()
    path.write_bytes(b"kappa = 1\n\xff")
    with pytest.raises(FileError, match=r"line 2: found bytes that are not UTF-8"):
        read_parameters(path)
    assert len(FIELDS) == 13


def test_pictures_tell_the_maps_that_the_parameters_name(tmp_path, capsys):
    given, (place, inside) = example(tmp_path, mode="L"), region(tmp_path)
    (tmp_path / "p.toml").write_text("feather = 0\n[maps.orientation]\nturns = 4\n[maps.rim]\nwidth = 6\n")
    Image.fromarray(np.full(inside.shape, 64, np.uint8)).save(tmp_path / "down.png")
    words = given, "--params", tmp_path / "p.toml", "--region", place
    across = filled(tmp_path, *words, "--json")
    assert json.loads(capsys.readouterr().out)["maps"] == ["orientation", "rim"]
    down = filled(tmp_path, *words, "--told", f"orientation={tmp_path / 'down.png'}", out="down2.png")
    assert np.array_equal(across[..., 3] > 0, inside)
    assert (across != down).any()
    for told, what in (
        ("size=x.png", "--told: found size=x.png, expected NAME=P.png, NAME one of orientation"),
        (f"orientation={given}", "in.png: found 36 x 40 pixels, expected 60 x 50 as the region"),
    ):
        filled(tmp_path, *words, "--told", told, code=2)
        assert what in capsys.readouterr().err
    (tmp_path / "p.toml").write_text('method = "scanline"\n[maps.rim]\n')
    filled(tmp_path, *words, code=2)
    assert 'maps: found maps with method "scanline", expected method "correction"' in capsys.readouterr().err
