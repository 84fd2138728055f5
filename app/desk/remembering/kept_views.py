"""What was seen last of each painting, as `views.json` in the state folder: it is seen so again when it is opened."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

from app.canvas.standpoint import standpoint_at
from app.desk.desk import Desk, FileWork
from app.desk.places.going import free_size, here
from app.desk.remembering.kept_json import KeptObject, read_kept_object, write_kept_object
from engine.checks.field_error import FieldError
from engine.checks.values import described
from engine.keeping.state_folder import state_folder
from engine.painting.commands import parse, to_json
from engine.painting.places import LEVEL_LIMIT, Bookmark

MOST_VIEWS = 200
_PAUSE = 1.0  # seconds from one look to the next
_NAME = "view"

Views = dict[str, Bookmark]


def _place() -> Path:
    return state_folder("recent") / "views.json"


def views_of(told: KeptObject) -> Views:
    """Returns the views that an object tells.  ValueError, one line, where one is none."""
    found: Views = {}
    for path, view in list(told.items())[-MOST_VIEWS:]:
        one = parse(view) if isinstance(view, dict) else None
        if not isinstance(one, Bookmark):
            raise FieldError("view", described(view), "a bookmark")
        found[path] = one
    return found


@dataclass(frozen=True, slots=True)
class ReadViews(FileWork):
    """Reads them; a damaged file is as if there were none, and is put aside with the next that is kept."""

    def carry_out(self) -> tuple[Views, str]:
        """Returns them, and what is wrong with the file."""
        return read_kept_object(_place(), views_of, {})

    def arrive(self, desk: Desk, found: tuple[Views, str]) -> None:
        """Puts them on the desk."""
        desk.remembered.views = {**found[0], **desk.remembered.views}
        if found[1]:
            desk.say(f"{found[1]}; paintings are shown whole", bad=True)

    def fail(self, desk: Desk, fault: str) -> None:
        """Goes on without."""


@dataclass(frozen=True, slots=True)
class KeepView(FileWork):
    """Writes what is seen of one painting, the newest last."""

    path: str
    view: Bookmark

    def carry_out(self) -> None:
        """Writes the file."""
        place = _place()
        none: Views = {}
        before, fault = read_kept_object(place, views_of, none)
        before.pop(self.path, None)
        views = {**dict(list(before.items())[1 - MOST_VIEWS :]), self.path: self.view}
        write_kept_object(place, {path: to_json(view) for path, view in views.items()}, bool(fault))

    def arrive(self, desk: Desk, found: None) -> None:
        """Tells nothing: nobody asked for it."""

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells nothing, likewise."""


class ViewsWatched:
    """Notes what is seen of the painting; all calls from the window's thread."""

    def __init__(self) -> None:
        self._next, self._serial = 0.0, -1
        self._noted: KeepView | None = None

    def watch(self, desk: Desk, now: float) -> None:
        """Notes the view now and then; keeps it once another painting is there.  Called in every frame."""
        scene = desk.known.scene
        if scene is None or (now < self._next and scene.serial == self._serial):
            return
        self._next = now + _PAUSE
        if scene.serial != self._serial:
            self.end(desk)
            self._serial, self._noted = scene.serial, None
        there = here(desk)
        if scene.path is None or desk.glide.moving or abs(there.level) >= LEVEL_LIMIT:
            return
        self._noted = KeepView(os.path.abspath(scene.path), there.bookmark(_NAME, free_size(desk)))

    def end(self, desk: Desk) -> None:
        """Keeps what was noted."""
        noted = self._noted
        if noted is not None and desk.remembered.views.get(noted.path) != noted.view:
            desk.remembered.views[noted.path] = noted.view
            desk.work(noted)


def show_as_before(desk: Desk, path: Path | None) -> None:
    """Shows a painting as it was seen last; whole, where that is not known."""
    view = None if path is None else desk.remembered.views.get(os.path.abspath(path))
    desk.fit()
    if view is not None:
        desk.view = standpoint_at(view, free_size(desk)).seen_from(desk.view, *desk.middle())
