"""What commands read and where they write: checked before the work begins, so that nobody waits for nothing."""

from __future__ import annotations

import argparse
import errno
import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from app.cli.arguments import Rectangle
from app.cli.outcome import Failed, Refused
from app.cli.progress import Progress

if TYPE_CHECKING:
    from engine.archive.export import Picture
    from engine.archive.imports import Opened
    from engine.files.fault import FileError
    from engine.numeric.address import Rect
    from engine.painting.value import Painting


def salvage_option(parser: argparse.ArgumentParser) -> None:
    """Declares `--salvage`, which commands that read files have."""
    parser.add_argument("--salvage", action="store_true", help="of a damaged file, take what can be had, and tell")


def opened_painting(path: str, tell: bool = True, salvage: bool | None = None) -> Opened:
    """Returns the painting in an .ora; what was lost or replaced on the way is told on standard error.  `salvage`: of a
    damaged one what can be had, and what is missing is told in any case; None where the command has no such option."""
    from engine.archive.opening import open_painting
    from engine.files.fault import FileError, TooMuch
    from engine.session.damaged import open_or_salvage

    with Progress("opening", 100) as progress:
        try:
            found = (open_or_salvage if salvage else open_painting)(path, progress.part)
        except TooMuch:
            raise
        except FileError as error:
            raise salvageable(error) if salvage is False and os.path.isfile(path) else error from None
    for note in found.notes if tell or (salvage and not found.native) else ():
        print(f"inkfall: {path}: {note}", file=sys.stderr)
    return found


def salvageable(error: FileError) -> FileError:
    """Returns the same error, which says what can be done."""
    return type(error)(error.path, f"{error.message}; --salvage takes what is whole of it")


def grown(path: str, found: Opened) -> Painting:
    """Returns what was opened, with all that was painted with examples grown; it is told if that is not what it was."""
    from engine.archive.plot_files import OTHERWISE, otherwise
    from engine.painting.grown import settled

    painting = settled(found.painting)
    if otherwise(found.marks, painting.root):
        print(f"inkfall: {path}: {OTHERWISE}", file=sys.stderr)
    return painting


def checked_output(path: str | None, endings: Sequence[str], folders: Sequence[str] = ()) -> str | None:
    """Returns the path's ending in lower case, if it is one of `endings` and its folder can be written to; `folders`:
    the endings of what is a folder itself."""
    if path is None:
        return None
    ending = Path(path).suffix.lower()
    if ending not in endings:
        raise Refused(f"{path}: found the ending {ending or 'none'}, expected {' or '.join(endings)}")
    folder = os.path.dirname(path) or "."
    if not os.path.isdir(folder):
        raise Failed(f"{path}: there is no folder {folder}")
    if os.path.isdir(path) and ending not in folders:
        raise Failed(f"{path}: cannot be written: a folder; expected a file name")
    if not os.access(folder, os.W_OK):
        raise Failed(f"{path}: cannot be written: {os.strerror(errno.EACCES)}")
    return ending


def rect_of(at: Rectangle) -> tuple[int, Rect]:
    """Returns the level, and the rectangle in its pixels."""
    from engine.numeric.address import Rect

    return at.level, Rect.at(at.x, at.y, at.width, at.height)


def picture_of(
    painting: Painting, at: Rectangle | None, layer: str | None = None, depth: int = 8, most: int | None = None
) -> Picture:
    """Returns a rectangle of a painting, or its frame, as a picture to export; it has at most `most` pixels each way,
    or as many as a picture in one file may have."""
    from engine.archive.export import Picture
    from engine.checks.picture_sides import PICTURE_SIDE

    if at is None:
        return Picture(painting, layer=layer, depth=depth)
    most = PICTURE_SIDE if most is None else most
    if max(at.width, at.height) > most:
        raise Refused(f"--rect: found {at.width} x {at.height} pixels, expected at most {most} each way")
    return Picture(painting, *rect_of(at), layer, depth)
