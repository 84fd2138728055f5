"""Members of damaged archives: what is whole is found, nothing else is believed, and little is read for it."""

import io
import struct
import tracemalloc
import zipfile
import zlib

import numpy as np
import pytest

from engine.files import zip_salvage
from engine.files.fault import Cancelled, TooMuch
from engine.files.limits import LIMITS, Limits
from engine.files.zip_salvage import SalvagedArchive
from engine.files.zip_writer import ZipWriter

MEMBERS = {
    "mimetype": b"image/openraster",
    "a.txt": b"text " * 999,
    "b.bin": bytes(range(256)) * 9,
    "c": b"PK\3\4" * 40,
}


def written():
    file = io.BytesIO()
    writer = ZipWriter(file)
    for name, data in MEMBERS.items():
        writer.add(name, data, deflate=name == "a.txt")
    writer.close()
    return file.getvalue()


def whole(data, limits=LIMITS):
    archive = SalvagedArchive(io.BytesIO(data), "a.zip", limits)
    return {name: archive.read(name, 1 << 20) for name in archive.members}


def test_every_flip_costs_one_member_at_most():
    data = written()
    inside = []
    for place in range(0, len(data), 2):
        bad = bytearray(data)
        bad[place] ^= 1 << place % 8
        found = whole(bytes(bad))
        assert {name: found[name] for name in found if name in MEMBERS and found[name] != MEMBERS[name]} == {}
        lost = MEMBERS.keys() - found.keys()
        assert len(lost) <= 1
        inside += lost
    bodies = sum(len(body) for name, body in MEMBERS.items() if name != "a.txt")
    assert len(inside) < bodies + 200  # only in the bytes themselves: header and directory stand in for one another


def test_every_cut_leaves_what_comes_before():
    data = written()
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        stops = {
            info.filename: info.header_offset + 30 + len(info.filename) + info.compress_size
            for info in archive.infolist()
        }
    for length in range(0, len(data), 3):
        assert whole(data[:length]).keys() == {name for name, stop in stops.items() if stop <= length}


def test_what_comes_before_the_damage_is_read_of_a_torn_member():
    body = np.random.default_rng(1).integers(97, 123, 90000, np.uint8).tobytes()
    file = io.BytesIO()
    writer = ZipWriter(file)
    writer.add("log", body, deflate=True)
    writer.add("plain", body)
    data = file.getvalue()
    for length in (50, 999, 40000, 50000):
        archive = SalvagedArchive(io.BytesIO(data[:length]), "a.zip")
        found = archive.beginning("log", 1 << 20)
        assert body.startswith(found)
        assert len(found) == len(zlib.decompressobj(-15).decompress(data[33:length]))
        assert archive.beginning("log", 7) == body[:7][: len(found)]
    archive = SalvagedArchive(io.BytesIO(data[:-1]), "a.zip")
    assert archive.members.keys() == {"log"}
    assert archive.beginning("plain", 1 << 20) == body[:-1]


# ---- strangers ----


def header(name, method, data, size, stored, flags=0):
    return (
        struct.pack("<4s5H3L2H", b"PK\3\4", 20, flags, method, 0, 33, zlib.crc32(data), stored, size, len(name), 0)
        + name
    )


def plain(name, data, **told):
    return header(name, 0, data, len(data), len(data), **told) + data


NOT_BELIEVED = {
    "outside": plain(b"../a", b"x"),
    "absolute": plain(b"//a", b"x"),
    "control characters": plain(b"a\nb", b"x"),
    "no name": plain(b"", b"x"),
    "a long name": plain(b"n" * 2000, b"x"),
    "encrypted": plain(b"a", b"x", flags=1),
    "sizes that follow": plain(b"a", b"x", flags=8),
    "another method": header(b"a", 12, b"x", 1, 1) + b"x",
    "more than deflate can": header(b"a", 8, b"", 1 << 31, 9) + b"x" * 9,
    "sizes that differ": header(b"a", 0, b"xx", 2, 1) + b"xx",
    "another checksum": header(b"a", 0, b"y", 1, 1) + b"x",
    "beyond the end": header(b"a", 0, b"x", 9, 9) + b"x",
}


@pytest.mark.parametrize("data", NOT_BELIEVED.values(), ids=NOT_BELIEVED)
def test_what_is_not_believed(data):
    assert whole(data + plain(b"good", b"there")).keys() == {"good"}


def test_of_two_of_a_name_the_first_whole_one_is_taken():
    assert whole(plain(b"a", b"one") + plain(b"a", b"two")) == {"a": b"one"}
    assert whole(header(b"a", 0, b"", 3, 3) + b"one" + plain(b"a", b"two")) == {"a": b"two"}


class Counted(io.BytesIO):
    """Bytes of a file, and how many were read."""

    done = 0

    def read(self, count=-1):
        data = super().read(count)
        self.done += len(data)
        return data


def test_little_is_read_however_many_headers_claim_the_same_bytes():
    rest = 2 << 20
    heads = [header(b"%d" % n, 0, b"", rest, rest) for n in range(6000)]
    file = Counted(b"".join(heads) + bytes(rest))
    assert not SalvagedArchive(file, "a.zip").members
    assert file.done < (zip_salvage.CLAIMS + 4) * len(file.getvalue())


def test_members_and_inflated_bytes_are_bounded(monkeypatch):
    many = b"".join(plain(b"%d" % n, b"x") for n in range(50))
    assert len(whole(many, Limits(entries=20))) == 20
    with pytest.raises(TooMuch):
        whole(many, Limits(file=100))
    body = bytes(1 << 24)
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    packed = packer.compress(body) + packer.flush()
    bombs = b"".join(header(b"%d" % n, 8, body, len(body), len(packed)) + packed for n in range(4))
    monkeypatch.setattr(zip_salvage, "INFLATED", 2 << 24)
    tracemalloc.start()
    assert SalvagedArchive(io.BytesIO(bombs), "a.zip").members.keys() == {"0", "1"}
    assert tracemalloc.get_traced_memory()[1] < 8 << 20
    tracemalloc.stop()


def test_it_is_cancelled():
    with pytest.raises(Cancelled):
        SalvagedArchive(io.BytesIO(written()), "a.zip", LIMITS, lambda: True)
