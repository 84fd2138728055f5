"""The maps of an example, as a definition or the example's parameter file tells them: planes of its control channels.

{"orientation": {"strokes": [...]}, "rim": {"width": 40}, "size": "sizes.png"}: each a picture as large as the example,
or an object with `path` or nothing, and `strokes` on it, in pixels of the example, besides how the channel counts.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from engine.brush.checks import thawed
from engine.brush.footprint import Footprint
from engine.checks.field_error import FieldError
from engine.checks.values import described
from engine.files.fault import FileError
from engine.files.images import read_image
from engine.files.strict_json import Fields
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.strokes.example_files import read_mask
from engine.texture.example.control import MOST_CHANNELS, Channel, Channels, ordered, rim_of
from engine.texture.example.controlled import analysed_with
from engine.texture.example.exemplar import Exemplar
from engine.texture.example.flow import flow_around
from engine.texture.example.parameters import ORIENTATION, RIM_CHANNEL, Parameters
from engine.texture.image import ImageSource

MAP_STROKES_CAP = 4096
_MEMBERS = "path", "strokes", "weight", "turns", "width"
_TURNS, _MOST_TURNS = 24, 36
_WIDTH, _WIDEST = 32, 160
_STEP = 4.0  # px between places of a stroke that tells an orientation, at least
_LINES_CAP = 1 << 14


class Given(NamedTuple):
    """A map as it is told: its channel, the path of its picture, and strokes."""

    channel: Channel
    path: str | None
    strokes: list[object]


def read_maps(value: object, place: str = "maps") -> tuple[Given, ...]:
    """Returns the maps that an object tells, in the order of their planes.  FieldError names the member."""
    if not isinstance(value, Mapping) or len(value) > MOST_CHANNELS:
        raise FieldError(place, described(value), f"an object of at most {MOST_CHANNELS} maps")
    found = {name: _given(name, thawed(told), f"{place}.{name}") for name, told in value.items()}
    return tuple(found[channel.name] for channel in ordered([one.channel for one in found.values()]))


def _given(name: str, told: object, place: str) -> Given:
    if isinstance(told, str):
        told = {"path": told}
    if not isinstance(told, Mapping):
        raise FieldError(place, described(told), 'a path, or an object {"strokes": [...]}')
    unknown = [member for member in told if member not in _MEMBERS]
    if unknown:
        raise FieldError(f"{place}.{unknown[0]}", "an unknown member", f"one of {', '.join(_MEMBERS)}")
    members = Fields(told, place)
    path = members.text("path", cap=4096) if "path" in members else None
    strokes = members.take("strokes", [])
    if not isinstance(strokes, list) or len(strokes) > MAP_STROKES_CAP:
        raise members.fault("strokes", f"a list of at most {MAP_STROKES_CAP} strokes")
    turns = members.integer("turns", _TURNS, lo=1, hi=_MOST_TURNS) if name == ORIENTATION else _absent(members, "turns")
    width = members.integer("width", _WIDTH, lo=3, hi=_WIDEST) if name == RIM_CHANNEL else _absent(members, "width")
    channel = Channel(name, members.number("weight", 1.0, lo=0.0, hi=8.0), turns or 1, width)
    return Given(channel, path, strokes)


def _absent(members: Fields, name: str) -> int:
    if name in members:
        raise members.fault(name, f'none: it belongs to "{ORIENTATION if name == "turns" else RIM_CHANNEL}"')
    return 0


def made(
    name: str, maps: tuple[Given, ...], folder: Path | None, region: np.ndarray, place: str = "maps"
) -> tuple[Channels, ImageSource]:
    """Returns the channels of an example with a region, bool (h, w), and their planes as one picture.  FieldError names
    a member, FileError a picture that does not fit."""
    planes = [_plane(one, folder, region, f"{place}.{one.channel.name}") for one in maps]
    return tuple(one.channel for one in maps), as_picture(name, np.stack(planes))


def as_picture(name: str, planes: np.ndarray) -> ImageSource:
    """Returns planes, uint8 (C, h, w), as a picture, one below the other."""
    flat = planes.reshape(-1, planes.shape[2]).astype(np.float32) / np.float32(255.0)
    seen = np.repeat(flat[None], 4, axis=0)
    seen[3] = 1.0
    return ImageSource.of(name, seen)


def control_planes(picture: ImageSource, count: int) -> np.ndarray:
    """Returns the planes, uint8 (count, h, w), that a picture was made of."""
    flat = np.rint(picture.planes(picture.whole)[0] * np.float32(255.0)).astype(np.uint8)
    planes: np.ndarray = flat.reshape(count, -1, picture.width)
    return planes


def channels_to_json(channels: Channels) -> tuple[tuple[object, ...], ...]:
    """Returns channels as a definition keeps them."""
    return tuple(tuple(one) for one in channels)


def channels_from_json(value: object) -> Channels:
    """Returns the channels that `channels_to_json` told; FieldError if they are none."""
    sound = isinstance(value, tuple) and 0 < len(value) <= MOST_CHANNELS
    rows: tuple[Any, ...] = value if isinstance(value, tuple) else ()
    if not sound or not all(_is_row(row) for row in rows):
        raise FieldError("controls", described(value), "rows of a name, weight, turns and width")
    found = tuple(Channel(name, float(weight), turns, width) for name, weight, turns, width in rows)
    if found != ordered(found) or len({one.name for one in found}) < len(found):
        raise FieldError("controls", described(value), "each once, in order")
    return found


def _is_row(row: Any) -> bool:
    if not (isinstance(row, tuple) and len(row) == 4 and isinstance(row[0], str)):
        return False
    number = isinstance(row[1], int | float) and not isinstance(row[1], bool) and 0 <= row[1] <= 8
    return bool(
        number and type(row[2]) is int and 1 <= row[2] <= _MOST_TURNS and type(row[3]) is int and 0 <= row[3] <= _WIDEST
    )


def _plane(given: Given, folder: Path | None, region: np.ndarray, place: str) -> np.ndarray:
    base = np.zeros(region.shape, np.uint8)
    if given.path is not None:
        base = _read(given.path if folder is None else folder / given.path, region.shape)
    elif given.channel.name == RIM_CHANNEL and given.strokes:
        base = rim_of(region, given.channel.width, 0)
    if given.channel.name == ORIENTATION:
        return _run_along(base, given.strokes, f"{place}.strokes")
    for i, stroke in enumerate(given.strokes):
        told = _stroke(stroke, f"{place}.strokes[{i}]")
        grey = round(sum(told.brush.rgb) * 85.0)
        whole = Rect(0, 0, region.shape[1], region.shape[0])
        for rect, taken in Footprint(told.brush, told.origin, copies=told.copies, within=whole).whole(told.points):
            part = rect.intersect(whole)
            if not part.empty:
                base[part.slices(whole)][taken[part.slices(rect)]] = grey
    return base


def _read(path: str | Path, shape: tuple[int, ...], like: str = "the example") -> np.ndarray:
    pixels, _ = read_image(path)
    if pixels.shape[:2] != shape:
        found = f"found {pixels.shape[1]} x {pixels.shape[0]} pixels, expected {shape[1]} x {shape[0]} as {like}"
        raise FileError(path, found)
    full = int(np.iinfo(pixels.dtype).max)
    summed = pixels[..., :3].astype(np.int64).sum(axis=-1) * 255
    out: np.ndarray = ((2 * summed + 3 * full) // (6 * full)).astype(np.uint8)
    return out


def _stroke(value: object, place: str) -> c.Stroke:
    if not isinstance(value, Mapping):
        raise FieldError(place, described(value), "a stroke")
    stroke = c.parse({"do": "stroke", **value}, place)
    assert isinstance(stroke, c.Stroke)
    return stroke


def _run_along(base: np.ndarray, strokes: list[object], place: str) -> np.ndarray:
    """Returns the orientation, 256 a turn, that strokes tell all around them; `base` where there are none."""
    lines: list[list[float]] = []
    for i, stroke in enumerate(strokes):
        told = _stroke(stroke, f"{place}[{i}]")
        last: tuple[float, float] | None = None
        for x, y in (told.points[:, :2] + np.array(told.origin, np.float64)).tolist():
            if last is None or (x - last[0]) ** 2 + (y - last[1]) ** 2 >= _STEP**2:
                if last is not None:
                    lines.append([*last, x, y])
                last = x, y
    if len(lines) > _LINES_CAP:
        raise FieldError(place, f"strokes of {len(lines)} pieces", f"at most {_LINES_CAP}")
    return flow_around(np.array(lines, np.float64), base.shape) if lines else base


def read_controlled(
    path: str, mask: str | None, parameters: Parameters, maps: tuple[Given, ...], folder: Path
) -> Exemplar:
    """Returns the exemplar of a picture file that has maps, whose paths start from a folder; otherwise as
    `example_files.read_exemplar`."""
    pixels, _ = read_image(path)
    inside = pixels[..., 3] > 0 if mask is None else read_mask(mask)
    if inside.shape != pixels.shape[:2]:
        found = f"found {inside.shape[1]} x {inside.shape[0]} pixels, expected {pixels.shape[1]} x {pixels.shape[0]}"
        raise FileError(mask or path, f"{found} as the example")
    if parameters.method == "scanline":
        raise FieldError("maps", 'maps with method "scanline"', 'method "correction"')
    channels, picture = made("", maps, folder, inside)
    try:
        return analysed_with(pixels, inside, parameters, (channels, control_planes(picture, len(channels))))
    except FieldError as error:
        raise FileError(path, str(error)) from None


def read_told(path: str, shape: tuple[int, ...]) -> np.ndarray:
    """Returns what a grey picture tells of a map: uint8 (h, w), which is its `shape`."""
    return _read(path, shape, "the region")
