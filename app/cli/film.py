"""Make a film: of how a painting was made, of a flight through its levels, or of both at once."""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from app.cli.arguments import rectangle, size
from app.cli.outcome import DONE, Refused
from app.cli.output import checked_output, grown, opened_painting, rect_of
from app.cli.progress import Progress

if TYPE_CHECKING:
    from engine.film.aim import Aim
    from engine.numeric.address import Rect
    from engine.painting.outlook import Outlook
    from engine.painting.places import Bookmarks
    from engine.painting.recording import Recording
    from engine.painting.value import Painting

MOST_SIDE, MOST_FPS, MOST_SECONDS = 8192, 240.0, 3600.0
_USUAL = 1920, 1080  # pixels that a film has at most, if its size is not told
_ENDINGS = ".mp4 .webm (through ffmpeg), .webp .avif .gif .png, or NAME-%%05d.png"


def declare(parser: argparse.ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("source", metavar="SRC", help="a painting, .ora, or a recording, .jsonl")
    parser.add_argument("out", metavar="OUT", help=_ENDINGS)
    parser.add_argument("--replay", action="store_true", help="the painting is made again (default without --flight)")
    where = "through bookmarks, NAME,NAME or all, or to L,X,Y,W,H; again: on from there; one place alone: from --rect"
    parser.add_argument("--flight", metavar="WHERE", action="append", help=where)
    parser.add_argument("--rect", type=rectangle, metavar="L,X,Y,W,H", help="what is seen, or where the flight begins")
    parser.add_argument("--size", type=size, metavar="WxH", help="of the film (default: the rectangle's)")
    parser.add_argument("--fps", type=_real(MOST_FPS), default=30.0, metavar="N", help="frames a second (default: 30)")
    parser.add_argument("--seconds", type=_real(MOST_SECONDS), metavar="S", help="how long it takes")
    parser.add_argument(
        "--clock", choices=("strokes", "pen"), default="strokes", help="all alike, or as long as it took"
    )
    parser.add_argument("--undone", action="store_true", help="with what was taken back")
    parser.add_argument("--brush", action="store_true", help="with the brush")


def run(options: argparse.Namespace) -> int:
    """Carries the command out; returns the exit status."""
    from engine.film.formats import FORMATS, is_series, writable, write_film
    from engine.film.shooting import Film, Shooting
    from engine.studio.filing.filming import making_of

    replays = options.replay or options.flight is None
    if not replays and (options.brush or options.undone or options.clock != "strokes"):
        raise Refused("--brush, --undone, --clock: found --flight alone, expected --replay with it")
    if not is_series(options.out):
        checked_output(options.out, tuple(FORMATS))
    source = _source(options.source, replays)
    places, size = _places(options, source)
    making = None if source.recording is None else making_of(source.recording)
    film = Film(places, size, options.fps, options.seconds, making, options.clock, options.undone, options.brush)
    film = replace(film, outlooks=() if replays else _outlooks(options, source.bookmarks))
    shooting, note = writable(options.out, Shooting(film, source.painting))
    if note:
        print(f"inkfall: {options.out}: {note}", file=sys.stderr)
    with Progress("filming", shooting.count) as tell:
        write_film(options.out, shooting, lambda part: tell(round(part * shooting.count)))
    told = f"{shooting.count} frames of {size[0]} x {size[1]}, {shooting.seconds:.4g} s"
    print(f"wrote {options.out}: {told} at {shooting.film.fps:.4g} a second")
    return DONE


class _Source(NamedTuple):
    """What is filmed: a painting as it is, or its recording."""

    frame: Rect
    bookmarks: Bookmarks
    painting: Painting | None
    recording: Recording | None


def _source(path: str, replays: bool) -> _Source:
    ending = Path(path).suffix.lower()
    if ending not in (".ora", ".jsonl"):
        raise Refused(f"{path}: found the ending {ending or 'none'}, expected .ora or .jsonl")
    if ending == ".ora":
        found = opened_painting(path)
        if not replays:
            return _Source(found.painting.frame, found.painting.bookmarks, grown(path, found), None)
        if found.recording is None:
            raise Refused(f"{path}: found no recording in it, expected one for --replay (--flight needs none)")
        return _Source(found.painting.frame, found.painting.bookmarks, None, found.recording)
    from engine.film.beats import bookmarks_in
    from engine.painting.grown import settled
    from engine.painting.recording import read
    from engine.session.replay import replay

    recording = read(path)
    if replays:
        return _Source(recording.header.frame, bookmarks_in(recording.commands), None, recording)
    with Progress("painting", len(recording.commands)) as tell:
        painting = settled(replay(recording, tell=tell).painting)
    return _Source(painting.frame, painting.bookmarks, painting, None)


def _places(options: argparse.Namespace, source: _Source) -> tuple[tuple[Aim, ...], tuple[int, int]]:
    """Returns where the film looks, and how large its pictures are."""
    from engine.film.aim import aim_at

    level, rect = (0, source.frame) if options.rect is None else rect_of(options.rect)
    size = options.size or _fitted(rect.width, rect.height)
    if max(size) > MOST_SIDE:
        raise Refused(f"--size: found {size[0]} x {size[1]}, expected at most {MOST_SIDE} each way")
    ends = [end for words in options.flight or () for end in _ends(words, source.bookmarks, size)]
    if options.rect is None and len(ends) > 1:
        return tuple(ends), size
    return (aim_at(level, rect, size), *ends), size


def _outlooks(options: argparse.Namespace, bookmarks: Bookmarks) -> tuple[Outlook, ...]:
    """Returns where the film stands in the land, if all bookmarks that it goes through were made there."""
    if options.rect is not None:
        return ()
    told = [name for words in options.flight for name in _names(words, bookmarks)]
    found = [bookmarks[name].outlook if name in bookmarks else None for name in told]
    return tuple(outlook for outlook in found if outlook is not None) if None not in found else ()


def _names(words: str, bookmarks: Bookmarks) -> list[str]:
    return list(bookmarks) if words == "all" else [words] if words in bookmarks else words.split(",")


def _ends(words: str, bookmarks: Bookmarks, size: tuple[int, int]) -> list[Aim]:
    """Returns where `--flight` leads."""
    from engine.film.aim import aim_at, aim_of

    names = _names(words, bookmarks)
    if names and all(name in bookmarks for name in names):
        return [aim_of(bookmarks[name], size) for name in names]
    try:
        return [aim_at(*rect_of(rectangle(words)), size)]
    except argparse.ArgumentTypeError:
        known = ", ".join(map(repr, bookmarks)) or "none"
        expected = f"all, names of bookmarks ({known}), or L,X,Y,W,H"
        raise Refused(f"--flight: found {words[:80]!r}, expected {expected}") from None


def _fitted(width: int, height: int) -> tuple[int, int]:
    """Returns a rectangle's size, smaller if it is larger than usual; even, as films want it."""
    scale = max(width / _USUAL[0], height / _USUAL[1], 1.0)
    return max(2, int(width / scale) // 2 * 2), max(2, int(height / scale) // 2 * 2)


def _real(most: float) -> Callable[[str], float]:
    """Returns what reads a number above 0, up to `most`."""

    def read(text: str) -> float:
        if not re.fullmatch(r"[0-9]{1,9}(\.[0-9]{1,9})?", text) or not 0.0 < float(text) <= most:
            raise argparse.ArgumentTypeError(f"found {text[:40]!a}, expected a number above 0, at most {most:g}")
        return float(text)

    return read
