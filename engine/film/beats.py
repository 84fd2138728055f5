"""When each command of a recording is seen in a film of how the painting was made."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

from engine.film.aim import Aim
from engine.painting import commands as c
from engine.painting.places import NO_BOOKMARKS, BookmarkCommand, Bookmarks, bookmarks_after
from engine.strokes.coverage_at import stroke_bounds

CLOCKS = ("strokes", "pen")
_INVISIBLE = (c.AddLayer, c.RenameLayer)  # steps that change no pixel
PAUSE = 1.0  # seconds between two strokes, and those a stroke takes, where nothing tells
LONGEST_PAUSE = 60.0  # seconds: beyond, the artist was away


class Beat(NamedTuple):
    """A command begins at `begin` and takes `length`, by the film's clock; `seen`: or it is carried out unseen."""

    begin: float
    length: float
    seen: bool


Sees = Callable[[c.Command], bool]


def beats(
    commands: Sequence[c.Command],
    steps: frozenset[type],
    clock: str = "strokes",
    undone: bool = False,
    sees: Sees = lambda command: True,
) -> tuple[Beat, ...]:
    """Returns when each command is carried out, from 0 on.  `steps`: those that undo takes back.

    `clock`: "strokes", each takes as long as the others, or "pen", as long as it took, by the `time` of commands and of
    points.  `undone`: what was taken back is seen, and how that goes.  `sees`: whether the film could show a command.
    """
    now, ended = 0.0, None
    out: list[Beat] = []
    for command, stays in zip(commands, _seen(commands, steps, undone), strict=True):
        seen = stays and sees(command)
        length = 0.0
        if seen and clock == "pen":
            length, time = _taken(command), _time(command)
            now += _pause(ended, time) if any(beat.seen for beat in out) else 0.0
            ended = None if time is None else time + length
        elif seen:
            length = 1.0
        out.append(Beat(now, length, seen))
        now += length
    return tuple(out)


def seen_from(aim: Aim, size: tuple[int, int]) -> Sees:
    """Returns what tells of a command whether pictures of `size` (width, height) of one place could show it: a stroke
    meets them, and is as long as one of their pixels."""
    frame = aim.window(aim.across(size), aim.level).rect

    def sees(command: c.Command) -> bool:
        if not isinstance(command, c.Stroke):
            return True
        bounds = stroke_bounds(command)
        levels = command.level - aim.level
        long = math.log2(max(bounds.width, bounds.height)) >= levels - aim.fraction
        return long and not bounds.zoomed(-levels).intersect(frame).empty

    return sees


def _seen(commands: Sequence[c.Command], steps: frozenset[type], undone: bool) -> list[bool]:
    """Tells of each command whether it is to be seen: what changes pixels, and stays unless `undone`."""
    seen = [type(command) in steps and not isinstance(command, _INVISIBLE) for command in commands]
    if undone:
        travels = (isinstance(command, c.Undo | c.Redo) for command in commands)
        return [is_seen or travel for is_seen, travel in zip(seen, travels, strict=True)]
    done: list[int] = []
    taken_back: list[int] = []
    for i, command in enumerate(commands):
        if type(command) in steps:
            done.append(i)
            taken_back.clear()
        elif isinstance(command, c.Undo | c.Redo):
            source, target = (done, taken_back) if isinstance(command, c.Undo) else (taken_back, done)
            for _ in range(min(command.count, len(source))):
                target.append(source.pop())
    stays = set(done)
    return [is_seen and i in stays for i, is_seen in enumerate(seen)]


def _time(command: c.Command) -> float | None:
    """Returns when a command began, seconds since 1970; None if it does not tell."""
    time = None if isinstance(command, c.DefineTexture) else command.extra.get("time")
    return float(time) if isinstance(time, int | float) else None


def _pause(ended: float | None, time: float | None) -> float:
    return PAUSE if ended is None or time is None else min(max(time - ended, 0.0), LONGEST_PAUSE)


def _taken(command: c.Command) -> float:
    """Returns how long a stroke took; another step takes no time."""
    if not isinstance(command, c.Stroke):
        return 0.0
    taken = float(command.points[-1, 5] - command.points[0, 5])
    return taken if taken > 0.0 else PAUSE


def bookmarks_in(commands: Sequence[c.Command]) -> Bookmarks:
    """Returns the bookmarks that commands leave; no undo takes one back.  FieldError if one cannot be done."""
    out = NO_BOOKMARKS
    for command in commands:
        if isinstance(command, BookmarkCommand):
            out = bookmarks_after(out, command)
    return out
