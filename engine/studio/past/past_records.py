"""What the window asks about the past of the painting, and what it is told: frozen records.

Light on purpose, as `requests` and `results`.  A step's `index` is the place of its command in the log, from 0; its
`number` how many steps are done with it, from 1; 0 is the painting before all of them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from engine.brush.settings import Brush


@dataclass(frozen=True, slots=True)
class ShowPast:
    """The steps are to be told from now on, or not any more; `pictures`: the indices of those whose pictures are
    wanted, the most urgent first.  The newest counts."""

    shown: bool = True
    pictures: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class LookBack:
    """The painting is to be seen as it was after the step of a number; None: as it is."""

    number: int | None = None


@dataclass(frozen=True, slots=True)
class Jump:
    """The step of a number is to be the last one that is done: a number of steps is undone, or done again."""

    number: int


@dataclass(frozen=True, slots=True)
class StopJump:
    """What is played to see or reach a step is not wanted any more."""


@dataclass(frozen=True, slots=True)
class AskHere:
    """The strokes that show at a pixel of a level."""

    level: int
    x: int
    y: int


PastRequest = ShowPast | LookBack | Jump | StopJump | AskHere


@dataclass(frozen=True, slots=True)
class PastStep:
    """A step; `brush` of a stroke or a fill, at `level`; `time`: seconds since 1970, if that is known; `picture`: the
    name of its picture; `kind`: steps in a row of one are shown together, "" for one that stands for itself;
    `sign`: what it deals with, of those that `step_words` knows."""

    index: int
    number: int
    title: str
    picture: str
    brush: Brush | None = None
    level: int = 0
    time: float | None = None
    kind: str = ""
    sign: str = ""


@dataclass(frozen=True, slots=True)
class PastScene:
    """All steps, `done` of them done; those of `held`, from the first number to the last, are at hand.  `looking`: the
    number of the one that is seen instead of the painting; `playing`: how far what is played to reach one is, 0..1."""

    steps: tuple[PastStep, ...] = ()
    done: int = 0
    held: tuple[int, int] = (0, 0)
    looking: int | None = None
    playing: float | None = None


@dataclass(frozen=True, slots=True)
class HereStroke:
    """A stroke that shows at a place: how much, 0..1, on which layer; `seed` of its textures."""

    step: PastStep
    layer: str
    share: float
    seed: int
    textures: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Here:
    """The strokes that show at a pixel (level, x, y), the newest first; `more`: older ones are still looked for."""

    place: tuple[int, int, int]
    strokes: tuple[HereStroke, ...]
    more: bool = False


PastResult = PastScene | Here
