"""Where one looks: the commands that tell a view of the canvas.  None of them changes a pixel.

A rectangle is told by a real level, its origin and its size in pixels of that level, of which there are 2^level for
each pixel of level 0.  Origins are integers of any size, or floats where these are as exact.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

from immutables import Map

from engine.brush.checks import thawed
from engine.checks.field_error import FieldError
from engine.checks.values import is_number
from engine.files.strict_json import Fields
from engine.numeric.scaling import scaled
from engine.painting.outlook import Outlook, read_outlook, write_outlook
from engine.painting.points import plain

LEVEL_LIMIT = 4096  # a level beyond this has more digits than a painting needs
PLACE_LIMIT = 1 << 8192  # origins: 2^40 level-0 pixels at the finest level have fewer bits
LARGEST_BOOKMARK = 1 << 40  # pixels along a side of a bookmark
BOOKMARKS_CAP = 4096  # of one painting
_SUBPIXEL = 32  # bits: middles are told to 2^-32 of a pixel
Extra = Map[str, Any]  # members that this version does not know
_NOTHING: Extra = Map()


@dataclass(frozen=True, slots=True)
class View:
    """Where the artist looked: real level, origin and size in pixels of it.  It never changes a pixel."""

    level: float = 0.0
    origin: tuple[float, float] = (0.0, 0.0)
    size: tuple[float, float] = (0.0, 0.0)
    extra: Extra = _NOTHING


@dataclass(frozen=True, slots=True)
class Bookmark:
    """A place to come back to, under a name; one of this name that there is takes this place.

    The rectangle is seen as large as the screen allows, turned clockwise by `angle` degrees about its middle, and with
    its left and right swapped where it is `mirrored`.  `outlook`: where it stands in the land, if it was made there.
    """

    name: str
    level: float = 0.0
    origin: tuple[float, float] = (0, 0)
    size: tuple[float, float] = (1024, 768)
    angle: float = 0.0
    mirrored: bool = False
    extra: Extra = _NOTHING
    outlook: Outlook | None = None


@dataclass(frozen=True, slots=True)
class RemoveBookmark:
    """Takes a bookmark away."""

    name: str
    extra: Extra = _NOTHING


@dataclass(frozen=True, slots=True)
class RenameBookmark:
    """Gives a bookmark another name."""

    name: str
    to: str
    extra: Extra = _NOTHING


BookmarkCommand = Bookmark | RemoveBookmark | RenameBookmark
Bookmarks = Mapping[str, Bookmark]  # by name, in the order in which they were made; it never changes
NO_BOOKMARKS: Bookmarks = MappingProxyType({})


def bookmarks_after(bookmarks: Bookmarks, command: BookmarkCommand) -> Bookmarks:
    """Returns a painting's bookmarks after a command.  FieldError if it cannot be done."""
    if isinstance(command, Bookmark):
        if command.name not in bookmarks and len(bookmarks) >= BOOKMARKS_CAP:
            raise FieldError("bookmark", f"{BOOKMARKS_CAP} bookmarks already", "fewer")
        return MappingProxyType({**bookmarks, command.name: command})
    if command.name not in bookmarks:
        raise FieldError("bookmark", f"none of the name {command.name!r}", "the name of a bookmark")
    if isinstance(command, RemoveBookmark):
        return MappingProxyType({name: mark for name, mark in bookmarks.items() if name != command.name})
    if command.to != command.name and command.to in bookmarks:
        raise FieldError("bookmark.to", f"{command.to!r}, which is another one's", "a name that is free")
    renamed = replace(bookmarks[command.name], name=command.to)
    return MappingProxyType(
        dict((command.to, renamed) if name == command.name else (name, mark) for name, mark in bookmarks.items())
    )


def middle_of(bookmark: Bookmark) -> tuple[int, int, int]:
    """Returns the middle of its rectangle, (x, y) * 2^-exponent in pixels of level 0, for integers of any size."""
    fraction, whole = math.modf(bookmark.level)
    ends = zip(bookmark.origin, bookmark.size, strict=True)
    x, y = (scaled(_fine(origin, size), -fraction) for origin, size in ends)
    return x, y, int(whole) + _SUBPIXEL


def _fine(origin: float, size: float) -> int:
    """Returns the middle of a span of pixels, in 2^-32 of them."""
    pixel = math.floor(origin)
    rest = round((origin - pixel) * (1 << _SUBPIXEL)) + round(size * (1 << _SUBPIXEL - 1))
    return (pixel << _SUBPIXEL) + rest


# --- as members of a command ---------------------------------------------------------------------------------------


def read_view(members: Fields) -> View:
    """Reads a view command."""
    level, origin = _level(members), _pair(members, "origin", (-PLACE_LIMIT, PLACE_LIMIT))
    return View(level, origin, _pair(members, "size", (0, PLACE_LIMIT)), members.rest())


def write_view(view: View) -> dict[str, object]:
    """Tells its members; `read_view` is the inverse."""
    return {"level": plain(view.level), "origin": list(view.origin), "size": list(view.size), **thawed(view.extra)}


def read_bookmark(members: Fields) -> BookmarkCommand:
    """Reads a bookmark command: a place for a name, `remove` or `to`."""
    name = members.text("name")
    if members.flag("remove", False):
        if "to" in members:
            raise members.fault("to", "remove or to, not both")
        return RemoveBookmark(name, members.rest())
    if "to" in members:
        return RenameBookmark(name, members.text("to"), members.rest())
    level, origin = _level(members), _pair(members, "origin", (-PLACE_LIMIT, PLACE_LIMIT))
    size = _pair(members, "size", (0, LARGEST_BOOKMARK), (1024, 768))
    if not all(size):
        raise members.fault("size", "numbers above 0")
    angle, mirrored = members.number("angle", 0.0, lo=-360.0, hi=360.0), members.flag("mirror", False)
    outlook = read_outlook(members)
    return Bookmark(name, level, origin, size, angle, mirrored, members.rest(), outlook)


def write_bookmark(command: BookmarkCommand) -> dict[str, object]:
    """Tells its members; `read_bookmark` is the inverse."""
    out: dict[str, object] = {"name": command.name}
    if isinstance(command, RemoveBookmark):
        out["remove"] = True
    elif isinstance(command, RenameBookmark):
        out["to"] = command.to
    else:
        out |= {"level": plain(command.level), "origin": list(command.origin), "size": list(command.size)}
        out |= {"angle": plain(command.angle)} if command.angle else {}
        out |= {"mirror": True} if command.mirrored else {}
        out |= {} if command.outlook is None else write_outlook(command.outlook)
    return {**out, **thawed(command.extra)}


def _level(members: Fields) -> float:
    level: float = members.number("level", 0.0, lo=float(-LEVEL_LIMIT), hi=float(LEVEL_LIMIT))
    return level


def _pair(
    members: Fields, name: str, bounds: tuple[int, int], default: tuple[float, float] = (0, 0)
) -> tuple[float, float]:
    value = members.take(name, list(default))
    if not (isinstance(value, list) and len(value) == 2 and all(map(is_number, value))):
        raise members.fault(name, "a list of 2 numbers")
    if not all(bounds[0] <= v <= bounds[1] for v in value):
        raise members.fault(name, "numbers that are not negative" if min(value) < bounds[0] == 0 else "smaller numbers")
    return (value[0], value[1])


def read_bookmarks(value: object) -> tuple[Bookmarks, list[str]]:
    """Returns the bookmarks of a file that can be read, and a line for each that cannot: no paint hangs on them."""
    bookmarks, notes = NO_BOOKMARKS, list[str]()
    for i, told in enumerate(value if isinstance(value, list) else [value]):
        try:
            command = read_bookmark(Fields(told, f"bookmarks[{i}]"))
            if not isinstance(command, Bookmark) or command.name in bookmarks:
                raise FieldError(
                    f"bookmarks[{i}]", "no place or a name that is taken", "a place with a name of its own"
                )
            bookmarks = bookmarks_after(bookmarks, command)
        except FieldError as error:
            notes.append(f"a bookmark is left out: {error}")
    return bookmarks, notes
