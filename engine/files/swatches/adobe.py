"""Palettes of Photoshop, `.aco`, and Adobe's swatches for exchange, `.ase`.

After "Adobe Photoshop File Formats Specification" (Color Swatches) and the layout of ASEF as its readers have it: both
big-endian, names in UTF-16.  Colours that are none of the screen's are taken as near as simple formulas come to them:
CMYK without a profile, Lab under D50.
"""

from __future__ import annotations

import colorsys

from engine.files.big_endian import BigEndian
from engine.files.fault import FileError
from engine.files.swatches.colour_list import MOST_COLOURS, ColourList, NamedColour, plain_name

_RGB = tuple[float, float, float]
_D50 = 0.9642, 1.0, 0.8249
_TO_SRGB = (  # linear, from XYZ under D50, by Bradford
    (3.1338561, -1.6168667, -0.4906146),
    (-0.9787684, 1.9161415, 0.0334540),
    (0.0719453, -0.2289914, 1.4052427),
)
_IN = "a colour"  # what the file may end in
_GROUP, _GROUP_END, _COLOUR = 0xC001, 0xC002, 0x0001


def read_aco(data: bytes, file: str) -> ColourList:
    """Returns the palette; names where the second version of it is there, too."""
    reader = BigEndian(data, file)
    colours = _aco_part(reader, file, 1)
    if reader.left >= 4:
        colours = _aco_part(reader, file, 2)
    return ColourList("", tuple(colours))


def _aco_part(reader: BigEndian, file: str, wanted: int) -> list[NamedColour]:
    version, count = reader.number("H", _IN), reader.number("H", _IN)
    if version != wanted and not (wanted == 1 and version == 2):
        raise FileError(file, f"found version {version} of its colours, expected {wanted}")
    if count > MOST_COLOURS:
        raise FileError(file, f"found {count} colours, expected at most {MOST_COLOURS}")
    colours = []
    for _ in range(count):
        space, *values = (int(value) for value in reader.take("5H", _IN))
        name = plain_name(reader.text(reader.number("I", _IN), "a name")) if version == 2 else ""
        rgb = _aco_colour(space, values)
        if rgb is not None:
            colours.append(NamedColour(rgb, name))
    return colours


def _aco_colour(space: int, values: list[int]) -> _RGB | None:
    """Returns a colour of one of Photoshop's spaces; None for those of printers' books."""
    w, x, y, z = values
    if space == 0:
        return w / 65535, x / 65535, y / 65535
    if space == 1:
        return colorsys.hsv_to_rgb(w / 65536, x / 65535, y / 65535)
    if space == 2:
        return _cmyk(1 - w / 65535, 1 - x / 65535, 1 - y / 65535, 1 - z / 65535)
    if space == 7:
        a, b = (value - 65536 if value > 32767 else value for value in (x, y))
        return _lab(w / 100, a / 100, b / 100)
    if space == 8:
        return (1 - min(w, 10000) / 10000,) * 3
    if space == 9:
        return _cmyk(*(min(value, 10000) / 10000 for value in values))
    return None


def read_ase(data: bytes, file: str) -> ColourList:
    """Returns the palette, its groups one after another."""
    reader = BigEndian(data, file)
    magic, major, _minor = reader.take("4sHH", _IN)
    if magic != b"ASEF" or major != 1:
        raise FileError(file, "found no ASEF of version 1 at its beginning")
    colours: list[NamedColour] = []
    for _ in range(reader.number("I", _IN)):
        kind, length = reader.number("H", _IN), reader.number("I", _IN)
        end = reader.at + length
        if length > reader.left:
            raise FileError(file, f"byte {reader.at}: a block of {length} bytes, {reader.left} are left")
        if kind == _COLOUR:
            if len(colours) == MOST_COLOURS:
                raise FileError(file, f"more than {MOST_COLOURS} colours")
            name = plain_name(reader.text(reader.number("H", _IN), "a name"))
            colours.append(NamedColour(_ase_colour(reader, file), name))
        elif kind not in (_GROUP, _GROUP_END):
            raise FileError(file, f"byte {reader.at}: found a block of kind {kind:#x}, expected a colour or a group")
        if reader.at > end:
            raise FileError(file, f"byte {end}: a block ends inside its colour")
        reader.at = end
    return ColourList("", tuple(colours))


def _ase_colour(reader: BigEndian, file: str) -> _RGB:
    model = reader.take("4s", _IN)[0]
    count = {b"RGB ": 3, b"CMYK": 4, b"LAB ": 3, b"Gray": 1}.get(bytes(model) if isinstance(model, bytes) else b"")
    if count is None:
        raise FileError(file, f"byte {reader.at}: found a colour model {model!r}, expected RGB, CMYK, LAB or Gray")
    values = [float(value) for value in reader.take(f"{count}f", _IN)]
    if not all(abs(value) < 1e4 for value in values):
        raise FileError(file, f"byte {reader.at}: found a colour that is no number")
    if count == 4:
        return _cmyk(*values)
    if model == b"LAB ":
        return _lab(values[0] * 100, values[1], values[2])
    r, g, b = (values * 3)[:3] if count == 1 else values
    return _held(r), _held(g), _held(b)


def _cmyk(c: float, m: float, y: float, k: float) -> _RGB:
    r, g, b = (_held((1 - part) * (1 - k)) for part in (c, m, y))
    return r, g, b


def _lab(light: float, a: float, b: float) -> _RGB:
    fy = (light + 16) / 116
    xyz = [w * _cubed(f) for w, f in zip(_D50, (fy + a / 500, fy, fy - b / 200), strict=True)]
    linear = (sum(m * v for m, v in zip(row, xyz, strict=True)) for row in _TO_SRGB)
    red, green, blue = (_held(_encoded(v)) for v in linear)
    return red, green, blue


def _cubed(f: float) -> float:
    return f**3 if f > 6 / 29 else 3 * (6 / 29) ** 2 * (f - 4 / 29)


def _encoded(v: float) -> float:
    return 12.92 * v if v <= 0.0031308 else 1.055 * v ** (1 / 2.4) - 0.055


def _held(v: float) -> float:
    return min(1.0, max(0.0, v))
