"""What is known of the layer, group or placement that the tool Move holds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

from app.desk.known import Known
from app.desk.moving.sheet_state import SheetState
from engine.canvas.placing.pose import UNMOVED, Pose
from engine.studio.moving.move_requests import AskExtent, Extent, Try
from engine.studio.requests import Request
from engine.studio.results import LayerRow, Scene

TOOL = "move"


class Trial(NamedTuple):
    """Where something is seen meanwhile: until the painting is another one than that of a scene."""

    scene: Scene | None
    name: str
    pose: Pose


class Floating(NamedTuple):
    """What is selected of a layer, lifted: of the layer of that name, in the painting of the number `serial`; `way`:
    "cut" out of it, or as a "copy"."""

    name: str
    pose: Pose
    way: str
    serial: int


class Label(NamedTuple):
    """What is told beside the pointer during a drag; `exact`: it shows the very pixels so."""

    text: str
    exact: bool


@dataclass(slots=True)
class MoveState:
    """`extent`: how far it reaches; `trial`: where it is seen while it is dragged; `floating`: a part of a layer,
    lifted and not set down yet; `label`: what is told of a drag; `grip`: what of its box the pointer is over, or holds;
    `laid_above`: the layer that a part was taken out of, until it is seen above; `waits`: what is done as soon as it is
    known how far it reaches; `sheets`: of which the window makes the picture while it is dragged."""

    extent: Extent | None = None
    trial: Trial | None = None
    floating: Floating | None = None
    label: Label | None = None
    grip: str = ""
    laid_above: str = ""
    waits: Callable[[], None] | None = None
    sheets: SheetState = field(default_factory=SheetState)
    _told: Scene | None = None  # the one that `extent` is of
    _asked: tuple[str, int, bool, Scene | None] | None = None

    def pose(self, known: Known, row: LayerRow) -> Pose:
        """Returns where it is seen: a layer or group that is not dragged is where it is."""
        trial, floating = self.trial, self.floating
        if floating is not None and floating.name == row.name:
            return floating.pose
        if trial is not None and trial.scene is known.scene and trial.name == row.name:
            return trial.pose
        return UNMOVED if row.shows is None else row.shows.pose

    def wants(self, post: Callable[[Request], None], known: Known, level: int, selected: bool = False) -> None:
        """Posts a question how far the chosen one reaches, or what is `selected` of it, at the level that is seen, if
        that may be another answer."""
        row = known.active
        if row is None or self.floating is not None:
            return
        if row.shows is not None:
            level += row.shows.pose.similarity.like_levels
        asked, before = (row.name, level, selected, known.scene), self._asked
        # Two scenes may tell the same while other paint lies there: it is the very one that counts.
        if before is None or asked[:3] != before[:3] or asked[3] is not before[3]:
            self._asked = asked
            post(AskExtent(row.name, level, selected))

    def told(self, extent: Extent) -> None:
        """Takes the answer, and does what waits for it."""
        self.extent = extent
        self._told = None if self._asked is None else self._asked[3]
        waits, self.waits = self.waits, None
        if waits is not None:
            waits()

    def answered(self, post: Callable[[Request], None], known: Known) -> None:
        """All that was asked for is done or was refused: what was set down and is not there is seen where it is."""
        trial = self.trial
        if trial is not None and self.label is None:
            self.trial = None
            if trial.scene is known.scene:
                post(Try(trial.name, None))

    def empty(self, known: Known, row: LayerRow, selected: bool) -> bool:
        """Tells whether it is known that nothing is painted on it now, or of what is `selected`."""
        extent = self.extent
        if extent is None or self._told is not known.scene:
            return False
        return (extent.name, extent.selected, extent.part) == (row.name, selected, None)

    def sure(self, known: Known, do: Callable[[], None]) -> None:
        """Does something for which it must be known how far the chosen one reaches now: at once, or when it is."""
        if self._told is known.scene and self.extent is not None:
            do()
        else:
            self.waits = do
