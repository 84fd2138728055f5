"""What was selected when a stroke was painted, known by the command that selected it until somebody asks for more."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from immutables import Map

from engine.canvas import layers
from engine.canvas.layers import EMPTY
from engine.canvas.placing.pose import Pose
from engine.canvas.selecting.mask_sheet import mask_of
from engine.canvas.selecting.selection import NONE_SAVED, Saved, Selection
from engine.canvas.store import Pyramid
from engine.canvas.tile_cache import TileCache
from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.numeric.similarity import Similarity
from engine.painting import commands as c
from engine.painting.fill_command import Like
from engine.painting.select_commands import MaskOf, Named, Select, Whole
from engine.painting.textures import Texture
from engine.painting.value import Painting, Refusal
from engine.session.lifting.moved_part import selection_at
from engine.session.selecting import selected

Definitions = Map[str, c.DefineTexture]
NO_DEFINITIONS: Definitions = Map()
Held = Callable[[int], "Painting | None"]  # the painting after the step of a number, where it is at hand
UNKNOWN = Selection(Pyramid())
_KEPT = 1024  # selections
_HALF = 0.5  # of what lies under a selection that nobody knows any more


@dataclass(frozen=True, eq=False, slots=True)
class ByCommand(Selection):
    """Stands for what a command selected, with which nothing is worked out: `number` of its step, what was selected
    and kept before, and the textures that were defined.  `by`: moved with a layer or a part of one; `masks`: not what
    was selected then, but the mask of a layer, on which the step painted."""

    number: int = 0
    command: Select | None = None
    old: Selection | None = None
    saved: Saved = NONE_SAVED
    textures: Definitions = NO_DEFINITIONS
    by: Similarity | None = None
    masks: str | None = None

    def moved(self, by: Similarity) -> ByCommand:
        """Returns what stands for the same elsewhere."""
        return ByCommand(Pyramid(), off=self.off, old=self, by=by)


def choosing(painting: Painting, command: Select, number: int, textures: Definitions) -> Painting:
    """Returns a painting without paint, with something else selected that is known by its command."""
    found: Selection | None = None
    if not (isinstance(command.source, Whole) and command.source.what == "none"):
        old, kept = painting.selection, painting.selections
        found = ByCommand(Pyramid(), number=number, command=command, old=old, saved=kept, textures=textures)
    kept = painting.selections
    if command.keep is not None:
        name = command.keep
        kept = kept.set(name, found) if found is not None else kept.delete(name) if name in kept else kept
    return replace(painting, selection=found, selections=kept)


class Choices:
    """Finds what selections were, and keeps it: where the painting of that time is at hand, its own; else what the
    commands make of one another, which needs no paint, but where a region of like colour or a layer was selected."""

    def __init__(
        self, held: Held, textures: Callable[[Definitions], dict[str, Texture]], cache: TileCache | None
    ) -> None:
        self._held, self._textures, self._cache = held, textures, cache
        self.painting = Painting()
        self._known: dict[int, tuple[Selection, Selection | None]] = {}
        self._parts: dict[tuple[int, int, Rect], np.ndarray | float] = {}

    def _learn(self, chosen: Selection | None, value: Selection | None) -> None:
        """Takes in what one is, from a painting that has it."""
        if isinstance(chosen, ByCommand):
            self._known[id(chosen)] = chosen, value

    def part(self, chosen: Selection, level: int, rect: Rect) -> np.ndarray | float:
        """Returns how far pixels were selected, as `Selection.part`; a half where nobody knows."""
        found = self.value(chosen)
        if found is None or found is UNKNOWN:
            return 1.0 if found is None else _HALF
        key = id(found), level, rect
        if key not in self._parts:
            self._parts[key] = found.part(level, rect, self._cache)
        return self._parts[key]

    def begin(self, painting: Painting, bare: Painting) -> None:
        """Another place is looked at, in a painting; `bare`: that without its paint, as the steps know it."""
        self.painting = painting
        self._parts.clear()
        if len(self._known) > _KEPT:
            self._known.clear()
        self._learn(bare.selection, painting.selection)
        for name, kept in bare.selections.items():
            self._learn(kept, painting.selections.get(name))

    def value(self, chosen: Selection | None) -> Selection | None:
        """Returns what a selection was, UNKNOWN where nobody knows."""
        waiting: list[ByCommand] = []
        at = chosen
        while isinstance(at, ByCommand) and id(at) not in self._known:
            there = self._held(at.number) if at.number else None
            if there is not None:
                self._learn(at, _turned(at, _of(at, there)))
            else:
                waiting.append(at)
                at = at.old if _joins(at) else None
        for one in reversed(waiting):
            self._learn(one, _turned(one, self._made(one)))
        return self._known[id(chosen)][1] if isinstance(chosen, ByCommand) else chosen

    def _moved(self, selection: Selection, by: Similarity) -> Selection:
        return selection_at(selection, Pose.of(by), self.painting.frame, self.painting.grid)

    def _made(self, one: ByCommand) -> Selection | None:
        old = self.value(one.old) if _joins(one) else None
        if one.by is not None:
            return old if old is None or old is UNKNOWN else self._moved(old, one.by)
        if one.command is None:
            return UNKNOWN
        source, kept = one.command.source, one.saved
        if isinstance(source, Named) and source.saved:
            kept = kept.set(source.name, self.value(kept.get(source.name)) or UNKNOWN)
        needs_paint = isinstance(source, Like | MaskOf) or (isinstance(source, Named) and not source.saved)
        if needs_paint or old is UNKNOWN or kept.get(getattr(source, "name", "")) is UNKNOWN:
            return UNKNOWN
        textures = Map(self._textures(one.textures))
        ground = replace(self.painting, root=EMPTY, textures=textures, selection=old, selections=kept)
        try:
            return selected(ground, one.command).selection
        except (Refusal, FieldError):  # the log is of another painting
            return UNKNOWN


def _joins(one: ByCommand) -> bool:
    """Tells whether one depends on what was selected before."""
    command = one.command
    if command is None:
        return one.by is not None
    if command.source is None:
        return True
    return command.op != "replace" or (isinstance(command.source, Whole) and command.source.what == "invert")


def _of(one: ByCommand, painting: Painting) -> Selection | None:
    """Returns what one stands for, of the painting after its step."""
    if one.masks is None:
        return painting.selection
    return mask_of(layers.find(painting.root, one.masks)) if layers.has(painting.root, one.masks) else UNKNOWN


def _turned(one: ByCommand, found: Selection | None) -> Selection | None:
    """Returns what was found, or all but that."""
    return found.inverted() if found is not None and found is not UNKNOWN and one.inverse else found
