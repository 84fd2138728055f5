"""The shape of the brush's tip: how slender, how turned, what it follows, and how dabs are strewn."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from imgui_bundle import imgui

from app.desk.desk import Desk
from app.panels.controls import widgets as w
from engine.brush.tip_shape import MOST_BRISTLES, MOST_COUNT, TipShape

_FOLLOWS = (("none", "Fixed"), ("direction", "The stroke"), ("pen", "The pen"))
_HINTS = (
    "The tip keeps its angle, as a broad nib does",
    "The tip turns with the stroke",
    "The tip turns with the pen's barrel, or to where the pen leans",
)
_MOST_SCATTER = 4.0  # radii that the slider offers


def draw(desk: Desk) -> None:
    """Draws it into the present window."""
    shape = desk.hand.brush.shape
    part = _slid(shape, "ratio", "Roundness", shape.ratio * 100, (2.0, 100.0), "%.0f%%", _ROUNDNESS)
    part = replace(part, ratio=round(part.ratio / 100, 4)) if part is not shape else shape
    turned = _slid(part, "angle", "Angle", part.angle, (-180.0, 180.0), "%.0f°", "How the tip is turned, clockwise")
    part = replace(turned, angle=float(round(turned.angle)))
    width = imgui.get_content_region_avail().x
    picked = w.choice("follow", part.follow, _FOLLOWS, "What the tip turns with", width, _HINTS)
    part = replace(part, follow=picked) if picked else part
    strewn = _slid(part, "scatter", "Scatter", part.scatter * 100, (0.0, _MOST_SCATTER * 100), "%.0f%%", _SCATTER)
    part = replace(strewn, scatter=round(strewn.scatter / 100, 3)) if strewn is not part else part
    many = _slid(part, "count", "Count", part.count, (1.0, float(MOST_COUNT)), "%.0f", "How many dabs at each place")
    part = replace(many, count=round(many.count))
    haired = _slid(part, "bristles", "Bristles", part.bristles, (0.0, float(MOST_BRISTLES)), "%.0f", _BRISTLES)
    part = replace(haired, bristles=round(haired.bristles))
    if part != shape:
        desk.hand.change(shape=part)


_ROUNDNESS = "How broad the tip is for its length: a broad nib has 15%"
_BRISTLES = "Hairs of the tip, each with its own load of paint; 0 is a whole tip. Less opacity leaves fewer of them wet"
_SCATTER = "How far dabs lie aside, in per cent of the radius"


def _slid(
    shape: TipShape, name: str, label: str, value: float, bounds: tuple[float, float], form: str, hint: str
) -> TipShape:
    """Returns the shape with what a slider shows; the shape itself where that was not moved."""
    changed, value = w.slider(label, value, bounds, hint, form=form)
    setting: dict[str, Any] = {name: value}
    return replace(shape, **setting) if changed else shape
