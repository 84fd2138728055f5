"""Files of brushes in the dialects of other programs, written for tests."""

import json
import struct
import zlib

import numpy as np

RNG = np.random.default_rng(3)
TIP = RNG.integers(1, 256, (9, 14)).astype(np.uint8)  # rows, columns: of uneven sides


def gbr(pixels, name="Leaf ü", spacing=30, version=2):
    """`pixels`: uint8 (h, w) or (h, w, 4)."""
    told = name.encode() + b"\0"
    body, channels = pixels.tobytes(), 1 if pixels.ndim == 2 else 4
    size = (20 if version == 1 else 28) + len(told)
    head = struct.pack(">5I", size, version, pixels.shape[1], pixels.shape[0], channels)
    return head + (struct.pack(">4sI", b"GIMP", spacing) if version == 2 else b"") + told + body


def gih(cells, name="Leaves"):
    head = f"{name}\n{len(cells)} ncells:{len(cells)} dim:1 rank0:{len(cells)} sel0:random\n"
    return head.encode() + b"".join(gbr(cell) for cell in cells)


def packed_rows(pixels):
    """PackBits, a row after its length: runs where two are alike, literals elsewhere."""
    rows = []
    for row in pixels.view(np.uint8).reshape(len(pixels), -1):
        out, k = bytearray(), 0
        while k < len(row):
            n = 1
            while k + n < len(row) and row[k + n] == row[k] and n < 128:
                n += 1
            out += bytes([257 - n, row[k]]) if n > 1 else bytes([0, row[k]])
            k += n
        rows.append(bytes(out))
    return struct.pack(f">{len(rows)}H", *map(len, rows)) + b"".join(rows)


def channel(pixels, packed, sign="i"):
    depth = 8 * pixels.itemsize
    body = packed_rows(pixels) if packed else pixels.tobytes()
    return struct.pack(f">4{sign}HB", 3, 5, 3 + len(pixels), 5 + pixels.shape[1], depth, packed) + body


def utf16(text):
    return struct.pack(">I", len(text) + 1) + (text + "\0").encode("utf-16-be")


def abr_of_records(version, *records):
    """`records`: (kind, bytes)."""
    return struct.pack(">HH", version, len(records)) + b"".join(
        struct.pack(">HI", kind, len(body)) + body for kind, body in records
    )


def sampled(pixels, packed, name=None, spacing=50):
    told = b"" if name is None else utf16(name)
    return struct.pack(">IH", 0, spacing) + told + struct.pack(">B4h", 1, 0, 0, 9, 9) + channel(pixels, packed)


def computed(diameter=40, hardness=60, roundness=50, angle=30, spacing=25):
    return struct.pack(">IHHHhH", 0, spacing, diameter, roundness, angle, hardness)


def block(kind, body, pad=True):
    return b"8BIM" + kind + struct.pack(">I", len(body)) + body + b"\0" * (-len(body) % 4 if pad else 0)


def tip_item(name, pixels, minor, packed):
    told = bytes([len(name)]) + name.encode()
    if minor == 1:
        body = told + bytes(10) + channel(pixels, packed)
    else:
        record = channel(pixels, packed, "I")
        body = told + struct.pack(">2H2I4II", 1, 0, 3, 0, 0, 0, 9, 9, 4)
        body += bytes(12) + struct.pack(">3I", 1, 4 + len(record), 8) + record + bytes(8)
    return struct.pack(">I", len(body)) + body + bytes(-len(body) % 4)


def named(name):
    return (struct.pack(">I", 0) if len(name) == 4 else struct.pack(">I", len(name))) + name.encode()


def value(given):
    """A value of a descriptor: bool, int, float (with a unit), str, list or (class, {name: value})."""
    if isinstance(given, bool):
        return b"bool" + bytes([given])
    if isinstance(given, int):
        return b"long" + struct.pack(">i", given)
    if isinstance(given, float):
        return b"UntF" + b"#Prc" + struct.pack(">d", given)
    if isinstance(given, str):
        return b"TEXT" + utf16(given)
    if isinstance(given, list):
        return b"VlLs" + struct.pack(">I", len(given)) + b"".join(map(value, given))
    return b"Objc" + members(*given)


def members(kind, given):
    head = utf16("") + named(kind) + struct.pack(">I", len(given))
    return head + b"".join(named(name) + value(part) for name, part in given.items())


def abr_of_blocks(minor, tips, presets=None, packed=True):
    """`tips`: {name: pixels}; `presets`: values of a descriptor."""
    body = b"".join(tip_item(name, pixels, minor, packed) for name, pixels in tips.items())
    told = b"" if presets is None else struct.pack(">I", 16) + members("null", {"Brsh": presets})
    blocks = block(b"samp", body) + block(b"patt", b"") + (block(b"desc", told, False) if told else b"")
    return struct.pack(">HH", 6, minor) + blocks


def png_chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def png(pixels, *texts):
    """`pixels`: uint8 (h, w) or (h, w, 4); `texts`: chunks."""
    height, width = pixels.shape[:2]
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    head = struct.pack(">IIBBBBB", width, height, 8, 0 if pixels.ndim == 2 else 6, 0, 0, 0)
    parts = png_chunk(b"IHDR", head), *texts, png_chunk(b"IDAT", zlib.compress(rows)), png_chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts)


def kpp(params, kind="zTXt", resources="", engine="paintbrush"):
    inner = "".join(f'<param name="{name}" type="string"><![CDATA[{text}]]></param>' for name, text in params.items())
    xml = f'<Preset paintopid="{engine}" name="b)_My_brush">{resources}{inner}</Preset>'.encode()
    body = {
        "tEXt": b"preset\0" + xml,
        "zTXt": b"preset\0\0" + zlib.compress(xml),
        "iTXt": b"preset\0\1\0\0\0" + zlib.compress(xml),
    }[kind]
    return png(np.zeros((4, 4), np.uint8), png_chunk(kind.encode(), body))


def myb(version=3, **settings):
    """`settings`: a base value, or (base value, {input: points})."""
    told = {}
    for name, given in settings.items():
        base, inputs = given if isinstance(given, tuple) else (given, {})
        told[name] = {"base_value": base, "inputs": inputs}
    return json.dumps({"version": version, "group": "", "comment": "", "settings": told}).encode()
