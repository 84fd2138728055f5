"""The strokes that show at a place, as a list: picture, brush, when, and what can be done with each."""

from __future__ import annotations

from dataclasses import replace
from datetime import datetime

from imgui_bundle import ImVec2, imgui

from app import icons
from app.desk.colours import from_hex
from app.desk.desk import Desk
from app.desk.hand import LARGEST, SMALLEST, go_on_with_brush
from app.desk.past.past_state import PastState, brush_name, when
from app.language import said
from app.language.words import say
from app.panels.controls import widgets as w
from app.panels.controls.fitting import ended
from app.panels.past import step_card
from app.panels.past.step_card import Look
from engine.studio.past.past_records import HereStroke

_LOOKING = f"{icons.WAIT} looking…"


class HereList:
    """Draws the list.  `pictures`: the indices of the steps in sight."""

    def __init__(self) -> None:
        self.pictures: list[int] = []

    def draw(self, desk: Desk) -> None:
        """Draws into the present window."""
        self.pictures = []
        found = desk.past.here
        if found is None or not found.strokes:
            imgui.spacing()
            said.text_disabled(_instead(desk.past))
            return
        imgui.begin_child("strokes", ImVec2(0, 0))
        tall = step_card.size(desk.scale, 0)[1] + imgui.get_style().item_spacing.y
        clipper = imgui.ListClipper()
        clipper.begin(len(found.strokes), tall)
        while clipper.step():
            for n in range(clipper.display_start, clipper.display_end):
                self._row(desk, n, found.strokes[n])
        if found.more:
            said.text_disabled(_LOOKING)
        imgui.end_child()

    def _row(self, desk: Desk, n: int, stroke: HereStroke) -> None:
        step, brush = stroke.step, stroke.step.brush
        assert brush is not None
        self.pictures.append(step.index)
        seen = step.number == desk.past.looking
        imgui.push_id(n)
        if step_card.draw(
            f"stroke {n}", desk.pictures.get(step.picture), (), Look(seen=seen), "Look at this step alone"
        ):
            desk.past.look(desk.post, step.number)
        imgui.same_line()
        imgui.begin_group()
        name = brush_name(brush, desk.known.presets)
        said.text_unformatted(name)
        w.named(f"brush {n}: {name}")
        about = _about(stroke)
        said.text_disabled(ended(say(about), imgui.get_content_region_avail().x))
        w.tooltip(about)
        if w.text_button(f"Use this brush##{n}", "Take the brush, with its size and colour"):
            use_brush(desk, stroke)
        imgui.same_line()
        if w.text_button(f"What came before##{n}", "See the painting as it was before this stroke; nothing is lost"):
            desk.past.look(desk.post, step.number - 1)
        imgui.same_line()
        w.swatch(f"colour {n}", from_hex(brush.colour), brush.colour, (imgui.get_frame_height(),) * 2)
        imgui.end_group()
        imgui.pop_id()


def _instead(past: PastState) -> str:
    """Returns what stands where there are no strokes."""
    if past.here is None:
        return "Click a place on the canvas" if past.asking else _LOOKING
    return _LOOKING if past.here.more else "No stroke shows there, or it is not known which"


def _about(stroke: HereStroke) -> str:
    """Returns a line about a stroke: when, how much of it shows, where, with which textures."""
    step = stroke.step
    told = [f"step {step.number}", when(step.time, datetime.now()), f"{stroke.share:.0%} shows", f"level {step.level}"]
    told += [f"on {stroke.layer}", ", ".join(stroke.textures), f"seed {stroke.seed}" if stroke.textures else ""]
    return "  ·  ".join(part for part in told if part)


def use_brush(desk: Desk, stroke: HereStroke) -> None:
    """Takes the brush of a stroke in hand, as large on the canvas as it was, with its colour."""
    brush = stroke.step.brush
    assert brush is not None
    radius = min(max(brush.radius * desk.view.scale(stroke.step.level), SMALLEST), LARGEST)
    go_on_with_brush(desk.hand)
    desk.hand.take(replace(brush, radius=round(radius, 2)), brush_name(brush, desk.known.presets), ())
    if brush.row.lays_ink:
        desk.hand.colour = from_hex(brush.colour)
    desk.say(f"Brush: {desk.hand.preset}")
