"""What a brush follows: for each setting its curve of pressure, and one for everything else that it was given."""

from __future__ import annotations

from imgui_bundle import imgui

from app import icons
from app.desk.desk import Desk
from app.desk.knots import STRAIGHT, at
from app.language import said
from app.panels.brush.felt_curves import (
    FALLING,
    OneCurve,
    by_input,
    heights_of,
    raised,
    span_of,
    spread,
    unit_heights,
    unit_knots,
    with_curve,
)
from app.panels.controls import widgets as w
from app.panels.controls.curve_editor import CurveEditor
from engine.brush.inputs import INPUTS, Input
from engine.brush.settings import Brush
from engine.brush.targets import COLOUR_TARGETS, FOLLOWERS, Target
from engine.studio.results import CurveRow

_SOFT, _FIRM = ((0.0, 0.15), (0.35, 0.6), (1.0, 1.0)), ((0.0, 0.0), (0.6, 0.25), (1.0, 1.0))
_PRESSURES: dict[str, OneCurve] = {
    "pressure": "pressure",
    "soft": _SOFT,
    "firm": _FIRM,
}
_PRESSURE_ROWS = (
    CurveRow("even", "Even", "The same whatever the pressure", (1.0, 1.0)),
    CurveRow("pressure", "Pressure", "In proportion to the pressure", (0.0, 1.0)),
    CurveRow("soft", "Soft pen", "Light touches count for more", tuple(at(_SOFT, i / 20) for i in range(21))),
    CurveRow("firm", "Firm pen", "Light touches count for less", tuple(at(_FIRM, i / 20) for i in range(21))),
)
_RISING, _FALLING = "rising", "falling"
_ROWS = (
    CurveRow(_RISING, "Rising", "More of it, more of the setting", (0.0, 1.0)),
    CurveRow(_FALLING, "Falling", "More of it, less of the setting", (1.0, 0.0)),
)
_LEVEL_ROWS = (CurveRow("even", "Even", "The same whatever the pressure", (0.5, 0.5)), *_ROWS)
_CURVES: dict[str, OneCurve] = {**_PRESSURES, _RISING: STRAIGHT, _FALLING: FALLING}
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
        felt = curves.get("pressure")
        heights = heights_of(row, felt)
        rows = _PRESSURE_ROWS if heights == (0.0, 1.0) and not row.turns else _LEVEL_ROWS
        shown = None if felt is None else _named(unit_heights(felt, heights), rows)
        changed, drawn = self._curves.row(row.label, shown, rows, hint, side + gap)
        if changed:
            _change(desk, name, "pressure", raised(_given(drawn), heights))
        imgui.same_line(0, gap)
        free = [one for key, one in INPUTS.items() if key not in curves and key != "pressure"]
        if w.icon_button(f"follow {name}", icons.ADD, "Follow tilt, speed, chance…", enabled=bool(free)):
            imgui.open_popup("inputs")
        _choose(desk, row, free)
        for one, curve in curves.items():
            if one != "pressure":
                self._input(desk, row, INPUTS[one], curve)

    def _input(self, desk: Desk, target: Target, row: Input, curve: OneCurve) -> None:
        side, gap, inset = imgui.get_frame_height(), 3 * desk.scale, imgui.get_font_size()
        span, heights = span_of(row.name, curve), heights_of(target, curve)
        imgui.indent(inset)
        hint = f"{row.tooltip}. {_across(row, span)}; up more {target.label.lower()}"
        shown = _named(unit_heights(unit_knots(row.name, curve), heights), _ROWS)
        label = f"{row.label}##{target.name} {row.name}"
        changed, drawn = self._curves.row(label, None if shown == _RISING else shown, _ROWS, hint, side + gap)
        if changed:
            knots = raised(_given(drawn or _RISING), heights)
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


def _choose(desk: Desk, target: Target, free: list[Input]) -> None:
    """Draws the list of what a setting does not follow yet."""
    if not imgui.begin_popup("inputs"):
        return
    for row in free:
        if said.menu_item(row.label, "", False)[0]:
            straight = raised(STRAIGHT, heights_of(target, None))
            _change(desk, target.name, row.name, spread(row.name, straight, row.span))
        w.named(f"by {row.label.lower()}")
        w.tooltip(row.tooltip)
    imgui.end_popup()


def _change(desk: Desk, target: str, name: str, curve: OneCurve | None) -> None:
    desk.hand.change(dynamics=with_curve(desk.hand.brush.dynamics, target, name, curve))


def _applies(brush: Brush, target: str) -> bool:
    """Tells whether a setting counts for a brush: those of its tip only where that has them."""
    shape = brush.shape
    if FOLLOWERS[target].own is not None:
        of_ink = target not in COLOUR_TARGETS and int(target.rpartition("_")[2]) > len(brush.ink)
        return brush.row.lays_ink and not of_ink
    if target == "scatter":
        return shape.scatter > 0.0 or target in brush.dynamics
    if target in ("angle", "ratio"):
        return shape.ratio < 1.0 or shape.bristles > 0 or brush.tip is not None or target in brush.dynamics
    return True


def _named(curve: OneCurve, rows: tuple[CurveRow, ...]) -> OneCurve:
    """Returns a curve as the editor knows it: by its name if one of the rows is that."""
    if curve == STRAIGHT and rows is _PRESSURE_ROWS:
        return "pressure"
    return next((row.name for row in rows if row.name in _CURVES and _CURVES[row.name] == curve), curve)


def _given(drawn: OneCurve | None) -> OneCurve | None:
    """Returns what the editor gave: a name as its curve."""
    return _CURVES.get(drawn, drawn) if isinstance(drawn, str) else None if drawn is None else drawn


def _across(row: Input, span: float) -> str:
    return f"Left 0, right {span:g}{'' if row.unit in ('', '°') else ' '}{row.unit}"
