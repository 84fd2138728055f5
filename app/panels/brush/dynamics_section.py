"""What a brush follows: for each setting its curve of pressure, and one for everything else that it was given."""

from __future__ import annotations

from typing import Any

from imgui_bundle import imgui

from app import icons
from app.desk.desk import Desk
from app.desk.knots import STRAIGHT, at
from app.panels.brush.felt_curves import FALLING, OneCurve, by_input, span_of, spread, unit_knots, with_curve
from app.panels.controls import widgets as w
from app.panels.controls.curve_editor import CurveEditor
from engine.brush.inputs import INPUTS, Input
from engine.brush.settings import Brush
from engine.brush.targets import FOLLOWERS, Target
from engine.studio.results import CurveRow

_PRESSURES: dict[str, Any] = {
    "pressure": "pressure",
    "soft": ((0.0, 0.15), (0.35, 0.6), (1.0, 1.0)),
    "firm": ((0.0, 0.0), (0.6, 0.25), (1.0, 1.0)),
}
_PRESSURE_ROWS = (
    CurveRow("even", "Even", "The same whatever the pressure", (1.0, 1.0)),
    CurveRow("pressure", "Pressure", "In proportion to the pressure", (0.0, 1.0)),
    CurveRow(
        "soft", "Soft pen", "Light touches count for more", tuple(at(_PRESSURES["soft"], i / 20) for i in range(21))
    ),
    CurveRow(
        "firm", "Firm pen", "Light touches count for less", tuple(at(_PRESSURES["firm"], i / 20) for i in range(21))
    ),
)
_RISING, _FALLING = "rising", "falling"
_ROWS = (
    CurveRow(_RISING, "Rising", "More of it, more of the setting", (0.0, 1.0)),
    CurveRow(_FALLING, "Falling", "More of it, less of the setting", (1.0, 0.0)),
)
_SHORTEST, _LONGEST = 5.0, 10000.0  # spans that the slider offers


class DynamicsSection:
    """Draws a row for each setting, and below it one for each input besides pressure."""

    def __init__(self) -> None:
        self._curves = CurveEditor()

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        for name, row in FOLLOWERS.items():
            if _applies(desk.hand.brush, name):
                imgui.push_id(name)
                self._target(desk, name, row)
                imgui.pop_id()

    def _target(self, desk: Desk, name: str, row: Target) -> None:
        curves = by_input(desk.hand.brush.dynamics.get(name))
        side, gap = imgui.get_frame_height(), 3 * desk.scale
        hint = f"How the pen's pressure changes the {row.label.lower()}: left a light touch, right a firm one"
        changed, drawn = self._curves.row(row.label, _named(curves.get("pressure")), _PRESSURE_ROWS, hint, side + gap)
        if changed:
            given = _PRESSURES.get(drawn, drawn) if isinstance(drawn, str) else drawn
            _change(desk, name, "pressure", given)
        imgui.same_line(0, gap)
        free = [one for key, one in INPUTS.items() if key not in curves and key != "pressure"]
        if w.icon_button(f"follow {name}", icons.ADD, "Follow tilt, speed, chance…", enabled=bool(free)):
            imgui.open_popup("inputs")
        _choose(desk, name, free)
        for one, curve in curves.items():
            if one != "pressure":
                self._input(desk, row, INPUTS[one], curve)

    def _input(self, desk: Desk, target: Target, row: Input, curve: OneCurve) -> None:
        side, gap, inset = imgui.get_frame_height(), 3 * desk.scale, imgui.get_font_size()
        span = span_of(row.name, curve)
        imgui.indent(inset)
        hint = f"{row.tooltip}. {_across(row, span)}; up more {target.label.lower()}"
        shown = unit_knots(row.name, curve)
        named = {STRAIGHT: None, FALLING: _FALLING}.get(shown, shown) if isinstance(shown, tuple) else shown
        label = f"{row.label}##{target.name} {row.name}"
        changed, drawn = self._curves.row(label, named, _ROWS, hint, side + gap)
        if changed:
            knots = STRAIGHT if drawn is None or drawn == _RISING else FALLING if isinstance(drawn, str) else drawn
            _change(desk, target.name, row.name, spread(row.name, knots, span))
        imgui.same_line(0, gap)
        if w.icon_button(f"forget {target.name} {row.name}", icons.CLOSE, f"No longer by {row.label.lower()}"):
            _change(desk, target.name, row.name, None)
        elif row.open_ended:
            self._span(desk, target, row, curve)
        imgui.unindent(inset)

    def _span(self, desk: Desk, target: Target, row: Input, curve: OneCurve) -> None:
        bounds, hint = (_SHORTEST, _LONGEST), "Where the curve ends: from there on it stays as it is"
        label, form = f"Up to##{target.name} {row.name}", f"%.0f {row.unit}"
        changed, value = w.slider(label, span_of(row.name, curve), bounds, hint, form=form, curved=True)
        if changed:
            _change(desk, target.name, row.name, spread(row.name, unit_knots(row.name, curve), max(1.0, round(value))))


def _choose(desk: Desk, target: str, free: list[Input]) -> None:
    """Draws the list of what a setting does not follow yet."""
    if not imgui.begin_popup("inputs"):
        return
    for row in free:
        if imgui.menu_item(row.label, "", False)[0]:
            _change(desk, target, row.name, spread(row.name, STRAIGHT, row.span))
        w.named(f"by {row.label.lower()}")
        w.tooltip(row.tooltip)
    imgui.end_popup()


def _change(desk: Desk, target: str, name: str, curve: OneCurve | None) -> None:
    desk.hand.change(dynamics=with_curve(desk.hand.brush.dynamics, target, name, curve))


def _applies(brush: Brush, target: str) -> bool:
    """Tells whether a setting counts for a brush: those of its tip only where that has them."""
    shape = brush.shape
    if target == "scatter":
        return shape.scatter > 0.0 or target in brush.dynamics
    if target in ("angle", "ratio"):
        return shape.ratio < 1.0 or shape.bristles > 0 or brush.tip is not None or target in brush.dynamics
    return True


def _named(curve: OneCurve | None) -> OneCurve | None:
    """Returns a curve of pressure as the editor knows it: by its name if it has one."""
    if curve == STRAIGHT:
        return "pressure"
    return next((name for name, knots in _PRESSURES.items() if curve is not None and knots == curve), curve)


def _across(row: Input, span: float) -> str:
    return f"Left 0, right {span:g}{'' if row.unit in ('', '°') else ' '}{row.unit}"
