"""What is known of the painting and the engine: what the engine has told so far, and what lies in the palettes.

The record never changes; `told` gives the next one.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from app.desk.presets import Paper, Preset
from engine.canvas.placing.pose import Pose
from engine.files.swatches.colour_list import ColourList
from engine.numeric.address import Rect
from engine.painting.layering.placing_members import Placing
from engine.studio import results
from engine.studio.held.held_records import Held
from engine.studio.land.wear_records import WornTold
from engine.studio.results import FilmLength, Growing, LayerRow, Note, Opening, Prepared, Ready, Scene, Writing

FIRST_FRAME = Rect(0, 0, 1024, 768)  # that is shown until the engine tells of a painting


@dataclass(frozen=True, slots=True)
class Known:
    """`ready`: whether the engine is loaded; `tables`: its rows, of textures, operations and so on; `scene`: the
    painting; `pending`: screen tiles that wait to be made; `growing`: what is painted with examples and not yet as it
    will stay, `grows` since when; `preparing`: since when the engine gets ready for painting with examples, if it
    does; `prepared`: how many brushes are ready; `opening`: the file that is being opened; `filming`: the part done of
    a film that is being made, `film_length`: of the one that is asked about; `playing`: of a
    recording that plays; `wearing`: of an erosion; `held`: who holds what memory.  Times
    are seconds of time.monotonic()."""

    ready: bool = False
    tables: Ready = Ready()  # noqa: RUF009  # it is frozen
    presets: tuple[Preset, ...] = ()
    papers: tuple[Paper, ...] = ()
    palettes: tuple[ColourList, ...] = ()
    scene: Scene | None = None
    pending: int = 0
    writing: Writing = Writing()  # noqa: RUF009
    growing: Growing | None = None
    grows: float = 0.0
    preparing: float | None = None
    prepared: Prepared = Prepared(0, 0)  # noqa: RUF009
    opening: Opening | None = None
    filming: float | None = None
    playing: float | None = None
    film_length: FilmLength = FilmLength()  # noqa: RUF009
    wearing: float | None = None
    held: Held = Held()  # noqa: RUF009

    @property
    def frame(self) -> Rect:
        """Returns the painting's frame, in pixels of level 0."""
        return self.scene.frame if self.scene else FIRST_FRAME

    @property
    def paper(self) -> str | None:
        """Returns the colour of the ground under all layers; None where there is none."""
        return self.scene.paper if self.scene else None

    @property
    def modified(self) -> bool:
        """Tells whether the painting has changes that are not saved."""
        return self.scene is not None and self.scene.modified

    @property
    def path(self) -> Path | None:
        """Returns the painting's file."""
        return self.scene.path if self.scene else None

    @property
    def title(self) -> str:
        """Returns what the painting is called: by its file's name, if it has one."""
        return self.path.name if self.path else (self.scene.name if self.scene else "") or "Untitled"

    @property
    def stem(self) -> str:
        """Returns the name that is proposed for its file, without an ending."""
        return self.path.stem if self.path else (self.scene.name if self.scene else "") or "untitled"

    @property
    def active(self) -> LayerRow | None:
        """Returns the layer or group that is painted on."""
        scene = self.scene
        return None if scene is None else next((row for row in scene.layers if row.name == scene.active), None)

    @property
    def wrapping(self) -> bool:
        """Tells whether a layer in sight is repeated without end: then so is what lies under it."""
        return self.scene is not None and any(row.wrap is not None and row.visible for row in self.scene.layers)

    @property
    def hiding(self) -> tuple[str, ...]:
        """Returns what hides the layer that is painted on, from the inside out: itself, and groups around it."""
        found, row = [], self.active
        rows = {row.name: row for row in self.scene.layers} if self.scene else {}
        while row is not None:
            if not row.visible:
                found.append(row.name)
            row = rows.get(row.parent) if row.parent is not None else None
        return tuple(found)


def known_after(known: Known, result: object, now: float) -> Known:
    """Returns what is known after a result that came at a time; the same if it tells nothing of this."""
    teller = _TELLERS.get(type(result))
    news = {} if teller is None else teller(known, result, now)
    return replace(known, **news) if news else known


def _note(known: Known, result: Note, _now: float) -> dict[str, Any]:
    return {"opening": None} if result.about == "engine" and known.opening else {}  # there is none that could open it


def _growing(known: Known, result: Growing, now: float) -> dict[str, Any]:
    done = result.done >= 1.0 or not result.rects
    return {"growing": None if done else result, "grows": known.grows if known.growing is not None else now}


_TELLERS: dict[type, Callable[[Known, Any, float], dict[str, Any]]] = {
    results.Ready: lambda known, r, now: {"ready": True, "tables": r},
    results.Scene: lambda known, r, now: {"scene": r},
    results.Opening: lambda known, r, now: {"opening": r if r.name else None},
    results.Note: _note,
    results.Pending: lambda known, r, now: {"pending": r.tiles},
    results.Writing: lambda known, r, now: {"writing": r},
    results.GotReady: lambda known, r, now: {"preparing": None},
    results.Prepared: lambda known, r, now: {"prepared": r},
    results.Growing: _growing,
    results.Filming: lambda known, r, now: {"filming": r.part},
    results.Played: lambda known, r, now: {"playing": r.part},
    results.FilmLength: lambda known, r, now: {"film_length": r},
    WornTold: lambda known, r, now: {"wearing": r.part},
    Held: lambda known, r, now: {"held": r},
}


def moved_by(row: LayerRow, level: int, x: int, y: int) -> Placing | None:
    """Returns where a layer, group or placement is when it is moved by pixels of a level; None: where it was."""
    if not (x or y):
        return None
    by = Pose(at=(x, y), level=level)
    return Placing.at_pose(by if row.shows is None else row.shows.pose.followed(by.similarity))
