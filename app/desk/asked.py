"""What is asked of the artist, and what goes on after the answer."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from app.canvas.view import Place
from app.desk.known import Known
from app.desk.outside.found_map import FoundMap
from app.desk.presets import Preset
from engine.painting.commands import Command
from engine.painting.layer_commands import BakePlacement
from engine.painting.places import Bookmark
from engine.studio.filing.film_requests import FilmWish
from engine.studio.results import Overtaken

Then = Callable[[], None]
FILM_SIZES = ((1280, 720), (1920, 1080), (1080, 1080), (1080, 1920))


@dataclass(slots=True)
class FilmState:
    """`kind`: "replay", "flight" or "both"; `marks`: it flies through the bookmarks, else to what is in view; `close`:
    a replay shows what is in view, else the frame; `size`: a row of FILM_SIZES, None for the frame's own; `seconds`: 0
    for as long as it takes; `at`: the part, 0..1, of which a picture is shown; `wished`: what all that means."""

    kind: str = "replay"
    marks: bool = False
    close: bool = False
    size: tuple[int, int] | None = FILM_SIZES[0]
    seconds: int = 0
    fps: int = 30
    by_clock: bool = False
    undone: bool = False
    brush: bool = True
    at: float = 1.0
    wished: FilmWish | None = None


@dataclass(slots=True)
class Asked:
    """`dialog`: a row of app.panels.dialogs.DIALOGS that is to be shown; `shown`: the one that is; `then`: goes on once
    unsaved changes are dealt with, `otherwise` if they are not to be, `why`: what would take the painting's place;
    `after_save`: goes on once the painting is saved, `after_film` once the film is made; `overtaken`: the save that is
    asked about; `quit`: the window is to go; `texture`: a name under which one is being made, which joins the ink
    when the painting has it; `merge`: what merges layers once that is told, ink going no finer than `merge_level`;
    `bake`: what makes paint of a placement and loses detail; `film`: what is chosen of the film that is asked for;
    `bringing`: a picture that was given to the painting, and to which place of the canvas; `doctor`: one of which
    the texture doctor is asked; `ground`: a map that is to
    be laid; `brush`: one that is to be shared; `deleted`: what brings the last one back that was deleted."""

    dialog: str = ""
    shown: str = ""
    then: Then | None = None
    otherwise: Then | None = None
    why: str = ""
    after_save: Then | None = None
    after_film: Then | None = None
    overtaken: Overtaken | None = None
    quit: bool = False
    texture: str = ""
    merge: Command | None = None
    merge_level: int = 0
    bake: BakePlacement | None = None
    bake_loses: tuple[bool, bool] = (True, False)  # fine detail, and how thick its paint is
    film: FilmState = field(default_factory=FilmState)
    bringing: tuple[Path, Place] | None = None
    doctor: Path | None = None
    ground: FoundMap | None = None
    brush: Preset | None = None
    deleted: Then | None = None

    def show(self, dialog: str) -> None:
        """Opens a dialog by its name."""
        self.dialog = dialog

    def taken(self) -> str:
        """Gives the dialog that is to be shown, once."""
        self.shown, self.dialog = self.dialog, ""
        return self.shown

    def about_changes(self, then: Then, otherwise: Then | None = None, why: str = "") -> None:
        """Asks what is to become of unsaved changes, before `then`, or `otherwise` if the answer is to go back."""
        self.then, self.otherwise, self.why = then, otherwise, why
        self.show("unsaved")

    def about_overtaken(self, told: Overtaken) -> None:
        """Asks what is to become of a save; what follows it waits for the answer."""
        self.overtaken = told
        self.show("overtaken")

    def close(self) -> None:
        """Lets the window go."""
        self.quit = True

    def go_on(self) -> None:
        """Lets the changes go, and does what was to follow."""
        then, self.then, self.otherwise = self.then, None, None
        if then is not None:
            then()

    def give_up(self) -> None:
        """Lets nothing follow a save or a film: it was given up, or went wrong."""
        self.after_film = None
        if self.after_save is not None:
            self.after_save = None
            self.go_back()

    def go_back(self) -> None:
        """Leaves the painting as it is, changes and all."""
        otherwise, self.otherwise = self.otherwise, None
        if otherwise is not None:
            otherwise()

    def filmed(self) -> None:
        """Goes on after a film, once."""
        then, self.after_film = self.after_film, None
        if then is not None:
            then()

    def saved(self) -> None:
        """Goes on after a save, once."""
        then, self.after_save, self.otherwise = self.after_save, None, None
        if then is not None:
            then()


def film_wish(film: FilmState, known: Known, here: Bookmark) -> FilmWish:
    """Returns the film as the engine is asked for it."""
    frame = known.frame
    size = film.size or fitted_frame(frame.width, frame.height)
    whole = Bookmark("", 0, (frame.x0, frame.y0), (frame.width, frame.height))
    marks = tuple(known.scene.bookmarks) if known.scene is not None else ()
    places: tuple[Bookmark, ...] = (here if film.close else whole,)
    if film.kind != "replay":
        places = (whole, *marks) if film.marks and marks else (whole, here)
    replay = film.kind != "flight"
    clock = "pen" if film.by_clock else "strokes"
    seconds = float(film.seconds) if film.seconds else None
    return FilmWish(size, places, film.fps, seconds, replay, clock, replay and film.undone, replay and film.brush)


def fitted_frame(width: int, height: int) -> tuple[int, int]:
    """Returns the frame's size, or what of its shape is within 1920 x 1080; even, as films want it."""
    scale = max(width / 1920, height / 1080, 1.0)
    return max(2, int(width / scale) // 2 * 2), max(2, int(height / scale) // 2 * 2)
