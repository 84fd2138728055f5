"""Fills as the window asks for them: with the brush in hand, of a region or of what is selected."""

from __future__ import annotations

from dataclasses import replace

from app.desk import palette
from app.desk.desk import Desk
from app.desk.examples import example_use
from app.desk.filling.fill_state import all_in
from app.desk.guides.tile_seams import tell_seams
from engine.brush.settings import Brush
from engine.painting.commands import SetLayer
from engine.painting.fill_command import Fill, Like, place_of
from engine.painting.layering.mask_member import MASK_EMPTY, MaskOp
from engine.studio.requests import Do


def may_fill(desk: Desk) -> bool:
    """Tells whether the layer can be filled, and says why if not, or if the fill will not show."""
    layer = desk.known.active
    if layer is not None and layer.locked:
        desk.say(f"Layer “{layer.name}” is locked", bad=True)
        return False
    if layer is not None and layer.shows is not None and not desk.masks.on(layer):
        desk.say(f"“{layer.name}” shows “{layer.shows.name or 'the painting'}”: fill that", bad=True)
        return False
    if desk.known.hiding:
        desk.say(f"“{desk.known.hiding[-1]}” is hidden: what you fill does not show", bad=True, offer="show_layer")
    return True


def pour(desk: Desk, like: Like | None, eraser: bool = False) -> None:
    """Fills a region, or what is selected, with the brush in hand; `eraser`: as the pen's other end does."""
    example_use.fit_within_reach(desk)
    palette.provide(desk)
    level, brush = desk.stroke_brush(eraser)
    if like is None:
        post_fill(desk, Fill(brush, level=level))
    else:
        post_fill(desk, Fill(brush, like, outruns(desk, like), grow=grown_by(desk, like)))
    if brush.row.lays_ink:
        desk.hand.remember()


def grown_by(desk: Desk, like: Like) -> float:
    """Returns by how many pixels of its level a region is filled beyond its rim, as the panel says: a line's own does
    not grow."""
    return 0.0 if like.regions == "line" else round(desk.filling.fill_grown / desk.view.scale(like.level), 2)


def outruns(desk: Desk, like: Like) -> bool:
    """Tells whether a region may reach the border of where it is looked for: as what is alike anywhere does, and where
    a selection bounds the fill."""
    return not like.contiguous or _bounded(desk)


def _bounded(desk: Desk) -> bool:
    return desk.selecting.ants is not None and desk.selecting.ants.bounded


def post_fill(desk: Desk, fill: Fill) -> None:
    """Asks for a fill, which is remembered: it may be asked for again, wherever its region ends."""
    row = desk.known.active
    fill = replace(fill, onto=desk.masks.onto(row))
    if row is not None and row.wrap is not None:
        tell_seams(desk, row.wrap, place_of(fill)[0], fill.brush)
    desk.filling.last = fill
    desk.notices.settle("fill")
    desk.post(Do(fill))


def clear_mask(desk: Desk) -> None:
    """Hides what is selected on the mask that is painted on, or all where nothing is."""
    row, level = desk.known.active, desk.view.shown_level
    if row is None:
        return
    if not desk.selecting.selected:
        desk.post(Do(SetLayer(row.name, mask=MaskOp(MASK_EMPTY))))
        return
    like = None if _bounded(desk) else all_in(desk.view.visible(level), level)
    post_fill(desk, Fill(Brush(colour="#000000"), like, open=like is not None, level=level if like is None else 0))


def fill_selection(desk: Desk) -> None:
    """Fills what is selected; of a selection without bounds, what is in sight of it."""
    if not may_fill(desk):
        return
    level = desk.view.shown_level
    pour(desk, None if _bounded(desk) else all_in(desk.view.visible(level), level))
