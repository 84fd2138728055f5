"""What lies on the artist's desk: the hand, what is known, what is asked, the view, and what is set in strips.

Panels and actions read and change these; everything that changes pixels goes through `post`.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, NamedTuple

from app.canvas.glide import Glide
from app.canvas.view import Place, View, view_of
from app.desk.adjusting.adjust_state import AdjustState
from app.desk.arranging.kept_arrangement import Arranged
from app.desk.asked import Asked, Then
from app.desk.examples.awaited import Awaited
from app.desk.examples.example_state import Entry, ExampleState
from app.desk.exporting.export_state import ExportState
from app.desk.filling.fill_state import FillState
from app.desk.framing.frame_state import FrameState
from app.desk.guides.guide_state import GuideState
from app.desk.hand import Hand, radius_of
from app.desk.holding.desk_record import KeptDesk
from app.desk.holding.hand_sight import HandSight
from app.desk.holding.pick_state import PickState
from app.desk.keys.key_state import KeyState
from app.desk.known import Known
from app.desk.lab_state import LabState
from app.desk.land.land_state import LandState
from app.desk.lit.light_state import LightState
from app.desk.masks.mask_state import MaskState
from app.desk.match_state import MatchState
from app.desk.moving.move_state import MoveState
from app.desk.notices import Notice, Notices
from app.desk.outside.arrival_state import Arriving
from app.desk.outside.opened_files import OpenedFiles
from app.desk.past.past_state import PastState
from app.desk.places.place_state import PlaceState
from app.desk.preferring.pen_trial import PenTrial
from app.desk.preferring.preferred import Preferred
from app.desk.previews import FileRow
from app.desk.proofing.proof_state import ProofState
from app.desk.recovery.recovery_state import RecoveryState
from app.desk.remembering.remembered import Remembered
from app.desk.remembering.start_state import StartState
from app.desk.selecting.select_state import SelectState
from app.desk.solids.solid_state import SolidState
from app.desk.stack.stack_state import StackState
from app.desk.workshop.workshop_state import WorkshopState
from app.faults.log import fault_words
from engine.brush.settings import Brush
from engine.studio.filing.opening_requests import CancelOpening, Show
from engine.studio.layer_rows import LayerRow
from engine.studio.requests import Open, Request, Save
from engine.studio.results import Note, Opening, Whole

MESSAGE_SECONDS = 6.0


class FileWork:
    """Work with files in two halves, the first on the files’ thread, the second on the window’s: a frozen record."""

    def carry_out(self) -> Any:
        """Reads or writes, and returns what the window is to know, which never changes.  An OSError or one
        of `engine.studio.faults.EXPECTED` where that cannot be."""
        raise NotImplementedError

    def arrive(self, desk: Desk, found: Any) -> None:
        """Puts on the desk what `carry_out` returned."""
        raise NotImplementedError

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells why it was not carried out, one line."""
        desk.say(fault, bad=True)


def _nowhere(_work: FileWork) -> None:
    raise RuntimeError("no thread for files yet")


def _no_thumbnails(_entries: tuple[Entry, ...], _side: int) -> None:
    """Makes none: there is no thread for them yet."""


class Message(NamedTuple):
    """A line in the status line, until a time by the monotonic clock.  `offers`: the actions, rows of
    ACTIONS in app.actions, that do something about it; the line is void when none is to be done any more; `of`: the
    layer of which it tells, as it was then: the line goes once that is another."""

    text: str = ""
    bad: bool = False
    until: float = 0.0
    offers: tuple[str, ...] = ()
    of: LayerRow | None = None


def _no_previews(_folder: Path, _rows: Iterable[FileRow], _side: int) -> None:
    """Makes none: there is no thread for them yet."""


@dataclass(slots=True)
class Pointer:
    """Where the pointer is, what it is over, how hard a pen is `pressed` and what that is felt as, and which keys are
    held that mean something to what it drags."""

    x: float = 0.0
    y: float = 0.0
    over_canvas: bool = False
    pen: bool = False
    eraser: bool = False
    pressed: float = 0.0
    pressure: float = 0.0
    shift: bool = False
    alt: bool = False


@dataclass(slots=True)
class Desk:
    """The window's own state.  Lengths on the screen are framebuffer pixels."""

    view: View
    post: Callable[[Request], None]
    scale: float = 1.0
    work: Callable[[FileWork], None] = _nowhere  # with files, on their own thread
    hand: Hand = field(default_factory=Hand)
    kept: KeptDesk = KeptDesk()  # noqa: RUF009  # it never changes
    picking: PickState = field(default_factory=PickState)
    hand_sight: HandSight = field(default_factory=HandSight)
    known: Known = field(default_factory=Known)
    painting: bool = False
    keys: KeyState = field(default_factory=KeyState)
    panels: bool = True
    arranged: Arranged = field(default_factory=Arranged)
    insets: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)  # left, top, right, bottom taken by panels
    pointer: Pointer = field(default_factory=Pointer)
    trial: PenTrial = field(default_factory=PenTrial)
    glide: Glide = field(default_factory=Glide)
    message: Message = Message()  # noqa: RUF009  # it never changes
    notices: Notices = field(default_factory=Notices)
    graphics: str = ""  # the card and its driver
    start_engine: Callable[[], None] = lambda: None  # again, once a fault has ended its thread
    behind: Callable[[], bool] = lambda: False  # whether requests are still to be carried out
    asked: Asked = field(default_factory=Asked)
    strip: str = ""  # what is open below the canvas: a row of app.panels.strip.STRIPS
    light: LightState = field(default_factory=LightState)
    lab: LabState = field(default_factory=LabState)
    land: LandState = field(default_factory=LandState)
    match: MatchState = field(default_factory=MatchState)
    examples: ExampleState = field(default_factory=ExampleState)
    recovery: RecoveryState = field(default_factory=RecoveryState)
    past: PastState = field(default_factory=PastState)
    filling: FillState = field(default_factory=FillState)
    places: PlaceState = field(default_factory=PlaceState)
    guides: GuideState = field(default_factory=GuideState)
    adjusting: AdjustState = field(default_factory=AdjustState)
    export: ExportState = field(default_factory=ExportState)
    framing: FrameState = field(default_factory=FrameState)
    masks: MaskState = field(default_factory=MaskState)
    stack: StackState = field(default_factory=StackState)
    moving: MoveState = field(default_factory=MoveState)
    selecting: SelectState = field(default_factory=SelectState)
    opened: OpenedFiles = field(default_factory=OpenedFiles)
    preferred: Preferred = field(default_factory=Preferred)
    proofing: ProofState = field(default_factory=ProofState)
    remembered: Remembered = field(default_factory=Remembered)
    start: StartState = field(default_factory=StartState)
    arriving: Arriving = field(default_factory=Arriving)
    solid: SolidState = field(default_factory=SolidState)
    workshop: WorkshopState = field(default_factory=WorkshopState)
    sampled: dict[str, Any] = field(default_factory=dict)  # textures whose pictures were asked for: what they meant
    pictures: dict[str, Any] = field(default_factory=dict)  # swatches by name: imgui texture references
    awaited: Awaited = field(default_factory=Awaited)  # those asked for that have not come
    thumbnails: Callable[[tuple[Entry, ...], int], None] = _no_thumbnails  # asks for those of examples, pixels square
    previews: Callable[[Path, Iterable[FileRow], int], None] = (
        _no_previews  # asks for pictures of files, as Previews.ask
    )

    def learn(self, **known: Any) -> None:
        """Takes over what has become known: other values for members of `known`."""
        self.known = replace(self.known, **known)

    def say(
        self,
        text: str,
        bad: bool = False,
        offer: str = "",
        offers: tuple[str, ...] = (),
        of: LayerRow | None = None,
        seconds: float = MESSAGE_SECONDS,
    ) -> None:
        """Shows a line in the status line for some seconds; with buttons for an action that it may `offer`, or more;
        while the layer that it tells `of` is as it is."""
        until = time.monotonic() + seconds * (2 if bad else 1)
        self.message = Message(text, bad, until, (offer,) if offer else offers, of)

    def told(self, note: Note) -> None:
        """Shows what the engine tells: for some seconds, or until it is dealt with."""
        text = fault_words(note.text) if note.fault else note.text
        if note.stays:
            self.notices.add(Notice(text, note.bad, note.offers, note.about, note.path, note.lines))
            self.message = Message()
        else:
            self.notices.settle(note.about)
            self.say(text, note.bad)
        if note.bad:
            self.arriving = Arriving()
            self.asked.give_up()

    def guard(self, then: Then) -> None:
        """Does `then`, after asking about unsaved changes if there are any, or may be when all is carried out."""
        if self.known.modified or self.behind():
            self.asked.about_changes(then)
        else:
            then()

    def open(self, path: Path, live: bool = False, untitled: bool = False) -> None:
        """Opens a file, which the status line tells until it is there; `live`: a recording is seen as it grows;
        `untitled`: it is not saved there again."""
        self.learn(opening=Opening(path.name))
        self.message = Message()
        self.post(Open(path, live, untitled))

    def stop_opening(self) -> None:
        """Gives up what is being opened."""
        self.learn(opening=None)
        self.post(CancelOpening())

    def show(self, whole: Whole) -> None:
        """Lets a file that is read take the painting's place; asks before, if that was changed meanwhile."""
        if whole.changed:
            sure = Show(whole.file, sure=True)
            self.asked.about_changes(lambda: self.post(sure), self.stop_opening, f"{whole.name} takes its place.")
        else:
            self.post(Show(whole.file))

    def save(self, to: Path | None = None, sure: bool = False) -> None:
        """Saves somewhere, `sure`: whatever is there; else where the painting came from; asks where, the first time."""
        path = self.known.path if to is None else to
        if path is not None and (to is not None or path.suffix.lower() == ".ora"):
            self.post(Save(path, sure, self.guides.kept_in(self.known.scene)))
        else:
            self.asked.show("save as")

    def free_area(self) -> tuple[float, float, float, float]:
        """Returns the part of the screen that no panel covers."""
        left, top, right, bottom = self.insets
        return left, top, self.view.width - right, self.view.height - bottom

    def middle(self) -> tuple[float, float]:
        """Gives the middle of what no panel covers, framebuffer pixels."""
        x0, y0, x1, y1 = self.free_area()
        return (x0 + x1) / 2, (y0 + y1) / 2

    def fit(self) -> None:
        """Shows the whole frame."""
        self.glide.stop()
        self.view = view_of(self.known.frame, self.free_area(), self.view.width, self.view.height)

    def look_at(self, place: Place, zoom: float, seconds: float = 0.0) -> None:
        """Brings a place into the middle at a real zoom level, in some seconds."""
        level = int(zoom // 1)
        there = replace(self.view, level=level, fraction=zoom - level).held(place, *self.middle())
        self.view = self.glide.fly(self.view, there, seconds)

    def stroke_brush(self, eraser: bool) -> tuple[int, Brush]:
        """Returns the level of a stroke begun now, and the brush with its radius in pixels of that level."""
        level = self.view.shown_level
        held, mode = replace(self.hand.dipped(), radius=radius_of(self.hand, eraser)), self.hand.stroke_mode(eraser)
        brush = replace(held.magnified(1.0 / self.view.scale(level)), mode=mode.name)
        return level, self.examples.erasing(brush) if mode.takes_away else brush


Hear = Callable[[Desk, Any, float], None]  # takes a result of the engine, and when it came
