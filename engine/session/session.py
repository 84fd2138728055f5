"""A session: the painting now, its past and future, and the recording of all that was done.

Replaying the recording gives the same pixels: what could not be done is not in it, and an undo is in it with the
number of steps that were there to undo.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from immutables import Map

from engine.brush.copies import NO_COPIES, Copies
from engine.brush.settings import Brush
from engine.canvas import layers
from engine.canvas.placing.pose import Pose
from engine.canvas.tile_cache import TileCache
from engine.checks.owned import Owned
from engine.keeping import memory
from engine.painting import commands as c
from engine.painting.layering.onto_member import ONTO_PAINT
from engine.painting.recording import Recording
from engine.painting.textures import Around, recorded
from engine.painting.value import Painting, blank, header_for
from engine.session.apply import STEPS, apply
from engine.session.history import History
from engine.session.logged.command_log import CommandLog
from engine.session.room import Room
from engine.session.steps import Steps
from engine.strokes.example_stroke import Live, kind_of
from engine.texture.image import ImageSource

_SOME_STEPS = 64  # crossed at once, after which memory is looked after
Heard = Callable[[c.Command, Live | None], None]


class Session(Owned):
    """One painting being worked on.  It belongs to the thread that made it; the paintings it hands out are for all.

    `state`: another object as soon as the painting is another one; the same while it is only refined;
    `log`: commands that led to `painting`, if they are known; `folder`: what paths in commands are relative to;
    `pictures`: those that definitions may name by their sha besides the painting's, wherever their files are now;
    `extra`: members of the recording's header that this version does not know; `base`: what the
    log begins with; `leapt`: whether there are steps beyond what the history holds that can be reached; `room` looks
    after the memory that it takes;
    `heard` is told each command as it is recorded, with the stroke if it grew as one.
    """

    def __init__(
        self,
        painting: Painting | None = None,
        cache: TileCache | None = None,
        log: Iterable[c.Command] = (),
        folder: Path | None = None,
        history: History | None = None,
        extra: Map[str, Any] | None = None,
    ) -> None:
        self.painting = painting if painting is not None else Painting()
        self.state: object = object()
        self.cache = cache if cache is not None else TileCache(memory.cache_share())
        self.folder = folder
        self.pictures: Mapping[str, ImageSource] = Map()
        self.log = CommandLog(log)
        self._history = history if history is not None else History(memory.history_share())
        self._extra = extra if extra is not None else Map()
        given = self.painting
        self.base = blank(given) if self.log else given
        self.leapt = False
        self._steps: Steps | None = None
        self.heard: Heard = lambda command, live: None
        self.room = Room(self.cache, self._history)

    @property
    def can_undo(self) -> bool:
        """Tells whether there is a step to take back."""
        return self._history.undo_count > 0 or (self.leapt and self.steps.count > 0)

    @property
    def can_redo(self) -> bool:
        """Tells whether there is a step to do again."""
        return self._history.redo_count > 0 or (self.leapt and bool(self.steps.undone))

    @property
    def history(self) -> History:
        """Gives the paintings before and after."""
        return self._history

    @property
    def steps(self) -> Steps:
        """Gives the steps that the log comes to, as it is now."""
        if self._steps is None:
            self._steps = Steps(self.base)
        self._steps.follow(self.log)
        return self._steps

    def do(self, command: c.Command, lent: ImageSource | None = None) -> Painting:
        """Carries out any command; returns the painting after it.  Refusal or FileError: nothing has changed, nothing
        is recorded.  `lent`: a picture that a definition may name by its sha."""
        if isinstance(command, c.Undo | c.Redo):
            return self._travel(command)
        after = apply(self.painting, command, self.around(lent))
        if isinstance(command, c.DefineTexture):
            command = recorded(command, after.textures[command.name])
        return self._done(command, after)

    def begin(
        self,
        level: int,
        origin: tuple[int, int],
        brush: Brush,
        layer: str | None = None,
        seed: int | None = None,
        copies: Copies = NO_COPIES,
        onto: str = ONTO_PAINT,
        seen: Pose | None = None,
    ) -> Live:
        """Returns a stroke whose points are still to come; hand it to `finish`."""
        return kind_of(brush)(self.painting, level, origin, brush, self.cache, layer, seed, copies, onto, seen)

    def finish(self, live: Live) -> Painting:
        """Returns the stroke done: the same as its command, without doing the work twice.  One without a point is
        nothing."""
        if live.empty:
            return self.painting
        if live.before is not self.painting:  # something else was done in between
            command = live.to_command()
            return self._done(command, apply(self.painting, command, self.around()), live)
        return self._done(live.to_command(), live.commit(), live)

    def recording(self) -> Recording:
        """Returns all that was done, as a recording that gives this painting."""
        header = replace(header_for(self.painting), extra=self._extra)
        return Recording(header, self.log.now(), folder=self.folder)

    def around(self, lent: ImageSource | None = None) -> Around:
        """Returns what definitions find around them: pictures of textures by their sha, wherever their files are
        now; `lent` among them."""
        textures = self.painting.textures.values()
        sources = (lent, *(one for texture in textures for one in texture.pictures))
        known = {source.sha: source for source in sources if source is not None}
        return Around(self.cache, self.folder, {**self.pictures, **known}, self.painting.arithmetic)

    def _done(self, command: c.Command, after: Painting, live: Live | None = None) -> Painting:
        if type(command) in STEPS:
            self._history.push(self.painting, after)
            self.leapt = self.leapt or self._history.forgotten > 0
        last = self.log[-1] if self.log else None
        if _replaces(command, last):
            self.log.pop()
        self.log.append(command)
        if after is not self.painting:
            self.painting, self.state = after, object()
        self.heard(command, live)
        self.room.keep_within(after.root)
        return after

    def amend(self, painting: Painting) -> None:
        """Takes the same painting, with what is painted with examples further refined: no step, and nothing to
        record."""
        self.painting = painting
        self._history.amend(painting.root)

    def _travel(self, command: c.Undo | c.Redo) -> Painting:
        undoing = isinstance(command, c.Undo)
        there = self._history.undo_count if undoing else self._history.redo_count
        count = min(command.count, there)
        if not count:
            return self.painting
        step = self._history.undo if undoing else self._history.redo
        for number in range(1, count + 1):
            found = step()
            if number % _SOME_STEPS == 0:
                self.room.keep_within(found.root)
        self._arrive(found, replace(command, count=count))
        self.room.keep_within(self.painting.root)
        return self.painting

    def leap(self, number: int, found: Painting, history: History) -> Painting:
        """Makes the step of a number (`Steps`) the last one that is done, though the history does not hold it.

        `found`: the painting after it, played anew, and `history` what led to it.  Recorded as undo or redo is.
        """
        by = number - self.steps.count
        self._history = self.room.history = history
        history.lessens = self.leapt = True
        found = replace(found, active=self.steps.active_at(number))
        return self._arrive(found, c.Undo(-by) if by < 0 else c.Redo(by))

    def _arrive(self, found: Painting, command: c.Undo | c.Redo) -> Painting:
        """What is no step stays as it is: the textures defined, bookmarks, what was copied, and the active layer if it
        is still there."""
        kept = self.painting
        stays = kept.active is not None and layers.has(found.root, kept.active)
        active = kept.active if stays else found.active
        self.painting = replace(found.beside(kept), active=active)
        self.state = object()
        self.log.append(command)
        self.heard(command, None)
        return self.painting


def _replaces(command: c.Command, last: c.Command | None) -> bool:
    """Tells whether a definition takes the place of another: nothing was done with that, nor is it named."""
    if not (isinstance(command, c.DefineTexture) and isinstance(last, c.DefineTexture) and last.name == command.name):
        return False
    return command.name not in command.arguments.get("named", ())
