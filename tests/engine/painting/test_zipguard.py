"""Archives written and read: against Python's zipfile, and archives that lie."""

import contextlib
import io
import stat
import struct
import tracemalloc
import zipfile
import zlib
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.files import zip_writer
from engine.files.fault import FileError
from engine.files.limits import LIMITS
from engine.files.zip_reader import ZipArchive, safe_name
from engine.files.zip_writer import ZipWriter


def plain(members, method=zipfile.ZIP_DEFLATED):
    """An archive by the standard library: {name: bytes}."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", method) as archive:
        for name, data in members.items():
            archive.writestr(name, data)
    return file.getvalue()


def opened(data, **limits):
    return ZipArchive(io.BytesIO(data), "a.ora", replace(LIMITS, **limits))


def everything(data, **limits):
    archive = opened(data, **limits)
    archive.check()
    return {name: archive.read(name, 1 << 20) for name in archive.members if not name.endswith("/")}


MEMBERS = {"mimetype": b"image/openraster", "stack.xml": b"<image/>" * 50, "data/layer0.png": bytes(range(256)) * 9}


# ---- what is good ----


@pytest.mark.parametrize("method", [zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED])
def test_reads_what_the_standard_library_writes(method):
    assert everything(plain(MEMBERS, method)) == MEMBERS


def test_reads_streamed_archives_with_data_descriptors():
    class Pipe(io.BytesIO):
        def seekable(self):
            return False

        def tell(self):
            raise io.UnsupportedOperation

    file = Pipe()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in MEMBERS.items():
            archive.writestr(name, data)
    assert everything(file.getvalue()) == MEMBERS


def test_reads_zip64_headers_folders_comments_and_other_alphabets():
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("data/", b"")
        with archive.open("data/größe.png", "w", force_zip64=True) as member:
            member.write(b"x" * 100)
        archive.comment = b"a comment PK\5\6 that tries"
    assert everything(file.getvalue()) == {"data/größe.png": b"x" * 100}


def test_a_leading_slash_is_let_through():
    assert everything(plain({"/data/layer0.png": b"x"})) == {"data/layer0.png": b"x"}


def written(members, deflate=True):
    file = io.BytesIO()
    writer = ZipWriter(file)
    writer.add("mimetype", b"image/openraster")
    for name, data in members.items():
        writer.add(name, data, deflate)
    with writer.stored("data/streamed.bin", 300) as sink:
        for _ in range(3):
            sink.write(b"y" * 100)
    writer.close()
    return file.getvalue(), writer


def test_what_is_written_the_standard_library_reads():
    data, writer = written({"a.txt": b"text " * 99, "b.bin": b"\x7f"})
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        assert archive.testzip() is None
        assert archive.namelist() == ["mimetype", "a.txt", "b.bin", "data/streamed.bin"]
        assert archive.read("a.txt") == b"text " * 99
        assert archive.getinfo("a.txt").compress_type == zipfile.ZIP_DEFLATED
        assert archive.getinfo("b.bin").compress_type == zipfile.ZIP_STORED
        assert archive.read("data/streamed.bin") == b"y" * 300
    assert everything(data)["data/streamed.bin"] == b"y" * 300
    assert writer.written["data/streamed.bin"].size == 300
    assert data[30:54] == b"mimetypeimage/openraster"  # where shared-mime-info looks
    assert written({"a.txt": b"text " * 99, "b.bin": b"\x7f"})[0] == data


def test_a_second_member_of_a_name_is_a_programming_error():
    writer = ZipWriter(io.BytesIO())
    writer.add("a", b"")
    with pytest.raises(ValueError, match="second"):
        writer.add("a", b"")


def test_beyond_four_gigabytes(monkeypatch):
    """The ZIP64 records, forced at small sizes: the standard library reads them."""
    monkeypatch.setattr(zip_writer, "FULL32", 200)
    monkeypatch.setattr(zip_writer, "FULL16", 2)
    file = io.BytesIO()
    writer = ZipWriter(file)
    for name in ("a", "b", "c"):
        with writer.stored(name, 1000) as sink:
            sink.write(name.encode() * 300)
    writer.close()
    data = file.getvalue().replace(struct.pack("<I", 200), b"\xff\xff\xff\xff")
    data = data[:-22] + data[-22:].replace(struct.pack("<HH", 2, 2), b"\xff\xff\xff\xff")
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        assert archive.testzip() is None
        assert archive.read("c") == b"c" * 300
    assert everything(data) == {name: name.encode() * 300 for name in "abc"}


# ---- what lies ----


def with_info(change, name="a.txt", data=b"text " * 99):
    """An archive whose one member's directory entry was changed while it was written."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(name, data)
        change(archive.infolist()[0])
    return file.getvalue()


def symlink(info):
    info.create_system, info.external_attr = 3, (stat.S_IFLNK | 0o777) << 16


def bomb(size=1 << 30):
    """A gigabyte of zeros that says so."""
    pack = zlib.compressobj(9, zlib.DEFLATED, -15)
    body = b"".join(pack.compress(bytes(1 << 20)) for _ in range(size >> 20)) + pack.flush()
    return by_hand(b"bomb", body, size)


def by_hand(name, body, size, crc=0, method=8):
    local = struct.pack("<4s5H3L2H", b"PK\3\4", 20, 0, method, 0, 33, crc, len(body), size, len(name), 0) + name
    entry = struct.pack(
        "<4s6H3L5H2L", b"PK\1\2", 20, 20, 0, method, 0, 33, crc, len(body), size, len(name), 0, 0, 0, 0, 0, 0
    )
    start = len(local) + len(body)
    end = struct.pack("<4s4H2LH", b"PK\5\6", 0, 0, 1, 1, len(entry) + len(name), start, 0)
    return local + body + entry + name + end


def end_record(**changes):
    values = {"disk": 0, "first": 0, "here": 3, "count": 3, "size": None, "offset": None, "comment": 0}
    data = plain(MEMBERS)
    fields = struct.unpack("<4s4H2LH", data[-22:])
    values.update(size=fields[5], offset=fields[6])
    values.update(changes)
    return data[:-22] + struct.pack("<4s4H2LH", b"PK\5\6", *values.values())


def same_bytes():
    """Two members of different names with one body: the kernel of an overlapping bomb."""
    data = plain({"a": b"x" * 99, "b": b"x" * 99})
    place = data.rindex(b"PK\1\2")
    return data[: place + 42] + struct.pack("<L", 0) + data[place + 46 :]


TEXT = zlib.compress(b"text " * 99)[2:-4]
CRC = zlib.crc32(b"text " * 99)
HOSTILE = {
    "nothing": (b"", "no end record"),
    "not an archive": (b"\x89PNG" * 99, "no end record"),
    "encrypted": (with_info(lambda i: setattr(i, "flag_bits", 1)), "encrypted"),
    "lzma": (plain({"a": b"x" * 999}, zipfile.ZIP_LZMA), "method 14"),
    "bzip2": (plain({"a": b"x" * 999}, zipfile.ZIP_BZIP2), "method 12"),
    "symbolic link": (with_info(symlink), "symbolic link"),
    "wrong checksum": (with_info(lambda i: setattr(i, "CRC", 1)), "checksum found"),
    "longer than it says": (by_hand(b"a", TEXT, 400, CRC), "goes on beyond"),
    "shorter than it says": (by_hand(b"a", TEXT, 600, CRC), "ends 105 bytes short"),
    "stored with two sizes": (by_hand(b"a", b"xyz", 400, method=0), "400 bytes stored as 3"),
    "a ratio that cannot be": (by_hand(b"a", TEXT, 4 << 30 - 1, CRC), "cannot be"),
    "not deflate": (by_hand(b"a", b"\xff" * 30, 100), "damaged"),
    "same name twice": (plain({"b": b"", "a": b""}).replace(b"b", b"a"), "two members"),
    "same name but for a slash": (plain({"/a": b"", "a": b""}), "two members"),
    "shared bytes": (same_bytes(), "share bytes"),
    "65,535 members, says the end": (end_record(here=65534, count=65534), "expected at most"),
    "4 members of 3": (end_record(here=4, count=4), "ends at member 3"),
    "2 members of 3": (end_record(here=2, count=2), "belong to no member"),
    "several disks": (end_record(disk=1), "several parts"),
    "huge directory": (end_record(size=0xFFFFFFF0), "directory of 4294967280"),
    "directory elsewhere": (end_record(offset=3), "expected it to end at"),
    "comment beyond the end": (end_record(comment=9), "no end record"),
    "ZIP64 without a record": (end_record(count=0xFFFF, here=0xFFFF), "expected at most"),
    "other name in the header": (plain(MEMBERS).replace(b"mimetype", b"mimetypf", 1), "differs"),
    "name of 2,000 letters": (plain({"a" * 2000: b""}), "2000 bytes"),
    "name that is not UTF-8": (
        plain({"ä": b""}).replace("ä".encode(), b"\xff\xff"), "not UTF-8"
    ),
}  # fmt: skip
NAMES = ["../a", "a/../../b", "..", "/..", "//a", "a//b", "a\\b", "C:/a", "C:\\a", "./a", "/", "a\nb", "a\x7f"]


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile(name):
    data, expected = HOSTILE[name]
    with pytest.raises(FileError) as caught:
        everything(data)
    assert str(caught.value).startswith("a.ora: ")
    assert expected in str(caught.value)
    assert str(caught.value).isprintable()


@pytest.mark.parametrize("name", NAMES)
def test_names_that_lead_outside(name):
    assert not safe_name(name)
    with pytest.raises(FileError, match="outside the archive"):
        opened(by_hand(name.encode(), b"", 0, method=0))


def test_too_many_members_are_refused_before_they_are_read():
    data = plain({f"m{i}": b"" for i in range(300)})
    with pytest.raises(FileError, match="300 members; expected at most 299"):
        opened(data, entries=299)
    assert len(opened(data, entries=300).members) == 300


def test_a_bomb_costs_no_memory():
    data = bomb(256 << 20)
    tracemalloc.start()
    try:
        with pytest.raises(FileError, match="expected at most 8388608"):
            opened(data).read("bomb", 8 << 20)
        stream = opened(data).open("bomb")
        for _ in range(99):
            assert len(stream.read(1 << 16)) == 1 << 16
        assert tracemalloc.get_traced_memory()[1] < 4 << 20
    finally:
        tracemalloc.stop()


def test_every_truncation_is_refused():
    data = plain(MEMBERS)
    for length in range(len(data)):
        with pytest.raises(FileError):
            opened(data[:length])


@settings(deadline=None, max_examples=300)
@given(st.lists(st.floats(0, 0.99999), min_size=1, max_size=3))
def test_flipped_bits_raise_nothing_else(places):
    data = bytearray(plain(MEMBERS))
    for place in places:
        bit = int(place * 8 * len(data))
        data[bit // 8] ^= 1 << bit % 8
    with contextlib.suppress(FileError):
        everything(bytes(data))


@settings(deadline=None, max_examples=60)
@given(st.binary(max_size=200))
def test_noise_after_a_signature(noise):
    with contextlib.suppress(FileError):
        everything(b"PK\3\4" + noise + b"PK\5\6" + noise[:18].ljust(18, b"\0"))
