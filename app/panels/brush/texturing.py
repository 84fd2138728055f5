"""The sections of the brush panel in which textures thin the paint: dry brush, paper, edge, tip.

Each is a switch: what was set is remembered while it is off.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any, TypeVar

from imgui_bundle import imgui
from immutables import Map

from app.desk.colours import to_hex
from app.desk.desk import Desk
from app.desk.hand import mixed_now
from app.desk.holding import dipping
from app.desk.lab_state import lightened
from app.language import said
from app.panels.controls import texture_choice, texture_rows
from app.panels.controls import widgets as w
from app.panels.controls.colour_popup import colour_popup
from app.panels.controls.curve_editor import CurveEditor
from app.panels.controls.kept_switch import kept_switch
from engine.brush.parts import Edge, Surface, Tip

P = TypeVar("P", Surface, Tip)

SCALES = (-6, 6)  # levels of a grain that the slider offers
_PAPER = "Cold-pressed paper"  # that a brush gets first
_START: dict[str, Any] = {
    "density": Surface("rock", 0.9, "threshold", parameters=Map({"period": 18.0, "roughness": 0.3})),
    "grain": Surface("rock", 0.8, parameters=Map({"period": 6.0, "roughness": 0.6})),
    "edge": Edge("wet", 0.5),
    "tip": Tip("rock", "window", parameters=Map({"period": 24.0})),
}


class Texturing:
    """Draws the four sections."""

    def __init__(self) -> None:
        self._curves = CurveEditor()
        self._kept = dict(_START)
        self._fresh = ""  # the section switched on just now

    def draw(self, desk: Desk) -> None:
        """Draws them into the present window; those that do not count for the mode are there, but do nothing."""
        for name, title, hint, body in _SECTIONS:
            unfelt, held = name in desk.hand.stroke_mode().unfelt, getattr(mixed_now(desk.hand), name)
            imgui.begin_disabled(unfelt)
            shown, on = w.switched_section(title, hint, held is not None and not unfelt, enabled=not unfelt)
            imgui.end_disabled()
            if unfelt:
                continue
            if on != (held is not None):
                desk.hand.paper_stays = desk.hand.paper_stays and name != "grain"
                held, self._fresh = (self._start(desk, name), name) if on else (None, "")
                if on and name == "grain":
                    desk.hand.take(lightened(desk.hand.brush, desk.pointer.pen))
            if shown:
                imgui.push_id(name)
                imgui.begin_disabled(not on)
                changed = body(self, desk, held if held is not None else self._kept[name])
                imgui.end_disabled()
                imgui.pop_id()
                held = changed if on else None
                self._show(name)
            if held is not None:
                self._kept[name] = held
            if held != getattr(mixed_now(desk.hand), name):
                _set(desk, name, held)

    def _show(self, name: str) -> None:
        """Scrolls to the end of a section that was switched on just now."""
        if name == self._fresh:
            self._fresh = ""
            if imgui.get_cursor_screen_pos().y > imgui.get_window_pos().y + imgui.get_window_height():
                imgui.set_scroll_here_y(1.0)

    def _start(self, desk: Desk, name: str) -> Any:
        """Returns what it was before, unless that needs a texture of another painting."""
        held = self._kept[name]
        first = next((paper for paper in desk.known.papers if paper.name == _PAPER), None)
        if held is _START["grain"] and first is not None:
            texture_rows.bring(desk, first.grain.texture)
            return first.grain
        known = {texture for texture, _ in texture_rows.names(desk)}
        return held if getattr(held, "texture", None) in known | {None} else _START[name]

    def _density(self, desk: Desk, part: Surface) -> Surface:
        hint = "How much the texture thins the paint"
        return self._shaped(desk, _amount(_texture(desk, part), hint))

    def _grain(self, desk: Desk, part: Surface) -> Surface:
        part = texture_choice.surface(desk, part, "Papers, and any other texture")
        _, desk.hand.paper_stays = said.checkbox("For every brush", desk.hand.paper_stays)
        w.tooltip("The paper stays when you take another brush")
        part = _amount(part, "How deep the grain is: light touches reach its peaks alone")
        hint = "The level in whose pixels the grain is measured; higher is finer. It stays on the canvas as you zoom"
        changed, level = w.slider("Scale", float(part.level), SCALES, hint, form="level %.0f")
        if changed:
            part = replace(part, level=round(level))
        return self._shaped(desk, part)

    def _shaped(self, desk: Desk, part: P) -> P:
        parameters = texture_rows.sliders(desk, part.texture, part.parameters)
        if parameters != part.parameters:
            part = replace(part, parameters=parameters)
        hint = "A curve that the texture's values go through"
        changed, curve = self._curves.row("Shaping", part.shaping, desk.known.tables.curves, hint)
        return replace(part, shaping=curve) if changed else part

    def _edge(self, desk: Desk, part: Edge) -> Edge:
        hint = "Left: at the rim of the stroke; right: a width inside it. Up: more paint"
        changed, curve = self._curves.row("Curve", part.curve, desk.known.tables.edges, hint)
        if changed:
            part = replace(part, curve=curve if curve is not None else desk.known.tables.edges[0].name)
        rows = (
            ("width", "Width", "How far it reaches inwards, in per cent of the radius", 200.0),
            ("amount", "Amount", "How much of it", 100.0),
        )
        for name, title, hint, most in rows:
            changed, value = w.slider(title, getattr(part, name) * 100, (0.0, most), hint, form="%.0f%%")
            if changed:
                setting: dict[str, Any] = {name: round(value / 100, 3)}
                part = replace(part, **setting)
        return _tint(desk, part)

    def _tip(self, desk: Desk, part: Tip) -> Tip:
        part = _texture(desk, part)
        options = [("sample", "The sample itself"), ("window", "Another piece each time")]
        hints = ["Every dab stamps the texture's own picture", "Every dab stamps another piece of the texture"]
        source = w.choice("from", part.source, options, "What each dab stamps", -1, hints)
        if source:
            part = replace(part, source=source)
        return self._shaped(desk, part)


_SECTIONS: tuple[tuple[str, str, str, Callable[[Texturing, Desk, Any], Any]], ...] = (
    ("density", "Dry brush", "A texture thins the paint: bristles, gaps", Texturing._density),
    ("grain", "Paper", "The grain of what is painted on; light touches reach its peaks alone", Texturing._grain),
    ("edge", "Edge", "What happens along the rim of a stroke: wet, dark, worn", Texturing._edge),
    ("tip", "Tip", "Each dab is a piece of a texture", Texturing._tip),
)


def _set(desk: Desk, name: str, part: Surface | Edge | Tip | None) -> None:
    if isinstance(part, Edge):
        desk.hand.take(dipping.with_rim(desk.hand.brush, to_hex(desk.hand.colour), part))
    else:
        setting: dict[str, Any] = {name: part}
        desk.hand.change(**setting)


def _texture(desk: Desk, part: Any) -> Any:
    chosen = texture_choice.chooser(desk, part.texture, "The texture")
    return replace(part, texture=chosen, parameters=Map()) if chosen and chosen != part.texture else part


def _amount(part: Surface, hint: str) -> Surface:
    changed, value = w.slider("Amount", part.amount * 100, (0.0, 100.0), hint, form="%.0f%%")
    return replace(part, amount=round(value / 100, 4)) if changed else part


def _tint(desk: Desk, part: Edge) -> Edge:
    """Returns the colour at the rim, if it has one of its own."""
    side = imgui.get_frame_height()
    on = part.colour is not None
    changed, on = said.checkbox("Tint", on)
    w.tooltip("The paint turns to another colour at the rim")
    if changed:
        part = replace(part, colour=to_hex(tuple(v * 0.5 for v in desk.hand.colour)) if on else None)  # type: ignore[arg-type]
    if part.colour is not None:
        imgui.same_line()
        if w.swatch("tint", part.rgb, "The colour at the rim", (side * 2, side)):
            imgui.open_popup("tint colour")
        rgb = colour_popup("tint colour", part.rgb)
        if rgb is not None:
            part = replace(part, colour=to_hex(rgb))
        imgui.same_line()
        part = dipping.fix_rim(part, kept_switch(dipping.is_fixed(part)))
    return part
