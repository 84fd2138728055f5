"""What is selected of a layer, lifted: it follows the hand, and nothing is changed until it is set down."""

from __future__ import annotations

from collections.abc import Callable

from app.desk.desk import Desk
from app.desk.moving.laid_level import LaidLevel, laid_level
from app.desk.moving.move_state import TOOL, Floating
from engine.canvas.placing.pose import UNMOVED, Pose, SourcePart
from engine.numeric.similarity import Similarity
from engine.painting.layer_commands import CUT, SetLayer
from engine.painting.layering.placing_members import Placing
from engine.studio.copy_records import CopyPicture
from engine.studio.filing.film_requests import MakeFilm
from engine.studio.moving.move_requests import Extent, Try
from engine.studio.past.past_records import Jump, LookBack
from engine.studio.requests import Begin, Do, Export, Open, Request, Save
from engine.studio.results import LayerRow

_AFTER = Do, Begin, Save, Export, Open, CopyPicture, MakeFilm, Jump, LookBack  # before these it is set down


def takes_part(desk: Desk, row: LayerRow) -> bool:
    """Tells whether only what is selected of a layer is moved: groups and placements have no paint of their own."""
    return desk.selecting.selected and not row.group and row.shows is None and row.wrap is None


def lift(desk: Desk, row: LayerRow, pose: Pose, way: str = "") -> None:
    """Shows what is selected of a layer elsewhere, lifted out of it; `way`: "cut", "copy", or "" for as before."""
    before = desk.moving.floating
    way = way or (CUT if before is None else before.way)
    desk.moving.floating = Floating(row.name, pose, way, desk.known.scene.serial if desk.known.scene else 0)
    desk.post(Try(row.name, Placing.at_pose(pose), selected=way))


def let_go(desk: Desk) -> None:
    """Gives it up: all is as it was before it was lifted."""
    floating, desk.moving.floating = desk.moving.floating, None
    if floating is not None:
        desk.post(Try(floating.name, None))


def laying(desk: Desk) -> LaidLevel | None:
    """Returns of which level it becomes pixels when it is set down; None where it is not sampled, or nothing floats."""
    floating = desk.moving.floating
    return None if floating is None else laid_level(desk.moving.extent, floating.pose, desk.view.shown_level)


def set_part_down(desk: Desk, above: bool = False) -> None:
    """Lays it into its layer, or sampled `above` it, where nothing of it is lost: one command, one step."""
    floating, extent = desk.moving.floating, desk.moving.extent
    if floating is None or (floating.pose == UNMOVED and floating.way == CUT):
        let_go(desk)
        return
    laid = None if above else laying(desk)
    desk.moving.floating = None
    pose, level = floating.pose, None if laid is None else laid.level
    desk.selecting.carried = pose.similarity
    desk.post(Do(SetLayer(floating.name, placing=Placing.at_pose(pose), selected=floating.way, baked=level)))
    if level is not None:
        desk.moving.extent = None  # it is asked for anew
    elif pose.similarity.quarter is None:
        part = None if extent is None else extent.part
        desk.moving.extent = None if part is None else Extent(f"{floating.name} part", part)
        desk.moving.laid_above = floating.name
    elif extent is not None and extent.part is not None:
        level = extent.part.level - pose.levels
        there = SourcePart(level, pose.similarity.shown(extent.part.rect, extent.part.level, level))
        desk.moving.extent = Extent(floating.name, there, True)


def rim_similarity(desk: Desk) -> Similarity | None:
    """Returns by what the rim of what is selected is seen elsewhere; None: where it is."""
    return desk.selecting.carried if desk.moving.floating is None else desk.moving.floating.pose.similarity


def want_rim(desk: Desk) -> None:
    """Asks for what is to be seen of the rim: that of what floats may have been out of sight before."""
    floating = desk.moving.floating
    desk.selecting.wants(desk.post, desk.view, None if floating is None else floating.pose.similarity)


def watch(desk: Desk) -> None:
    """Sets it down when another tool or layer is taken up; another painting has no place for it.  Tells of what lies
    above its layer by now."""
    floating, row = desk.moving.floating, desk.known.active
    if desk.moving.laid_above and row is not None and row.shows is not None:
        name, desk.moving.laid_above = desk.moving.laid_above, ""
        desk.say(f"Turned or scaled by parts, it lies above “{name}”; nothing of it is lost", offer="independent")
    if floating is None:
        return
    if desk.known.scene is not None and desk.known.scene.serial != floating.serial:
        desk.moving.floating = None
    elif desk.hand.tool != TOOL or row is None or row.name != floating.name:
        set_part_down(desk)


def settling(desk: Desk, post: Callable[[Request], None]) -> Callable[[Request], None]:
    """Returns what posts a request, and before any that needs the painting as it is seen, sets down what floats."""

    def posted(request: Request) -> None:
        if desk.moving.floating is not None and isinstance(request, _AFTER):
            set_part_down(desk)
        post(request)

    return posted
