"""Pictures of land: where the camera of the command line stands, and what it takes."""

from __future__ import annotations

import argparse
import math
import re
from fractions import Fraction
from typing import TYPE_CHECKING

from app.cli.arguments import size
from app.cli.outcome import Refused
from app.cli.progress import Progress

if TYPE_CHECKING:
    from engine.numeric.address import Rect
    from engine.terrain.camera import Camera
    from engine.terrain.plane import Land

_LARGEST = 1e12
_SIZE, _SAMPLES, _SUN = (1280, 800), 9, (300.0, 28.0)
_MOST_PIXELS, _MOST_SAMPLES = 1 << 26, 1024
_PLACE = re.compile(r"[+-]?[0-9]{1,4000}(\.[0-9]{1,40})?")
_PICTURE_OPTIONS = ("camera", "fit", "size", "samples", "sun", "haze")
_MOST_HAZE = 1000.0


def number(text: str) -> float:
    """Reads a number that there is."""
    try:
        found = float(text)
    except ValueError:
        found = math.nan
    if not abs(found) <= _LARGEST:
        raise argparse.ArgumentTypeError(f"found {text[:40]!a}, expected a number from -1e12 to 1e12")
    return found


def positive(text: str) -> float:
    """Reads a number above 0."""
    found = number(text)
    if not found >= 1 / _LARGEST:
        raise argparse.ArgumentTypeError(f"found {text[:40]!a}, expected a number above 0")
    return found


def camera_words(text: str) -> tuple[str, ...]:
    """Reads `L,X,Y,height,azimuth,tilt,fov`, the last three of which may be missing; anything else is a name."""
    return tuple(part.strip() for part in text.split(","))


def sun(text: str) -> tuple[float, float]:
    """Reads `azimuth,altitude` in degrees."""
    parts = [number(part) for part in text.split(",")]
    if len(parts) != 2 or not 0.0 < parts[1] <= 90.0:
        raise argparse.ArgumentTypeError(f"found {text[:40]!a}, expected azimuth,altitude: altitude above 0, up to 90")
    return parts[0] % 360.0, parts[1]


def declare_picture(parser: argparse.ArgumentParser) -> None:
    """Declares the arguments of pictures."""
    where = "pixels of level L, height above the ground there; degrees clockwise from the top, up, and across"
    parser.add_argument("--camera", type=camera_words, metavar="L,X,Y,HEIGHT[,AZIMUTH,TILT,FOV]", help=where)
    parser.add_argument("--fit", action="store_true", default=None, help="all of the rectangle (if no --camera)")
    parser.add_argument("--size", type=size, metavar="WxH", help="pixels of the picture (default 1280x800)")
    parser.add_argument("--samples", type=int, metavar="N", help=f"rays of each pixel (default {_SAMPLES})")
    parser.add_argument("--sun", type=sun, metavar="AZIMUTH,ALTITUDE", help="where the sun stands (default 300,28)")
    parser.add_argument("--haze", type=number, metavar="D", help="times the usual haze, 0 for none (default 1)")


def refuse_picture(options: argparse.Namespace, ending: str) -> None:
    """Refuses options of pictures where none is made."""
    for name in _PICTURE_OPTIONS:
        if getattr(options, name) is not None:
            raise Refused(f"--{name}: found it for {ending}, expected it for a picture: .png without --for")


def wet(options: argparse.Namespace, land: Land) -> bool:
    """Tells whether there is water: where somebody said how high it lies."""
    return options.sea is not None or land.sea != 0.0


def write_land_view(options: argparse.Namespace, land: Land, place: tuple[int, Rect]) -> None:
    """Writes a picture of land."""
    from engine.files.atomic import replacing
    from engine.files.png_writer import write_png
    from engine.terrain.camera import camera_before
    from engine.terrain.drape import cover_of
    from engine.terrain.land_picture import Shot, picture_of_land

    pixels = options.size or _SIZE
    if pixels[0] * pixels[1] > _MOST_PIXELS or min(pixels) < 2:
        raise Refused(f"--size: found {pixels[0]} x {pixels[1]}, expected 2 each way to 2^26 pixels")
    samples = _SAMPLES if options.samples is None else options.samples
    if not 1 <= samples <= _MOST_SAMPLES:
        raise Refused(f"--samples: found {samples}, expected 1 to {_MOST_SAMPLES}")
    haze = 1.0 if options.haze is None else options.haze
    if not 0.0 <= haze <= _MOST_HAZE:
        raise Refused(f"--haze: found {haze:g}, expected 0 to {_MOST_HAZE:g}")
    if options.camera is not None and options.fit:
        raise Refused("--fit: found it with --camera, expected one of them")
    camera = camera_before(*place, land, pixels) if options.camera is None else _camera(options.camera, land, pixels)
    water = wet(options, land)
    shot = Shot(camera, pixels, samples, options.sun or _SUN, water, haze)
    with Progress("picture", 100) as tell:
        seen = picture_of_land(land, cover_of(land, water), shot, tell.part)
    with replacing(options.out) as file:
        write_png(file, seen)


def _camera(words: tuple[str, ...], land: Land, pixels: tuple[int, int]) -> Camera:
    """Returns the camera that was asked for: numbers, or a bookmark's name."""
    from engine.numeric.address import Rect
    from engine.terrain.camera import Camera, camera_before
    from engine.terrain.height_window import FINEST_TOLD

    name = ",".join(words)
    mark = land.painting.bookmarks.get(name)
    if mark is not None and mark.outlook is not None:
        seen = mark.outlook
        return Camera(
            seen.level, Fraction(seen.x), Fraction(seen.y), seen.height, seen.turn % 360.0, seen.tilt, seen.fov
        )
    if mark is not None:
        level = math.floor(mark.level)
        by = 2.0 ** (level - mark.level)
        x, y = (math.floor(v * by) for v in mark.origin)
        return camera_before(level, Rect.at(x, y, *(max(1, round(v * by)) for v in mark.size)), land, pixels)
    expected = "expected L,X,Y,HEIGHT[,AZIMUTH,TILT,FOV] or the name of a bookmark"
    if not 4 <= len(words) <= 7 or not all(map(_PLACE.fullmatch, words[:3])) or "." in words[0]:
        raise Refused(f"--camera: found {name[:80]!a}, {expected}")
    try:
        height, azimuth, tilt, fov = (*map(number, words[3:]), *(0.0, -10.0, 60.0)[len(words) - 4 :])
    except argparse.ArgumentTypeError:
        raise Refused(f"--camera: found {name[:80]!a}, {expected}") from None
    if not height >= 1e-6:
        raise Refused(f"--camera: found a height of {height:g}, expected one above the ground")
    if not (-90.0 <= tilt <= 90.0 and 1.0 <= fov <= 150.0):
        raise Refused(f"--camera: found tilt {tilt:g} and fov {fov:g}, expected -90 to 90 and 1 to 150 degrees")
    if abs(int(words[0])) > FINEST_TOLD:
        raise Refused(f"--camera: found level {words[0]}, expected at most {FINEST_TOLD} for heights")
    return Camera(int(words[0]), Fraction(words[1]), Fraction(words[2]), height, azimuth % 360.0, tilt, fov)
