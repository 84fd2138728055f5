"""What the window asks for of a texture that is being written, and what it is told.

Light on purpose, as `requests` and `results`.
"""

from __future__ import annotations

from dataclasses import dataclass

from immutables import Map

Setting = tuple[
    str, float | str, float, float, float
]  # a slider: name, usual, least, most, step; a colour: name, usual


@dataclass(frozen=True, slots=True)
class WorkshopSet:
    """A text, and the values of its sliders, those that fit; `period`: pixels of level 0 that it calls 1.  `line`: the
    one that is looked at, counted from 0, -1 for the texture; over `size` (width, height) pixels of a `level` from
    `origin` on; `lit`: as heights in the light; `felt`: where the pen pressed so much, so far within the rim, 0 to
    1 each, and where the stroke runs so, in degrees.  The newest counts."""

    text: str
    values: Map[str, float | str] = Map()  # noqa: RUF009  # it never changes
    period: float = 64.0
    line: int = -1
    level: int = 0
    origin: tuple[int, int] = (0, 0)
    size: tuple[int, int] = (256, 256)
    lit: bool = False
    felt: tuple[float, float, float] = (1.0, 1.0, 0.0)


@dataclass(frozen=True, slots=True)
class WorkshopAsk:
    """What all lines are at a pixel of the level that is looked at; None: nowhere any more."""

    place: tuple[int, int] | None


@dataclass(frozen=True, slots=True)
class WorkshopWord:
    """A function: its name, how it is written, and what it does."""

    name: str
    form: str
    about: str


@dataclass(frozen=True, slots=True)
class WorkshopMistake:
    """Where a text is wrong, counted from 1, and what was found there and expected."""

    line: int
    column: int
    found: str
    expected: str


@dataclass(frozen=True, slots=True)
class WorkshopLine:
    """A line of the text: its `name`, "" if it has none; the row it begins in, from 1; whether it is `coloured`; how
    many `samples` a pixel takes, and nanoseconds; its least and its greatest value, of a colour its brightness."""

    name: str
    row: int
    coloured: bool
    samples: int
    cost: float
    least: float = 0.0
    most: float = 0.0


@dataclass(frozen=True, slots=True)
class WorkshopScene:
    """What is known of a text besides the pictures "workshop texture", "workshop lines" (small, LINES_ACROSS side by
    side) and "workshop levels" (LEVELS_SHOWN side by side, from the coarsest).

    `mistake`: then the rest is of the last text that was right; `counts`: how often values are seen, from `least` to
    `most` of what is looked at, red, green, blue, or one for all; `shimmer`: how far the level is from the next finer
    one reduced, rms of 0..255, -1 while that is not known; `drawn`: how many pictures were; `busy`: kernels are made;
    `felt`: what of FELT the text looks at; `pictured`: the names of the lines of which there are small pictures.
    """

    text: str
    mistake: WorkshopMistake | None = None
    lines: tuple[WorkshopLine, ...] = ()
    sliders: tuple[Setting, ...] = ()
    counts: tuple[tuple[int, ...], ...] = ()
    least: float = 0.0
    most: float = 1.0
    shimmer: float = -1.0
    drawn: int = 0
    busy: bool = False
    felt: tuple[str, ...] = ()
    pictured: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class WorkshopWords:
    """All functions of the language, the names of places with what they are, and textures that come along."""

    functions: tuple[WorkshopWord, ...] = ()
    names: tuple[WorkshopWord, ...] = ()
    textures: tuple[WorkshopWord, ...] = ()


@dataclass(frozen=True, slots=True)
class WorkshopValues:
    """What all lines are at a pixel: one number, or four of a colour, premultiplied."""

    place: tuple[int, int]
    values: tuple[tuple[float, ...], ...]


LINES_ACROSS, LINE_SIDE = 8, 48  # small pictures of lines; pixels of each
LEVELS_SHOWN, LEVEL_SIDE, LEVEL_STEP = 5, 96, 2  # pictures of levels, pixels of each, levels from one to the next
WorkshopRequest = WorkshopSet | WorkshopAsk
WorkshopResult = WorkshopScene | WorkshopWords | WorkshopValues
