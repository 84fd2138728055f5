"""Pictures and files of layers that lie, are cut short, or hold far more than they may, by what is wrong with them."""

import io
import struct
import zipfile
import zlib
from collections.abc import Iterator

import numpy as np
from PIL import Image

WIDE, HIGH = 30, 20
PIXELS = (np.mgrid[:HIGH, :WIDE].sum(axis=0)[..., None] * [3, 5, 2, 1] % 256).astype(np.uint8)
BOMB = 1 << 24  # bytes, that a few thousand tell


def _by_pillow(mode: str, form: str, **more: object) -> bytes:
    out = io.BytesIO()
    Image.fromarray(PIXELS).convert("RGB").convert(mode).save(out, form, **more)
    return out.getvalue()


def _tiff(pixels: np.ndarray, **more: object) -> bytes:
    import tifffile  # here: the suite goes without

    out = io.BytesIO()
    tifffile.imwrite(out, pixels, **more)
    return out.getvalue()


def chunk(kind: bytes, data: bytes, wrong: int = 0) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data) ^ wrong)


def png(head: tuple[int, int, int, int], *chunks: bytes, last: bytes = b"IEND") -> bytes:
    """A PNG by hand: `head` width, height, depth and kind of colour."""
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">IIBBBBB", *head, 0, 0, 0))
        + b"".join(chunks)
        + chunk(last, b"")
    )


def _data(raw: bytes) -> bytes:
    return chunk(b"IDAT", zlib.compress(raw, 9))


ROWS = bytes(HIGH * (1 + 4 * WIDE))


def _pngs() -> dict[str, bytes]:
    bomb = _data(bytes(BOMB))
    profile = b"a\0\0" + zlib.compress(bytes(BOMB), 9)
    return {
        "a png of 2^31 columns": png((2**31 - 1, 2, 8, 6), _data(b"\0" * 99)),
        "a png of 65535 x 65535": png((65535, 65535, 8, 6), bomb),
        "a png of no columns": png((0, 5, 8, 6), _data(b"")),
        "a png of depth 3": png((WIDE, HIGH, 3, 6), _data(ROWS)),
        "a png of colours of kind 5": png((WIDE, HIGH, 8, 5), _data(ROWS)),
        "a png without pixels": png((WIDE, HIGH, 8, 6)),
        "a png of too many pixels": png((WIDE, HIGH, 8, 6), bomb),
        "a png of filter 9": png((WIDE, HIGH, 8, 6), _data(b"\x09" * len(ROWS))),
        "a png of a palette that is not there": png((WIDE, HIGH, 8, 3), _data(b"\0" * (HIGH * (1 + WIDE)))),
        "a png of a palette too short": png(
            (WIDE, HIGH, 8, 3), chunk(b"PLTE", b"abc"), _data((b"\0" + b"\xff" * WIDE) * HIGH)
        ),
        "a png of a wrong sum": png((WIDE, HIGH, 8, 6), chunk(b"IDAT", zlib.compress(ROWS), 1)),
        "a png whose text is a bomb": png((WIDE, HIGH, 8, 6), chunk(b"zTXt", profile), _data(ROWS)),
        "a png whose profile is a bomb": png((WIDE, HIGH, 8, 6), chunk(b"iCCP", profile), _data(ROWS)),
    }


def _cut(data: bytes, ending: str, name: str) -> Iterator[tuple[str, str, bytes]]:
    for part in (0.02, 0.4, 0.97):
        yield f"{name} cut at {part:.0%}", ending, data[: int(len(data) * part)]


def _ora(stack: str, *members: tuple[str, bytes]) -> bytes:
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("mimetype", "image/openraster", zipfile.ZIP_STORED)
        file.writestr("stack.xml", stack)
        for name, data in members:
            file.writestr(name, data)
    return out.getvalue()


def _stack(inside: str, width: object = WIDE, height: object = HIGH) -> str:
    return f'<image w="{width}" h="{height}"><stack>{inside}</stack></image>'


LAYER = '<layer name="a" src="data/a.png" {}/>'
LAUGHS = "".join(f'<!ENTITY l{i + 1} "{f"&l{i};" * 10}">' for i in range(9))
STACKS = {
    "an ora of no stack": "",
    "an ora of a stack that ends": "<image><stack>",
    "an ora of ten thousand groups": _stack("<stack>" * 10000 + "</stack>" * 10000),
    "an ora of a billion laughs": f'<!DOCTYPE a [<!ENTITY l0 "ha">{LAUGHS}]>' + _stack('<layer name="&l9;"/>'),
    "an ora that reads a file": '<!DOCTYPE a [<!ENTITY e SYSTEM "file:///etc/hostname">]>'
    + _stack('<layer name="&e;"/>'),
    "an ora of no size": _stack(LAYER.format(""), 0, -4),
    "an ora of a size of 400 digits": _stack(LAYER.format(""), 10**400),
    "an ora whose layer lies far away": _stack(LAYER.format(f'x="{10**400}" y="-99999999999"')),
    "an ora of an opacity of nan": _stack(LAYER.format('opacity="nan"')),
    "an ora of a layer that is not there": _stack('<layer name="a" src="data/b.png"/>'),
    "an ora of a layer above its folder": _stack('<layer name="a" src="../../../etc/hostname"/>'),
    "an ora of 4000 layers of one picture": _stack(LAYER.format("") * 4000),
    "an ora of a name of a megabyte": _stack(LAYER.format("").replace('"a"', f'"{"n" * (1 << 20)}"')),
}


def _psd() -> bytes:
    from psd_tools import PSDImage  # likewise

    image = PSDImage.new("RGB", (WIDE, HIGH))
    image.create_pixel_layer(Image.fromarray(PIXELS), name="one")
    group = image.create_group(name="group")
    group.create_pixel_layer(Image.fromarray(PIXELS), name="two", top=3, left=-4)
    out = io.BytesIO()
    image.save(out)
    return out.getvalue()


def _patched(data: bytes, at: int, form: str, value: int) -> bytes:
    return data[:at] + struct.pack(form, value) + data[at + struct.calcsize(form) :]


def _psds() -> Iterator[tuple[str, str, bytes]]:
    whole = _psd()
    yield "a psd", ".psd", whole
    yield from _cut(whole, ".psd", "a psd")
    for name, at, form, value in (
        ("of 2^31 rows", 14, ">I", 2**31 - 1),
        ("of no columns", 18, ">I", 0),
        ("of 60 channels", 12, ">H", 60),
        ("of depth 7", 22, ">H", 7),
        *((f"of mode {mode}", 24, ">H", mode) for mode in (0, 2, 4, 7, 8, 9, 77)),
        ("of 2^32 bytes of colours", 26, ">I", 2**32 - 1),
        ("of 2^32 bytes of resources", 30, ">I", 2**32 - 1),
    ):
        yield f"a psd {name}", ".psd", _patched(whole, at, form, value)


def _tiffs() -> Iterator[tuple[str, str, bytes]]:
    floats = PIXELS.astype(np.float32) / 255
    for name, value in (("nan", np.nan), ("inf", np.inf), ("1e38", 1e38), ("-1e38", -1e38)):
        yield f"a tiff of {name}", ".tif", _tiff(np.full((HIGH, WIDE, 3), value, np.float32), photometric="rgb")
    for kind in (np.float16, np.float64, np.int8, np.int32, np.uint32, np.complex64, np.bool_):
        yield f"a tiff of {kind.__name__}", ".tif", _tiff(floats[..., 0].astype(kind), photometric="minisblack")
    yield "a tiff of planes", ".tif", _tiff(np.moveaxis(PIXELS, 2, 0), planarconfig="separate", photometric="rgb")
    yield "a tiff of five pages", ".tif", _tiff(np.stack([PIXELS] * 5), photometric="rgb")
    yield "a big tiff in tiles", ".tif", _tiff(PIXELS, bigtiff=True, tile=(16, 16), photometric="rgb")
    whole = _tiff(PIXELS, photometric="rgb", compression="zlib")
    yield from _cut(whole, ".tif", "a tiff")
    yield "a tiff whose table follows itself", ".tif", whole.replace(struct.pack("<I", 0), struct.pack("<I", 8))


def _others() -> Iterator[tuple[str, str, bytes]]:
    for mode in ("1", "L", "LA", "P", "RGB", "RGBA", "I;16"):
        yield f"a png of mode {mode}", ".png", _by_pillow(mode, "PNG")
    for mode in ("L", "RGB", "CMYK"):
        yield f"a jpeg of mode {mode}", ".jpg", _by_pillow(mode, "JPEG")
    jpeg, whole = _by_pillow("RGB", "JPEG"), _by_pillow("RGBA", "PNG")
    yield from _cut(whole, ".png", "a png")
    yield from _cut(jpeg, ".jpg", "a jpeg")
    at = jpeg.index(b"\xff\xc0") + 5
    yield "a jpeg of 65535 x 65535", ".jpg", _patched(jpeg, at, ">I", 0xFFFFFFFF)
    yield "a jpeg of no rows", ".jpg", _patched(jpeg, at, ">H", 0)
    yield "a gif", ".gif", _by_pillow("P", "GIF")
    yield "a webp that is a png", ".png", _by_pillow("RGB", "WEBP")
    yield "a png that is a bmp", ".png", _by_pillow("RGB", "BMP")
    yield "nothing", ".png", b""
    yield "text", ".jpg", b"not a picture\n" * 99
    yield "noughts", ".tif", bytes(9999)


def quick_ones() -> Iterator[tuple[str, str, bytes]]:
    """Those that are made at once: by name, a file's ending and bytes."""
    one = ("data/a.png", _by_pillow("RGBA", "PNG"))
    yield from _others()
    yield from ((name, ".ora", _ora(stack, one)) for name, stack in STACKS.items())
    yield from _cut(_ora(_stack(LAYER.format("")), one), ".ora", "an ora")


def all_of_them() -> Iterator[tuple[str, str, bytes]]:
    """As `quick_ones`, and all others."""
    pngs, plain = _pngs(), _stack(LAYER.format(""))
    yield from quick_ones()
    yield from ((name, ".png", data) for name, data in pngs.items())
    yield from ((f"an ora of {name}", ".ora", _ora(plain, ("data/a.png", data))) for name, data in pngs.items())
    yield "an ora of a bomb", ".ora", _ora(plain, ("data/b.png", bytes(BOMB)))
    yield from _psds()
    yield from _tiffs()
