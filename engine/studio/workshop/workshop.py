"""Textures while they are written: a text is read, and its pictures are made piece by piece, what is looked at first.

A newer text takes the place of an older one.  One that is wrong leaves all pictures as they are.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from engine.checks.owned import Owned
from engine.makers.makers import named_by
from engine.numeric.address import Rect
from engine.studio import faults, results
from engine.studio.easel import Easel
from engine.studio.textures import structure_ready
from engine.studio.workshop import workshop_records as wr
from engine.studio.workshop.language_words import language_words
from engine.studio.workshop.workshop_pictures import as_relief, as_seen, brightness, histogram_of, in_pieces
from engine.texture.expression.defined import check_woven, checked_cost
from engine.texture.expression.examined import costs_about, line_look, shimmer, values_at
from engine.texture.expression.language import COST_MOST, read
from engine.texture.expression.written import FELT, Adjustable, WrittenError, WrittenText
from engine.texture.expression.written_ink import Expression, Named

_FIRST, _LEAST = 128, 32  # pixels of a picture that is shown before it is whole, at most; at least of a dear one,
_SOON = 5e7  # nanoseconds that it takes, about
_DEARER = 4.0  # times as dear as from afar a text is from near, at most, or nearly
_LOOKED = (96, 96)  # pixels over which the least and the greatest value of a line are sought
_SHIMMERS = 64  # pixels square that are compared with the next finer level


@dataclass(eq=False, slots=True)
class _Known:
    """What is looked at: what was asked for, the texture, and what is told of it."""

    asked: wr.WorkshopSet
    made: Expression
    scene: wr.WorkshopScene
    whole: bool = False  # whether all its small pictures were made,
    checked: bool = False  # and it was looked at from near

    @property
    def number(self) -> int:
        """Gives the line that is looked at; the last one where there is none of that number."""
        count = len(self.scene.lines)
        return self.asked.line if 0 <= self.asked.line < count else count - 1


class Workshop(Owned):
    """It belongs to the engine's thread."""

    def __init__(self, easel: Easel) -> None:
        self._easel = easel
        self._work: Iterator[None] | None = None
        self._known: _Known | None = None
        self._place: tuple[int, int] | None = None
        self._told = False  # the words
        self.handlers: dict[type, Callable[[Any], None]] = {wr.WorkshopSet: self._set, wr.WorkshopAsk: self._ask}

    @property
    def pending(self) -> int:
        """Pieces of open work; none while the pen draws."""
        if self._easel.live is not None:
            return 0
        return int(self._work is not None) + int(self._place is not None)

    def step(self) -> None:
        """Does the next piece of work."""
        if self._place is not None:
            place, self._place = self._place, None
            if self._known is not None:
                self._easel.send(wr.WorkshopValues(place, values_at(self._known.made, self._known.asked.level, place)))
            return
        work, self._work = self._work, None  # what fails is not tried again
        if work is not None and next(work, self) is None:
            self._work = work

    def _ask(self, request: wr.WorkshopAsk) -> None:
        self._place = request.place

    def _set(self, request: wr.WorkshopSet) -> None:
        if not self._told:
            self._told = True
            self._easel.send(language_words())
        self._work = self._shown(request)

    def _shown(self, asked: wr.WorkshopSet) -> Iterator[None]:
        """Does all there is to do for a text: yields after each piece."""
        try:
            known = _read(asked, self._known, self._named(asked.text))
        except WrittenError as error:
            self._refuse(asked, error)
            return
        except Exception as error:
            self._easel.send(wr.WorkshopScene(asked.text, wr.WorkshopMistake(1, 1, faults.words(error), "a texture")))
            raise
        before, self._known = self._known, known
        yield from self._ready()
        drawn = known.scene.drawn
        for _ in self._picture(known):
            yield
            if known.scene.drawn > drawn and not known.checked:
                try:
                    _check(known)
                except WrittenError as error:
                    self._refuse(asked, error)
                    return
        if before is None or not _alike(before, asked):
            yield from self._lines(known)
            yield from self._levels(known)
        else:
            self._tell(lines=known.scene.lines)
        known.whole = True
        yield
        side = min(_SHIMMERS, *asked.size)
        rect = Rect.at(*asked.origin, side, side)
        self._tell(shimmer=shimmer(known.made, asked.level, rect, known.number).rms * 255.0)

    def _refuse(self, asked: wr.WorkshopSet, error: WrittenError) -> None:
        mistake = wr.WorkshopMistake(error.line, error.column, error.found, error.expected)
        good = self._known.scene if self._known is not None else wr.WorkshopScene("")
        self._easel.send(replace(good, text=asked.text, mistake=mistake))

    def _named(self, text: str) -> Named:
        """Returns the textures that a text names, as the painting has them now."""
        if '"' not in text:
            return ()
        session = self._easel.session
        painting = session.painting
        return named_by(text, painting.root, replace(session.around(), textures=painting.textures))

    def _ready(self) -> Iterator[None]:
        """Waits until the kernels are there."""
        for _ in structure_ready.waiting_for_written():
            if not self._known or not self._known.scene.busy:
                self._tell(busy=True)
            yield
        self._tell(busy=False)

    def _tell(self, **news: Any) -> None:
        assert self._known is not None
        self._known.scene = replace(self._known.scene, **news)
        self._easel.send(self._known.scene)

    def _send(self, name: str, pixels: np.ndarray) -> None:
        self._easel.send(results.Picture(f"workshop {name}", results.frozen(np.ascontiguousarray(pixels))))

    def _picture(self, known: _Known) -> Iterator[None]:
        """Shows what is looked at; a large picture, or a dear one, first by one sample of each pixel, if need be of a
        coarser level."""
        asked, number = known.asked, known.number
        whole = Rect.at(*asked.origin, *asked.size)
        for level, few in _looks(whole, *costs_about(known.made, number, asked.level)):
            rect = whole.zoomed(-level)
            rim = int(asked.lit)
            rimmed = Rect(rect.x0 - rim, rect.y0 - rim, rect.x1 + rim, rect.y1 + rim)
            about = known.made, number, asked.level - level
            cost = costs_about(*about)[0] if few else line_look(*about).cost
            for planes in in_pieces(*about, rimmed, cost, few):
                if planes is None:
                    yield
                    continue
                marked = number < len(known.scene.lines) - 1
                seen = as_relief(planes) if asked.lit else as_seen(planes, asked.origin, marked)
                part = Rect(0, 0, rect.width, rect.height) if not level else _inner(whole, rect, level)
                self._send("texture", seen[part.y0 : part.y1, part.x0 : part.x1])
                found = histogram_of(planes)
                self._tell(counts=found.counts, least=found.least, most=found.most, drawn=known.scene.drawn + 1)
            yield

    def _lines(self, known: _Known) -> Iterator[None]:
        """Shows each line small, over as much as is looked at."""
        asked, count = known.asked, len(known.scene.lines)
        coarser = max(0, (min(asked.size) // wr.LINE_SIDE).bit_length() - 1)
        side, x, y = wr.LINE_SIDE, asked.origin[0] >> coarser, asked.origin[1] >> coarser
        rows = -(-count // wr.LINES_ACROSS)
        atlas = np.zeros((rows * side, wr.LINES_ACROSS * side, 4), np.uint8)
        told = list(known.scene.lines)
        for n in range(count):
            look = line_look(known.made, n, asked.level)
            told[n] = replace(told[n], coloured=look.coloured, samples=look.samples, cost=look.cost)
            yield
            for planes in in_pieces(known.made, n, asked.level - coarser, Rect.at(x, y, side, side), told[n].cost):
                if planes is not None:
                    top, left = n // wr.LINES_ACROSS * side, n % wr.LINES_ACROSS * side
                    atlas[top : top + side, left : left + side] = as_seen(planes, marked=n < count - 1)
                yield
            for planes in in_pieces(known.made, n, asked.level, Rect.at(*asked.origin, *_LOOKED), told[n].cost):
                if planes is not None:
                    values = brightness(planes)
                    told[n] = replace(told[n], least=float(values.min()), most=float(values.max()))
                yield
        self._send("lines", atlas)
        self._tell(lines=tuple(told), pictured=tuple(line.name for line in told))

    def _levels(self, known: _Known) -> Iterator[None]:
        """Shows the texture at five levels, about the middle of what is looked at."""
        asked, side, number = known.asked, wr.LEVEL_SIDE, len(known.scene.lines) - 1
        strip = np.zeros((side, wr.LEVELS_SHOWN * side, 4), np.uint8)
        middle = asked.origin[0] + asked.size[0] // 2, asked.origin[1] + asked.size[1] // 2
        for n in range(wr.LEVELS_SHOWN):
            finer = (n - wr.LEVELS_SHOWN // 2) * wr.LEVEL_STEP
            x, y = (at << finer if finer >= 0 else at >> -finer for at in middle)
            rect = Rect.at(x - side // 2, y - side // 2, side, side)
            for planes in in_pieces(known.made, number, asked.level + finer, rect, known.scene.lines[number].cost):
                if planes is not None:
                    strip[:, n * side : (n + 1) * side] = as_seen(planes)
                yield
        self._send("levels", strip)


def taken_values(written: WrittenText, given: Mapping[str, float | str]) -> tuple[tuple[str, float | str], ...]:
    """Returns the values of all sliders: those that are given and fit, else the usual ones."""
    return tuple((name, _fitted(slider, given.get(name))) for name, slider in written.sliders.items())


def _fitted(slider: Adjustable, value: object) -> float | str:
    if isinstance(slider.usual, str):
        return value.lower() if isinstance(value, str) else slider.usual
    return min(max(float(value), slider.least), slider.most) if isinstance(value, int | float) else slider.usual


def _read(asked: wr.WorkshopSet, before: _Known | None, named: Named) -> _Known:
    """Returns a text that was read, and what its lines are.  WrittenError tells what is wrong with it."""
    written = read(asked.text)
    felt = dict(zip(FELT, asked.felt, strict=True))
    values = (*taken_values(written, asked.values), *((FELT[name], felt[name]) for name in written.felt))
    cost = checked_cost(asked.text, values, named, 0, 0, asked.period)
    made = Expression(asked.level, asked.text, asked.period, 0, 0, values, False, named)
    lines = tuple(wr.WorkshopLine(line.name, written.place(line.at)[0], False, 1, 0.0) for line in written.lines)
    if before is not None and _alike(before, asked):
        lines = before.scene.lines
    sliders = tuple((name, s.usual, s.least, s.most, s.step) for name, s in written.sliders.items())
    drawn, pictured = (before.scene.drawn, before.scene.pictured) if before is not None else (0, ())
    scene = wr.WorkshopScene(asked.text, None, lines, sliders, drawn=drawn, felt=written.felt, pictured=pictured)
    if before is not None and before.asked.text == asked.text and len(before.scene.lines) == len(lines):
        scene = replace(scene, counts=before.scene.counts, least=before.scene.least, most=before.scene.most)
    known = _Known(asked, made, scene)
    if cost > COST_MOST / _DEARER:
        _check(known)
    return known


def _check(known: _Known) -> None:
    """Weaves a text from near, too, which is for a later piece of work where it can hardly be too dear there."""
    made, known.checked = known.made, True
    check_woven(made.text, made.values, made.named, 0, made.period)


def _looks(whole: Rect, one: float, most: float) -> list[tuple[int, bool]]:
    """Returns at how many levels coarser a picture is drawn, one after the other, and whether by one sample a pixel;
    that takes `one` nanoseconds, and at most it takes `most`, about."""
    coarser = 0
    while _is_much(whole.zoomed(-coarser), one):
        coarser += 1
    soon = not coarser and not _is_much(whole, most)
    looks = [(level, False) for level in sorted({min(coarser // 2, 1), 0}, reverse=True)]
    return looks if soon else [(coarser, True), *looks]


def _is_much(rect: Rect, cost: float) -> bool:
    """Tells whether something is too much for a first picture."""
    side = max(rect.width, rect.height)
    return side > _FIRST or (side > _LEAST and rect.width * rect.height * cost > _SOON)


def _alike(known: _Known, asked: wr.WorkshopSet) -> bool:
    """Tells whether the small pictures of what is known are all there, and those of what is asked for."""
    return known.whole and replace(known.asked, line=-1, lit=False) == replace(asked, line=-1, lit=False)


def _inner(whole: Rect, rect: Rect, coarser: int) -> Rect:
    """Returns which pixels of a coarser picture lie within a rectangle, about."""
    x, y = (whole.x0 >> coarser) - rect.x0, (whole.y0 >> coarser) - rect.y0
    return Rect.at(x, y, min(-(-whole.width >> coarser), rect.width), min(-(-whole.height >> coarser), rect.height))
