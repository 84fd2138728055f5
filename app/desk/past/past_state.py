"""What the window knows of the painting's past, and what of it is shown."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from datetime import datetime
from itertools import groupby
from typing import NamedTuple

from app.desk.presets import Preset
from engine.brush.ops import OPS
from engine.brush.settings import Brush, textures_of
from engine.studio.past.past_records import AskHere, Here, Jump, LookBack, PastScene, PastStep, StopJump
from engine.studio.requests import Request

Post = Callable[[Request], None]


class Run(NamedTuple):
    """Steps in a row that are shown as one: strokes or fills of one brush, steps of one kind, or a single other one."""

    steps: tuple[PastStep, ...]

    @property
    def last(self) -> PastStep:
        """Gives the step at its end."""
        return self.steps[-1]


@dataclass(slots=True)
class PastState:
    """`here`: the strokes that show at the place asked for last; `asking`: the next press asks for a place; `listing`:
    what the panel shows, "steps" or "here"; `opened`: the first number of the run whose steps are shown."""

    scene: PastScene = field(default_factory=PastScene)
    here: Here | None = None
    asking: bool = False
    listing: str = "steps"
    opened: int | None = None
    _runs: tuple[PastScene | None, tuple[Run, ...]] = (None, ())

    @property
    def looking(self) -> int | None:
        """Gives the number of the step that is looked at instead of the painting."""
        return self.scene.looking

    @property
    def runs(self) -> tuple[Run, ...]:
        """Returns all steps, in runs."""
        if self._runs[0] is None or self._runs[0].steps != self.scene.steps:
            self._runs = self.scene, runs_of(self.scene.steps)
        return self._runs[1]

    def ask(self, post: Post, level: int, x: int, y: int) -> None:
        """Asks for the strokes that show at a pixel of a level."""
        self.asking, self.listing, self.here = False, "here", None
        post(AskHere(level, x, y))

    def take(self, found: Here) -> None:
        """Shows the strokes at a place; of those shown already, none goes away while they are looked for anew."""
        now = self.here
        if now is None or now.place != found.place or not found.more or len(found.strokes) >= len(now.strokes):
            self.here = found

    def jump(self, post: Post, number: int) -> None:
        """Makes a step the last one that is done."""
        post(Jump(number))

    def look(self, post: Post, number: int | None) -> None:
        """Looks at the painting as it was after a step; None: as it is."""
        post(LookBack(number))

    def stop(self, post: Post) -> None:
        """Gives up the way to a step."""
        post(StopJump())


def runs_of(steps: Sequence[PastStep]) -> tuple[Run, ...]:
    """Returns steps in runs: strokes of one brush together, whatever its size, strength and colour, fills likewise, and
    steps of one kind."""
    return tuple(Run(tuple(run)) for _, run in groupby(steps, _together))


def _together(step: PastStep) -> object:
    """Returns what steps in a row must have in common to be shown as one."""
    if step.brush is None:
        return step.kind or step.number
    return step.title, look_of(step.brush)


def look_of(brush: Brush) -> tuple[object, ...]:
    """Returns what makes a brush that brush: all but size, strength, colour and paper."""
    own = (brush.mode, brush.hardness, brush.spacing, brush.flow, brush.ink)
    return (
        *own,
        brush.op if brush.row.uses_op else None,
        brush.density,
        brush.shaping,
        brush.edge,
        brush.tip,
        brush.extent,
        brush.example,
    )


def brush_name(brush: Brush, presets: Sequence[Preset]) -> str:
    """Returns the name of the preset that a brush is, or else what it does, and with which textures."""
    look = look_of(brush)
    named = next((preset.name for preset in presets if look_of(preset.brush) == look), None)
    if named is not None:
        return named
    if brush.row.takes_away:  # a brush that is used to erase
        named = next((preset.name for preset in presets if look_of(preset.brush)[1:] == look[1:]), None)
        return brush.row.label if named is None else f"{brush.row.label}: {named}"
    return ", ".join((_does(brush), *textures_of(brush)))


def _does(brush: Brush) -> str:
    """Returns in a word what a brush does to paint."""
    if not brush.row.uses_op:
        return brush.row.label
    name = brush.op if isinstance(brush.op, str) else brush.op.get("name")
    return "Formula" if name is None else OPS[name].label


def step_name(step: PastStep, presets: Sequence[Preset]) -> str:
    """Returns what a step is called."""
    if step.brush is None:
        return step.title
    name = brush_name(step.brush, presets)
    return name if step.title == step.brush.row.label else f"{step.title}: {name}"


def when(time: float | None, now: datetime) -> str:
    """Returns a time as one reads it: the hour, with the day where that is another than `now`'s; empty for none."""
    if time is None:
        return ""
    at = datetime.fromtimestamp(time)
    if at.date() == now.date():
        return f"{at:%H:%M}"
    return f"{at.day} {at:%b %H:%M}" if at.year == now.year else f"{at.day} {at:%b %Y}"
