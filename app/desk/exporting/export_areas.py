"""What of the painting is exported, and the request for it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from app.desk.desk import Desk
from app.desk.exporting.export_state import EXPORT_FORMATS, FRAME_AREA, PAINTED_AREA
from engine.numeric.address import Rect
from engine.studio.requests import Export

_CHANNELS = 4


class ExportArea(NamedTuple):
    """A row: its `title` and `hint`; `of` gives its level and pixels there, None where there is no such thing, as
    `lacking` tells."""

    title: str
    hint: str
    lacking: str
    of: Callable[[Desk], tuple[int, Rect] | None]


def _frame(desk: Desk) -> tuple[int, Rect]:
    return 0, desk.known.frame


def _view(desk: Desk) -> tuple[int, Rect]:
    level, (x0, y0, x1, y1) = desk.view.shown_level, desk.free_area()
    corners = [desk.view.to_canvas(x, y).pixel(level) for x, y in ((x0, y0), (x1, y0), (x0, y1), (x1, y1))]
    across, down = zip(*corners, strict=True)
    return level, Rect(min(across), min(down), max(across) + 1, max(down) + 1)


def _painted(desk: Desk) -> tuple[int, Rect] | None:
    found = desk.export.painted
    return None if found is None or found.empty else (0, found)


def _selection(desk: Desk) -> tuple[int, Rect] | None:
    ants = desk.selecting.ants
    found = ants.measure if ants is not None and ants.selected and ants.bounded else None
    return None if found is None else (found.level, found.bounds)


AREAS = {
    FRAME_AREA: ExportArea("Frame", "The whole picture", "", _frame),
    "view": ExportArea("View", "What you see of the canvas, at any depth", "", _view),
    PAINTED_AREA: ExportArea("All paint", "What is painted and seen, beyond the frame, too", "No paint yet", _painted),
    "selection": ExportArea(
        "Selection",
        "The rectangle around what is selected",
        "Nothing is selected: draw a rectangle on the canvas with S",
        _selection,
    ),
}


def export_place(desk: Desk) -> tuple[int, Rect]:
    """Returns the level that is exported, and its pixels: of the frame, where what was chosen is not there."""
    found, finer = AREAS[desk.export.area].of(desk), desk.export.finer
    level, rect = _frame(desk) if found is None else found
    return level + finer, rect.zoomed(finer)


def export_bytes(desk: Desk) -> int:
    """Counts the bytes of the picture, which files of it have at most, roughly."""
    return export_place(desk)[1].area * _CHANNELS * EXPORT_FORMATS[desk.export.format].bits // 8


def export_wish(desk: Desk, path: Path) -> Export:
    """Returns the request for a picture that goes to `path`, whose ending decides its kind."""
    state, (level, rect) = desk.export, export_place(desk)
    whole = state.area == FRAME_AREA or AREAS[state.area].of(desk) is None
    depth = EXPORT_FORMATS[state.format].depth
    return Export(path, level, None if whole else rect, state.light, depth, state.transparent, state.apart)
