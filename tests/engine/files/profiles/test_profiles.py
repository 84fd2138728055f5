"""Profiles of colours: pictures become sRGB by them, screens show sRGB by them, and what lies is refused in a line."""

import struct

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from immutables import Map
from making_profiles import (
    SWAPPED,
    WIDE,
    gamma_curve,
    lcms,
    matrix_profile,
    parametric_curve,
    sampled_curve,
    srgb_bytes,
)
from PIL import Image

from engine.archive.imports import open_image
from engine.canvas.layers import EMPTY
from engine.files.fault import FileError
from engine.files.images import read_image, wants_conversion
from engine.files.profiles.converting import conversion_of
from engine.files.profiles.icc_profile import profile_of, read_profile
from engine.files.profiles.screen_table import NODES, screen_table
from engine.makers.makers import define
from engine.painting.capture import read_straight
from engine.painting.commands import DefineTexture
from engine.painting.textures import Around

RNG = np.random.default_rng(8)
CURVES = {
    "gamma": gamma_curve(1.8),
    "straight": b"curv\0\0\0\0\0\0\0\0",
    "sampled": sampled_curve(np.linspace(0, 1, 256) ** 2.1),
    "power": parametric_curve(0, 2.4),
    "of sRGB": parametric_curve(3, 2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045),
}


def noise(dtype=np.uint8, side=64):
    return RNG.integers(0, np.iinfo(dtype).max + 1, (side, side, 4)).astype(dtype)


def written(path, pixels, profile, form="PNG", mode="RGBA"):
    Image.fromarray(pixels, mode).save(path, form, icc_profile=profile)
    return path


# ---- pictures ----


@pytest.mark.parametrize("curve", CURVES)
def test_colours_become_what_littlecms_makes_of_them(curve):
    data, pixels = matrix_profile(curve=CURVES[curve]), noise()
    convert, notes = conversion_of(data, "a.png", 8)
    found = convert(pixels)
    expected = np.asarray(lcms(data, Image.fromarray(pixels[..., :3], "RGB")))
    far = abs(found[..., :3].astype(int) - expected)
    assert notes == ()
    assert far.max() <= 2  # it rounds on its way, from 8 bits to 15
    assert (far == 0).mean() > 0.9
    assert np.array_equal(found[..., 3], pixels[..., 3])


def test_sixteen_bits_stay_sixteen():
    data, pixels = matrix_profile(), noise()
    eight = conversion_of(data, "a", 8)[0](pixels)
    sixteen = conversion_of(data, "a", 16)[0](pixels.astype(np.uint16) * 257)
    assert abs(sixteen / 257 - eight).max() <= 0.5 + 1 / 257
    assert len(np.unique(sixteen & 255)) > 200


def test_greys_and_the_same_in_pieces_stay_what_they_are():
    convert = conversion_of(matrix_profile(), "a", 8)[0]
    greys = np.repeat(np.arange(256, dtype=np.uint8)[:, None], 4, 1).reshape(16, 16, 4)
    found = convert(greys)
    assert abs(found[..., :3].astype(int) - found[..., 1:2]).max() <= 1
    assert tuple(found[0, 0, :3]) == (0, 0, 0)
    assert tuple(found[15, 15, :3]) == (255, 255, 255)
    pixels = noise()
    assert np.array_equal(convert(pixels), np.concatenate([convert(pixels[:7]), convert(pixels[7:])]))


@pytest.mark.parametrize(("form", "ending"), [("PNG", "png"), ("TIFF", "tif"), ("TIFF deflated", "tif")])
def test_an_opened_picture_is_converted_and_read_plainly_it_is_as_it_was(tmp_path, form, ending):
    pixels, data = noise(), matrix_profile(primaries=SWAPPED, curve=CURVES["of sRGB"])
    pixels[..., 3] = 255
    how = {"compression": "tiff_adobe_deflate"} if "deflated" in form else {}
    Image.fromarray(pixels, "RGBA").save(tmp_path / f"a.{ending}", form.split()[0], icc_profile=data, **how)
    path = tmp_path / f"a.{ending}"
    plain, meta = read_image(path)
    converted, told = read_image(path, converted=True)
    assert np.array_equal(plain, pixels)
    assert meta.notes == ("its colour profile is not applied",)
    assert told.notes == ()
    assert abs(converted[..., :3].astype(int) - pixels[..., 2::-1]).max() <= 1  # red and blue are swapped
    assert wants_conversion(path)
    found = open_image(path)
    assert found.notes == ()


def test_what_calls_itself_srgb_is_left_alone(tmp_path):
    path = written(tmp_path / "a.png", noise(), srgb_bytes())
    assert not wants_conversion(path)
    assert np.array_equal(read_image(path)[0], read_image(path, converted=True)[0])


def test_a_picture_in_cmyk_and_a_grey_one_go_by_littlecms(tmp_path):
    grey = RNG.integers(0, 256, (16, 16), np.uint8)
    data = bytearray(matrix_profile(space=b"GRAY"))
    data = bytes(data).replace(b"rTRC", b"kTRC")
    path = tmp_path / "a.png"
    Image.fromarray(grey, "L").save(path, icc_profile=data)
    found = read_image(path, converted=True)[0]
    expected = np.asarray(lcms(data, Image.fromarray(grey, "L")))
    assert np.array_equal(found[..., :3], expected)
    cmyk = Image.fromarray(RNG.integers(0, 256, (16, 16, 4), np.uint8), "CMYK")
    cmyk.save(tmp_path / "a.jpg", icc_profile=data)
    assert "it is for L, found CMYK" in read_image(tmp_path / "a.jpg", converted=True)[1].notes[0]


def test_a_recording_says_whether_a_picture_is_converted(tmp_path):
    pixels = noise()
    pixels[..., 3] = 255
    written(tmp_path / "a.png", pixels, matrix_profile())
    as_it_is, converted = read_straight("a.png", tmp_path), read_straight("a.png", tmp_path, converted=True)
    assert not np.array_equal(as_it_is, converted)
    assert np.array_equal(as_it_is, pixels)
    around, said = Around(folder=tmp_path), Map({"path": "a.png", "profile": True})
    made = define(DefineTexture("A", "image", said), EMPTY, around)
    assert np.array_equal(made.source.pixels, converted)


# ---- the screen ----


def seen(table, pixels):
    """What a screen shows for pixels at the nodes: sent through its table."""
    at = np.searchsorted(NODES, pixels)
    return table.colours[at[..., 2], at[..., 1], at[..., 0]]


def test_a_screen_of_srgb_is_sent_what_there_is():
    table = screen_table(profile_of(srgb_bytes(), "a"))
    nodes = RNG.choice(NODES, (50, 3))
    assert np.array_equal(seen(table, nodes), nodes)
    assert (table.title, table.proof) == ("sRGB built-in", "")
    assert not table.colours.flags.writeable


def test_what_a_screen_is_sent_is_seen_as_the_colour_that_was_meant():
    profile = profile_of(matrix_profile(), "wide.icc")
    pixels = RNG.choice(NODES, (50, 1, 4)).astype(np.uint8)
    sent = np.concatenate([seen(screen_table(profile), pixels[..., :3]), pixels[..., 3:]], 2)
    back = conversion_of(profile.data, "wide.icc", 8)[0](sent)
    light = [(one[..., :3] / 255) ** 2.2 for one in (back, pixels)]
    assert abs(light[0] - light[1]).max() < 0.012  # 8 bits of a wide screen lie farther apart
    assert abs(sent[..., :3].astype(int) - pixels[..., :3]).max() > 20


def test_a_proof_shows_what_the_other_device_can():
    primaries = [tuple(0.4 * a + 0.6 * b / 3 for a, b in zip(c, (0.9642, 1.0, 0.8249), strict=True)) for c in WIDE]
    narrow = profile_of(matrix_profile("Narrow", primaries), "narrow.icc")
    whole, proof = screen_table(None), screen_table(None, narrow)
    assert (proof.title, proof.proof) == ("sRGB", "Narrow")
    assert np.ptp(proof.colours.astype(int), axis=3).max() < np.ptp(whole.colours.astype(int), axis=3).max()


# ---- what lies ----


def fault_of(work):
    """The line with which something is refused; nothing where it is not."""
    try:
        work()
    except FileError as error:
        return str(error)
    return ""


def hostile():
    good = matrix_profile()
    yield "nothing", b""
    yield "text", b"not a profile at all" * 20
    yield "no size", bytes(4) + good[4:]
    yield "a size beyond its end", struct.pack(">I", 1 << 31) + good[4:]
    yield "no tags", good[:128] + bytes(4) + good[132:]
    yield "too many tags", good[:128] + struct.pack(">I", 1 << 30) + good[132:]
    yield "a tag outside", good.replace(struct.pack(">4sI", b"rTRC", good.index(b"curv")), b"rTRC\xff\xff\xff\xff")
    yield "of a camera", good[:12] + b"link" + good[16:]
    yield "of Lab", good[:16] + b"Lab " + good[20:]
    yield "cut", good[:300]
    yield "curves of nothing", good.replace(b"curv", b"xxxx")
    yield "a curve without end", good.replace(b"curv\0\0\0\0\0\0\0\1", b"curv\0\0\0\0\x7f\xff\xff\xff")
    yield "a power of 0", good.replace(gamma_curve(2.2), gamma_curve(0.0))
    yield "no primaries", good.replace(b"rXYZ", b"xXYZ")
    yield "flat primaries", matrix_profile(primaries=[(0.0, 0.0, 0.0)] * 3)


@pytest.mark.parametrize(("what", "data"), [pytest.param(*one, id=one[0]) for one in hostile()])
def test_a_hostile_profile_is_one_line_and_the_picture_opens(tmp_path, what, data):
    path = tmp_path / "a.icc"
    path.write_bytes(data)
    line = fault_of(lambda: screen_table(read_profile(path)))
    assert not line or (line.startswith(f"{path}: ") and "\n" not in line)
    pixels = noise(side=4)
    picture = written(tmp_path / "a.png", pixels, data or None)
    found, meta = read_image(picture, converted=True)
    assert found.shape == pixels.shape
    assert len(meta.notes) <= 1
    for note in meta.notes:
        assert note.startswith("its colour profile is not applied: ")
        assert np.array_equal(found, pixels)


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_a_damaged_profile_is_used_or_refused(data):
    found = bytearray(matrix_profile())
    for _ in range(data.draw(st.integers(1, 6))):
        found[data.draw(st.integers(0, len(found) - 1))] = data.draw(st.integers(0, 255))
    pixels = noise(side=4)
    convert, notes = conversion_of(bytes(found), "a", 8)
    assert convert is None or (convert(pixels).shape == pixels.shape and notes == ())
    assert "\n" not in fault_of(lambda: screen_table(profile_of(bytes(found), "a")))


def test_a_profile_that_is_none_of_a_file_is_refused(tmp_path):
    with pytest.raises(FileError, match="cannot be read"):
        read_profile(tmp_path / "none.icc")
    with pytest.raises(FileError, match="not a regular file"):
        read_profile(tmp_path)
    with pytest.raises(FileError, match="profile of CMYK, expected one of a screen"):
        screen_table(profile_of(matrix_profile(space=b"CMYK"), "a"))
    assert profile_of(matrix_profile("A\nscreen " * 20), "a").title == ("A screen " * 20)[:80]
