"""Palettes of other programs: read as they are, and refused in a line where they are damaged."""

import contextlib
import io
import struct
import zipfile

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from engine.files.fault import FileError
from engine.files.swatches.colour_list import ColourList, NamedColour, plain_name
from engine.files.swatches.gpl import gpl_text, read_gpl
from engine.files.swatches.palette_files import READERS, read_palette

NAMES = st.text(max_size=12).map(plain_name)
COLOURS = st.lists(st.builds(NamedColour, st.tuples(*[st.integers(0, 255).map(lambda v: v / 255)] * 3), NAMES))


def rgb8(palette):
    return [tuple(round(255 * v) for v in rgb) for rgb, _ in palette.colours]


DIALECTS = {  # as GIMP, Inkscape, MyPaint and older programs write them
    "named": b"GIMP Palette\nName: Sea\nColumns: 4\n# By the sea\n#\n  0  64 128\tDeep water\n255 255 255\tFoam\n",
    "without columns": b"GIMP Palette\nName: Sea\n#\n  0  64 128\n255 255 255\tUntitled\n",
    "a comment between": b"GIMP Palette\nName: Sea (old)\nColumns: 16\n  0  64 128\tgrey0\n# more\n255 255 255 \tw\n",
    "spaces": b"GIMP Palette\nName: Sea\n#\n  0 64 128      Deep   water\n255 255 255\n\n",
    "no name": b"GIMP Palette\n#\n0 64 128\n255 255 255\n",
    "other line ends": b"GIMP Palette\r\nName: Sea\r\nColumns: 3\r\n0 64 128 Deep\r\n255 255 255 Foam\r\n",
}


@pytest.mark.parametrize("data", DIALECTS.values(), ids=DIALECTS)
def test_palettes_of_other_programs_are_read_and_written_again(data, tmp_path):
    path = tmp_path / "sea.gpl"
    path.write_bytes(data)
    found = read_palette(path)
    assert rgb8(found) == [(0, 64, 128), (255, 255, 255)]
    assert read_gpl(gpl_text(found).encode(), path.name) == found


@settings(deadline=None)
@given(NAMES, COLOURS, st.integers(0, 64))
def test_a_palette_that_is_written_is_read_again(name, colours, columns):
    palette = ColourList(name, tuple(colours), columns)
    assert read_gpl(gpl_text(palette).encode(), "a.gpl") == palette


GPL = b"GIMP Palette\n"


@pytest.mark.parametrize(
    ("data", "told"),
    [
        (b"", "a.gpl: line 1: found ''"),
        (b"JASC-PAL\n", "a.gpl: line 1"),
        (GPL + b"1 2\n", "a.gpl: line 2: found"),
        (GPL + b"256 0 0\n", "a.gpl: line 2"),
        (GPL + b"#\n\n-1 0 0\n", "a.gpl: line 4"),
        (GPL + b"0 0 0\n" * 10_001, "a.gpl: more than 10000 colours"),
        (GPL + bytes(range(128, 256)), "a.gpl: line 2"),
    ],
)
def test_a_damaged_gpl_names_its_line(data, told):
    with pytest.raises(FileError) as error:
        read_gpl(data, "a.gpl")
    assert str(error.value).startswith(told)
    assert "\n" not in str(error.value)


def utf16(text):
    return (text + "\0").encode("utf-16-be")


def aco():
    rows = [(0, 65535, 0, 0, 0), (1, 21845, 65535, 65535, 0), (2, 65535, 65535, 0, 65535), (7, 10000, 0, 0, 0)]
    rows += [(8, 0, 0, 0, 0), (3, 1, 2, 3, 4)]
    first = struct.pack(">2H", 1, len(rows)) + b"".join(struct.pack(">5H", *row) for row in rows)
    second = struct.pack(">2H", 2, len(rows))
    for i, row in enumerate(rows):
        second += struct.pack(">5HI", *row, 2) + utf16("abcdef"[i])
    return first, first + second


def ase():
    def block(kind, body):
        return struct.pack(">HI", kind, len(body)) + body

    def colour(name, model, *values):
        text = utf16(name)
        return block(1, struct.pack(">H", len(text) // 2) + text + model + struct.pack(f">{len(values)}fH", *values, 0))

    blocks = [
        block(0xC001, struct.pack(">H", 2) + utf16("g")),
        colour("red", b"RGB ", 1.0, 0.0, 0.0),
        colour("yellow", b"CMYK", 0.0, 0.0, 1.0, 0.0),
        colour("white", b"LAB ", 1.0, 0.0, 0.0),
        colour("half", b"Gray", 0.5),
        block(0xC002, b""),
    ]
    return b"ASEF" + struct.pack(">2HI", 1, 0, len(blocks)) + b"".join(blocks)


XML = """<Colorset name="K" columns="2" rows="2"><ColorSetEntry name="b" bitdepth="U8"><RGB r="0" g="0" b="1"/>
<Position row="1" column="0"/></ColorSetEntry><ColorSetEntry name="r" bitdepth="U8"><sRGB r="1" g="0" b="0"/>
<Position row="0" column="1"/></ColorSetEntry><Group name="g"><ColorSetEntry name="grey"><Gray g="0.2"/></ColorSetEntry>
</Group></Colorset>"""


def kpl(text=XML, name="colorset.xml"):
    held = io.BytesIO()
    with zipfile.ZipFile(held, "w") as archive:
        archive.writestr("mimetype", "application/x-krita-palette")
        archive.writestr(name, text)
    return held.getvalue()


def test_photoshops_colours_are_read_with_names_where_there_are_any():
    short, whole = (READERS[".aco"](data, "a.aco") for data in aco())
    wanted = [(255, 0, 0), (0, 255, 0), (255, 255, 0), (255, 255, 255), (255, 255, 255)]
    assert all(abs(a - b) <= 1 for c, d in zip(rgb8(whole), wanted, strict=True) for a, b in zip(c, d, strict=True))
    assert rgb8(short) == rgb8(whole)
    assert [name for _, name in whole.colours] == list("abcde")


def test_adobes_swatches_are_read_through_their_groups():
    found = READERS[".ase"](ase(), "a.ase")
    assert [name for _, name in found.colours] == ["red", "yellow", "white", "half"]
    assert rgb8(found)[:2] == [(255, 0, 0), (255, 255, 0)]
    assert all(v >= 254 for v in rgb8(found)[2])
    assert rgb8(found)[3] == (128, 128, 128)


def test_kritas_palettes_are_read_in_the_order_of_their_places():
    found = READERS[".kpl"](kpl(), "a.kpl")
    assert (found.name, found.columns) == ("K", 2)
    assert [name for _, name in found.colours] == ["r", "b", "grey"]
    assert rgb8(found) == [(255, 0, 0), (0, 0, 255), (51, 51, 51)]


BOMB = '<!DOCTYPE a [<!ENTITY x "xxxxxxxxxx">]><Colorset>&x;</Colorset>'
HOSTILE = [kpl(BOMB), kpl("<a/>"), kpl("<"), kpl(name="x.xml"), kpl(XML.replace('r="0"', 'r="nan"')), b"PK", b""]


@pytest.mark.parametrize("data", HOSTILE)
def test_a_hostile_kpl_is_refused_in_a_line(data):
    with pytest.raises(FileError) as error:
        READERS[".kpl"](data, "a.kpl")
    assert "\n" not in str(error.value)


@settings(deadline=None)
@given(st.sampled_from([".aco", ".ase", ".kpl", ".gpl"]), st.data())
def test_damaged_bytes_give_a_palette_or_are_refused(ending, data):
    held = bytearray({".aco": aco()[1], ".ase": ase(), ".kpl": kpl(), ".gpl": GPL + b"1 2 3\tx\n"}[ending])
    for _ in range(data.draw(st.integers(0, 4))):
        held[data.draw(st.integers(0, len(held) - 1))] = data.draw(st.integers(0, 255))
    del held[data.draw(st.integers(0, len(held))) :]
    with contextlib.suppress(FileError):
        found = READERS[ending](bytes(held), f"a{ending}")
        assert all(0.0 <= v <= 1.0 for rgb, _ in found.colours for v in rgb)


@settings(deadline=None)
@given(st.sampled_from([".aco", ".ase"]), st.binary(max_size=64))
@example(".aco", struct.pack(">2H", 1, 65535))
@example(".ase", b"ASEF" + struct.pack(">2HI", 1, 0, 2**32 - 1))
def test_bytes_of_any_kind_are_refused_at_once(ending, data):
    with contextlib.suppress(FileError):
        READERS[ending](data, "a")
