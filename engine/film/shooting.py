"""Shooting a film: what it shows is decided for every frame first; then the frames are made, one after another."""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass, replace

import numpy as np

from engine.canvas import layers
from engine.film import tip_mark
from engine.film.aim import Aim
from engine.film.beats import Beat, beats, seen_from
from engine.film.closing import others
from engine.film.course import flight, legs_through, length
from engine.film.land_flight import land_frames
from engine.film.replaying import Making, Replaying
from engine.film.sheets import Parts, Sheets, plan
from engine.numeric.askew import Askew, write_askew
from engine.numeric.convolution import Part, write_scaled
from engine.painting.outlook import Outlook
from engine.painting.rendering import folded_layers
from engine.painting.value import Painting

FPS = 30.0
_LEVEL_SECONDS = 1.0  # that a flight takes for each level of zoom, if it is not told
_BEAT_SECONDS = 0.15  # that a replay takes for each stroke, if it is not told
_SHORTEST, _LONGEST = 4.0, 60.0  # seconds of a film whose length is not told
_REST = 1.0, 8  # seconds, and part of a film, for which the finished painting is shown at most
_BAND = 64  # rows of a frame that a thread makes at once


@dataclass(frozen=True, slots=True)
class Film:
    """What is to be seen, in pictures of `size` (width, height), `fps` a second.

    `places`: the views that it flies through, at least one; `making`: the painting is made again, by `clock` (one of
    `beats.CLOCKS`), with what was `undone` and the `brush` or without; None: it is seen as it is; `seconds`: None for
    as long as it takes.  `outlooks`: one for each place: the land is seen from there, not the canvas.
    """

    places: tuple[Aim, ...]
    size: tuple[int, int]
    fps: float = FPS
    seconds: float | None = None
    making: Making | None = None
    clock: str = "strokes"
    undone: bool = False
    brush: bool = False
    outlooks: tuple[Outlook, ...] = ()


class Shooting:
    """A film that can be shot: `seconds` long, in `count` frames."""

    def __init__(self, film: Film, painting: Painting | None = None) -> None:
        """`painting`: as it is in the end, grown to its end; not needed where it is made again."""
        self._film, self._painting = film, painting
        self._beats = _beats_of(film)
        legs = legs_through(film.places, film.size[0])
        levels, strokes = length(legs), sum(beat.seen for beat in self._beats)
        natural = max(levels * _LEVEL_SECONDS + 1.0, strokes * _BEAT_SECONDS)
        self.seconds = min(max(natural, _SHORTEST), _LONGEST) if film.seconds is None else film.seconds
        self._flight = flight(legs, self.seconds)
        self.count = max(1, round(self.seconds * film.fps))

    def slower(self, fps: float) -> Shooting:
        """Returns the same with other frames a second."""
        return Shooting(replace(self._film, fps=fps, seconds=self.seconds), self._painting)

    @property
    def film(self) -> Film:
        """Gives what is to be seen."""
        return self._film

    def at(self, part: float) -> Aim:
        """Returns where it looks after a part of it, 0..1."""
        return self._flight.at(part * self.seconds)

    def aims(self) -> list[Aim]:
        """Returns where each frame looks; the last one where the flight ends, unless it loops."""
        steps = self.count if self._flight.loops else max(self.count - 1, 1)
        return [self._flight.at(self.seconds * i / steps) for i in range(self.count)]

    def frames(self, threads: int | None = None) -> Iterator[np.ndarray]:
        """Yields the frames, uint8 (height, width, 3), read-only, made on `threads` (None: as many as there are
        cores).  FileError if a recording cannot be played."""
        with ExitStack() as stack:
            count = (os.cpu_count() or 1) if threads is None else threads
            pool = stack.enter_context(ThreadPoolExecutor(count, "inkfall film"))
            aims = self.aims()
            if self._film.making is None:
                assert self._painting is not None
                if self._film.outlooks:
                    yield from land_frames(self._painting, self._film.outlooks, self._film.size, self.count)
                    return
                painting = replace(self._painting, root=folded_layers(layers.pictured(self._painting.root)))
                ahead = stack.enter_context(ThreadPoolExecutor(1, "inkfall film ahead"))
                sheets = Sheets(plan(aims, self._film.size, others(aims, painting.root)), pool, ahead)
                yield from _flown(sheets, painting, self._film.size, self.count, pool)
            else:
                yield from self._made_again(self._film.making, aims, pool)

    def _made_again(self, making: Making, aims: list[Aim], pool: Executor) -> Iterator[np.ndarray]:
        size = self._film.size
        replaying, sheets = Replaying(making, self._beats), Sheets(plan(aims, size), pool)
        total = max((beat.begin + beat.length for beat in self._beats), default=0.0)
        rest = min(_REST[0], self.seconds / _REST[1])
        picture = _Picture(size, pool)
        for i, aim in enumerate(aims):
            part = i / max(self.count - 1, 1) * self.seconds / (self.seconds - rest)
            if part < 1.0:
                replaying.go_to(part * total)
            else:
                replaying.end()
            frame = picture.of(sheets.parts(i, replaying.painting), (aim, replaying.painting))
            tip = replaying.tip if self._film.brush else None
            yield frame if tip is None else tip_mark.with_tip(frame, aim, tip)


def _beats_of(film: Film) -> tuple[Beat, ...]:
    """Returns when each command is carried out.  By strokes, those that a film of one place could not show take none of
    its time: it would stand still."""
    made = film.making
    if made is None:
        return ()
    stands = film.clock == "strokes" and all(place == film.places[0] for place in film.places)
    seen = [seen_from(film.places[0], film.size)] if stands else []
    return beats(made.recording.commands, made.steps, film.clock, film.undone, *seen)


class _Picture:
    """The frame that is made; the same array as before where nothing changed."""

    def __init__(self, size: tuple[int, int], pool: Executor) -> None:
        self._size, self._pool = size, pool
        self._of: tuple[Aim, Painting] | None = None
        self._last: np.ndarray | None = None

    def of(self, parts: Parts, what: tuple[Aim, Painting]) -> np.ndarray:
        if self._last is None or self._of is None or self._of[0] != what[0] or self._of[1] is not what[1]:
            self._last, self._of = frame_of(parts, self._size, self._pool), what
        return self._last


def _flown(
    sheets: Sheets, painting: Painting, size: tuple[int, int], count: int, pool: Executor
) -> Iterator[np.ndarray]:
    for i in range(count):
        yield frame_of(sheets.parts(i, painting), size, pool)


def frame_of(parts: Parts, size: tuple[int, int], pool: Executor) -> np.ndarray:
    """Returns the sum of some parts as a frame: uint8 (height, width, 3), read-only."""
    out = np.empty((size[1], size[0], 3), np.uint8)
    askew = tuple(part for part in parts if isinstance(part, Askew))
    straight = tuple(part for part in parts if isinstance(part, Part))

    def draw(first: int) -> None:
        rows = out[first : first + _BAND]
        if askew:
            write_askew(askew, first, size[1], rows)
        else:
            write_scaled(straight, first, rows)

    for _ in pool.map(draw, range(0, size[1], _BAND)):
        pass
    out.flags.writeable = False
    return out
