"""The maker "example": what it reads, records and refuses, and how what it made is known again."""

import numpy as np
import pytest
from PIL import Image
from plantings import blob, fresh, meadow, pixels, stroke, texture

from engine.files.fault import FileError
from engine.makers import definitions
from engine.painting import commands as c
from engine.session.apply import Refusal
from engine.session.session import Session
from engine.strokes.example_textures import BUNDLED, bundled, exemplar_of, key_of, parameters_of
from engine.texture.example.parameters import FIELDS, Parameters

__all__ = ["meadow"]


def defined(folder, name="t", path="a.png", **members):
    session = Session(folder=folder)
    session.do(texture(name, path, **members))
    return session.painting.textures[name], session


@pytest.mark.parametrize("mode", ["RGBA", "RGB", "L", "LA", "1", "P"])
def test_every_picture_is_an_example(meadow, tmp_path, mode):
    image = Image.fromarray(blob(1))
    (image.convert("RGB").convert(mode) if mode in ("1", "P") else image.convert(mode)).save(tmp_path / "x.png")
    made, _ = defined(tmp_path, path="x.png")
    exemplar = exemplar_of(made)
    assert exemplar.pixels.dtype == np.uint16
    assert exemplar.boundary == ("A" in mode)
    assert exemplar_of(made) is exemplar  # analysed once


def test_an_opaque_picture_is_analysed_as_on_the_command_line(meadow, tmp_path):
    from engine.strokes.example_files import read_exemplar

    Image.fromarray(blob(2)).convert("RGB").save(tmp_path / "x.png")
    own, told = exemplar_of(defined(tmp_path, path="x.png")[0]), read_exemplar(tmp_path / "x.png")
    for a, b in zip(own.levels, told.levels, strict=True):
        assert np.array_equal(a.compared, b.compared)


def test_sixteen_bits_are_kept(meadow, tmp_path):
    values = np.random.default_rng(1).integers(0, 65536, (30, 30), np.uint16)
    Image.fromarray(values).save(tmp_path / "x.png")
    made, _ = defined(tmp_path, path="x.png")
    assert np.array_equal(exemplar_of(made).pixels[..., 0], values)


def test_a_mask_a_file_of_parameters_and_strokes_on_the_mask(meadow, tmp_path):
    Image.fromarray(blob(1)).save(tmp_path / "x.png")
    inside = np.zeros((40, 40), np.uint8)
    inside[10:30, 5:35] = 255
    Image.fromarray(inside).save(tmp_path / "m.png")
    (tmp_path / "p.toml").write_text('kappa = 5.0\nchannels = "luminance"\ngroup = "mine"\n')
    made, session = defined(tmp_path, path="x.png", mask="m.png", params="p.toml", every=3)
    assert parameters_of(made) == Parameters(kappa=5.0, channels="luminance", every=3)
    assert np.array_equal(exemplar_of(made).mask, inside > 0)
    log = session.log[0].arguments
    assert set(FIELDS) <= set(log)
    assert log["mask_sha"] == made.mask.sha
    assert log["sha"] == made.source.sha
    # What was recorded stands, whatever the file says later.
    (tmp_path / "p.toml").write_text("kappa = 9.0\n")
    again = Session(folder=tmp_path)
    again.do(session.log[0])
    assert key_of(again.painting.textures["t"]) == key_of(made)
    (tmp_path / "p.toml").unlink()
    again.do(session.log[0])
    strokes = [
        {"points": [[20, 20]], "brush": {"radius": 60, "dynamics": {}, "mode": "erase"}},
        {"points": [[20, 20]], "brush": {"radius": 8, "dynamics": {}}},
    ]
    made, _ = defined(tmp_path, path="x.png", mask_strokes=strokes)
    y, x = np.mgrid[:40, :40] + 0.5 - 20
    assert abs(int(exemplar_of(made).mask.sum()) - int((np.hypot(x, y) <= 7.8).sum())) < 16


def test_another_picture_or_mask_than_was_recorded_is_refused(meadow, tmp_path):
    for name in ("x.png", "m.png"):
        Image.fromarray(blob(1)).save(tmp_path / name)
    _, session = defined(tmp_path, path="x.png", mask="m.png")
    for name in ("m.png", "x.png"):
        other = blob(2)
        other[:15] = 0
        Image.fromarray(other).save(tmp_path / name)
        with pytest.raises(FileError, match="is not what was there when it was recorded"):
            Session(folder=tmp_path).do(session.log[0])
        Image.fromarray(blob(1)).save(tmp_path / name)


def test_a_picture_that_the_painting_has_needs_no_file(meadow, tmp_path):
    for name in ("x.png", "m.png"):
        Image.fromarray(blob(1)).save(tmp_path / name)
    made, session = defined(tmp_path, path="x.png", mask="m.png")
    (tmp_path / "x.png").unlink()
    (tmp_path / "m.png").unlink()
    command = session.log[0]
    session.do(c.DefineTexture("other", "example", command.arguments.set("kappa", 7.0)))
    other = session.painting.textures["other"]
    assert parameters_of(other).kappa == 7.0
    assert np.array_equal(other.mask.data, made.mask.data)
    assert key_of(other) != key_of(made)


@pytest.mark.parametrize("name", ["torn-rag-paper", "wash-indigo"])
def test_the_bundled_examples_have_names(meadow, name):
    assert name in bundled()
    session = Session()
    session.do(
        c.DefineTexture(
            "t", "example", c.parse({"do": "texture", "name": "t", "maker": "x", "bundled": name}).arguments
        )
    )
    made = session.painting.textures["t"]
    with Image.open(BUNDLED / f"{name}.png") as image:
        assert (made.source.width, made.source.height) == image.size
    assert made.mask is not None
    assert exemplar_of(made, 2).finer
    portable = definitions.portable("t", made.kind, made.parameters)
    assert definitions.defined_by(portable, made.kind, made.parameters)


def test_a_brush_brings_its_example_along(meadow):
    brush = stroke([[1, 1]]).brush
    assert definitions.refers(brush, "a")
    own = (texture("a", str(meadow / "a.png")),)
    fitted, needed, lacking = definitions.fitted(brush, own, {"a": ("rock", {})})
    assert fitted.example == needed[0].name == lacking[0].name == "a 2"
    assert definitions.kind_of(own[0]) == "example"


def test_as_ink_it_is_its_picture(meadow):
    session = fresh(meadow)
    ink = [{"texture": "a"}]
    session.do(stroke([[40, 40]], mode="paint", radius=30, ink=ink))
    session.do(c.DefineTexture("a", "image", texture("a", "a.png").arguments))
    other = fresh(meadow)
    other.do(c.DefineTexture("a", "image", texture("a", "a.png").arguments))
    other.do(stroke([[40, 40]], mode="paint", radius=30, ink=ink))
    assert np.array_equal(pixels(session.painting)[1], pixels(other.painting)[1])


def tiny(width, height, alpha):
    out = np.full((height, width, 4), 200, np.uint8)
    out[..., 3] = alpha
    return out


ODD = {"a pixel": tiny(1, 1, 255), "a line": tiny(60, 1, 255), "almost transparent": tiny(20, 20, 1)}


@pytest.mark.parametrize("picture", ODD.values(), ids=ODD)
def test_odd_examples_grow_something(meadow, tmp_path, picture):
    Image.fromarray(picture).save(tmp_path / "x.png")
    session = Session(folder=tmp_path)
    session.do(texture("a", "x.png"))
    for detail in (0, 4):
        session.do(stroke([[30, 30]], example_detail=detail, depth=detail))
    shown = pixels(session.painting)
    assert shown[1][3].any()
    assert all(np.isfinite(planes).all() for planes in shown)


REFUSED = {
    "nothing": ({}, Refusal, "path: found nothing, expected path, a picture, or bundled"),
    "both": ({"path": "a.png", "bundled": "felt"}, Refusal, 'bundled: found "felt", expected either path or bundled'),
    "not bundled": ({"bundled": "x/../y"}, Refusal, "bundled: found"),
    "no file": ({"path": "none.png"}, FileError, "none.png"),
    "no mask": ({"path": "a.png", "mask": "none.png"}, FileError, "none.png: found no file there"),
    "a device": ({"path": "a.png", "params": "/dev/zero"}, FileError, "/dev/zero: found no file there"),
    "another size": ({"path": "a.png", "mask": "small.png"}, Refusal, "mask: found 8 x 8 pixels, expected 40 x 40"),
    "empty mask": ({"path": "a.png", "mask": "clear.png"}, Refusal, "mask: found no white pixel"),
    "transparent": ({"path": "clear.png"}, Refusal, "example: found only transparent pixels"),
    "huge": ({"path": "huge.png"}, Refusal, "example: found 1025 x 4 pixels, expected at most 1024 x 1024"),
    "a parameter": ({"path": "a.png", "kappa": -1}, Refusal, "kappa: found -1, expected a number from 0 to 100"),
    "parameters": ({"path": "a.png", "params": "bad.toml"}, FileError, "line 2, kappa: found"),
    "strokes": ({"path": "a.png", "mask_strokes": [3]}, Refusal, "mask_strokes[0]: found 3, expected a stroke"),
    "many strokes": ({"path": "a.png", "mask_strokes": "x"}, Refusal, "mask_strokes: found"),
    "no points": ({"path": "a.png", "mask_strokes": [{}]}, Refusal, "mask_strokes[0].points"),
}


@pytest.mark.parametrize(("members", "kind", "told"), REFUSED.values(), ids=REFUSED)
def test_what_is_no_example_is_told_in_a_line(meadow, members, kind, told):
    Image.fromarray(tiny(8, 8, 255)).save(meadow / "small.png")
    Image.fromarray(tiny(40, 40, 0)).save(meadow / "clear.png")
    Image.fromarray(tiny(1025, 4, 255)).save(meadow / "huge.png")
    (meadow / "bad.toml").write_text("every = 2\nkappa = true\n")
    session = Session(folder=meadow)
    with pytest.raises(kind) as caught:
        session.do(c.parse({"do": "texture", "name": "t", "maker": "example", **members}))
    assert told in str(caught.value)
    assert "\n" not in str(caught.value)
    assert not session.painting.textures
