"""What is moved is set down: one command, one step; its box is there before the engine answers."""

from __future__ import annotations

from app.desk.desk import Desk
from app.desk.moving import floating, held_box
from app.desk.moving.move_state import Trial
from app.desk.naming import free_name
from engine.canvas.placing.pose import Pose, SourcePart
from engine.painting.layer_commands import DuplicateLayer, SetLayer
from engine.painting.layering.placing_members import Placing
from engine.studio.moving.move_requests import Extent
from engine.studio.requests import Do
from engine.studio.results import LayerRow


def set_down(desk: Desk, row: LayerRow, pose: Pose) -> None:
    """Moves a layer, group or placement to a pose; what is selected of a layer floats there."""
    if floating.takes_part(desk, row):
        floating.lift(desk, row, pose)
        return
    desk.post(Do(SetLayer(row.name, placing=Placing.at_pose(pose))))
    held = held_box.part(desk, row)
    if held is not None and row.shows is None and not row.group and pose.similarity.quarter is not None:
        desk.moving.trial = None  # it stays a layer, elsewhere
        level = held.level - pose.levels
        there = SourcePart(level, pose.similarity.shown(held.rect, held.level, level))
        desk.moving.extent = Extent(row.name, there)
    else:
        desk.moving.trial = Trial(desk.known.scene, row.name, pose)


def set_copy_down(desk: Desk, row: LayerRow, pose: Pose) -> None:
    """Lays a copy of a layer or group at a pose; of a placement, another one of the same source."""
    taken = {one.name for one in desk.known.scene.layers} if desk.known.scene else set()
    name = free_name(f"{row.name} copy", taken)
    desk.post(Do(DuplicateLayer(row.name, name, Placing.at_pose(pose))))
    desk.moving.trial = None
