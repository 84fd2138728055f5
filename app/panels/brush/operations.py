"""Raster operations in the brush panel: which one, its parameters, or a formula of the artist's own."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from itertools import groupby
from typing import TYPE_CHECKING, Any

from imgui_bundle import ImVec2, imgui
from immutables import Map

from app import icons, theme
from app.desk import ramps
from app.desk.desk import Desk
from app.desk.knots import STRAIGHT, Knots
from app.language import said
from app.panels.controls import widgets as w
from app.panels.controls.curve_editor import Curve, CurveEditor
from app.panels.controls.ramp_editor import RampEditor
from engine.numeric.formula import FORMULA_CAP, FUNCTIONS, NAMES, FormulaError, parse

if TYPE_CHECKING:
    from engine.brush.ops import Op, Parameter

BESIDE = (64, 0)  # pixels: what a clone of the layer itself begins with; without, it changes nothing
OFFSETS = (-512.0, 512.0)  # that the sliders offer
_REST = 0.4  # seconds without typing before a formula is taken: each is compiled
ECHO = 13  # characters of a formula shown on each side of its mistake
FORMULAS = (
    ("Towards the colour", "colour - pic"),
    ("Towards its opposite", "1 - 2 * pic"),
    ("Two tones", "step(0.5, luma) - pic"),
    ("Glow in the light", "luma ** 2 * colour"),
    ("Ripples", "0.2 * sin(tau * (x + y) / 24)"),
    ("Film grain", "0.4 * (noise(x, y) - 0.5)"),
    ("Deeper with pressure", "-pic * pressure"),
)


class Operations:
    """Remembers the formula as it is typed, which may not be one yet."""

    def __init__(self) -> None:
        self._ramp, self._curves = RampEditor(), CurveEditor(smooth=True)
        self._text = ""
        self._known = ""  # the brush's formula when `_text` was last the same
        self._typed = 0.0  # when it was last changed
        self._fault: FormulaError | None = None

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        op = desk.hand.brush.op
        own = not isinstance(op, str) and "formula" in op
        name = "formula" if own else op if isinstance(op, str) else str(op["name"])
        chosen = self._chooser(desk, name)
        if chosen and chosen != name:
            started = _started(desk, chosen)
            if started is None:
                desk.say("Cloning copies a layer: paint on one first", bad=True)
            else:
                desk.hand.change(op=started)
            return
        if own:
            was = str(op["formula"])  # type: ignore[index]
            if (now := self.formula(was)) != was:
                desk.hand.change(op=Map({"formula": now}))
            return
        row = next((row for row in desk.known.tables.ops if row.name == name), None)
        given: Map[str, Any] = Map() if isinstance(op, str) else op
        changed = given
        for parameter in row.parameters if row else ():
            changed = self.parameter(desk, changed, parameter)
        if changed != given:
            desk.hand.change(op=changed.set("name", name))

    def _chooser(self, desk: Desk, name: str) -> str | None:
        rows = {row.name: row for row in desk.known.tables.ops}
        label = "Formula" if name == "formula" else rows[name].label if name in rows else name
        imgui.set_next_item_width(-1)
        if not said.begin_combo("##op", label, imgui.ComboFlags_.height_largest):
            w.named("operation")
            w.tooltip(op_hint(rows[name]) if name in rows else "What a stroke does to the colours that are there")
            return None
        picked = None
        for group, listed in groupby(rows.values(), lambda row: row.group):
            said.text_disabled(group)
            for row in listed:
                if said.selectable(f"   {row.label}##{row.name}", row.name == name)[0]:
                    picked = row.name
                w.named(row.label)
                w.tooltip(op_hint(row))
        imgui.separator()
        if said.selectable("Formula…", name == "formula")[0]:
            picked = "formula"
        w.named("Formula…")
        w.tooltip("Write yourself what is added to each channel")
        imgui.end_combo()
        return picked

    def parameter(self, desk: Desk, given: Map[str, Any], row: Parameter) -> Map[str, Any]:
        """Draws the control of a parameter; returns what is given from now on."""
        value = given.get(row.name, row.default)
        new = CONTROLS[row.kind](self, desk, row, value)
        return given if new == value else given.set(row.name, new)

    def _number(self, desk: Desk, row: Parameter, value: Any) -> Any:
        form = {"px": "%.1f px", "degrees": "%.0f°"}.get(row.unit, "%.2f")
        changed, new = w.slider(row.label, float(value), row.slider, row.tooltip, form=form, curved=row.logarithmic)
        return min(max(round(new, 3), row.lo), row.hi) if changed else value

    def _choice(self, desk: Desk, row: Parameter, value: Any) -> Any:
        options = [(one, f"{row.label} {one}") for one in row.choices]
        return w.choice(row.name, value, options, row.tooltip, -1) or value

    def _layer(self, desk: Desk, row: Parameter, value: Any) -> Any:
        options = [(name, f"From {name}") for name in _layers(desk)]
        if value not in dict(options):
            options.append((value, f"From {value} (not here)"))
        return w.choice(row.name, value, options, row.tooltip, -1) or value

    def _offset(self, desk: Desk, row: Parameter, value: Any) -> Any:
        parts = list(value)
        for i, axis in enumerate(("right", "down")):
            shown = (f"{row.label} {axis}", float(parts[i]), OFFSETS, row.tooltip)
            changed, new = w.slider(*shown, form="%.0f px")
            if changed:
                parts[i] = round(new)
        return tuple(parts)

    def _curve(self, desk: Desk, row: Parameter, value: Knots) -> Curve:
        changed, new = self._curves.row(row.label, None if value == STRAIGHT else value, (), row.tooltip)
        return (STRAIGHT if new is None else new) if changed else value

    def _stops(self, desk: Desk, row: Parameter, value: Any) -> Any:
        stops = ramps.read(value)
        new = self._ramp.draw(stops, row.tooltip)
        return value if new == stops else new

    def formula(self, formula: str) -> str:
        """Draws the field, what is wrong with it, and some formulas to begin with; returns the last good one."""
        if formula != self._known:
            self._text = self._known = formula
            self._fault = None
        side = imgui.get_frame_height()
        imgui.set_next_item_width(imgui.get_content_region_avail().x - side - imgui.get_style().item_spacing.x)
        changed, self._text = imgui.input_text("##formula", self._text)
        w.named("formula")
        left = imgui.is_item_deactivated()
        if not imgui.is_item_active():  # it would cover what is said about a mistake
            w.tooltip(_VOCABULARY)
        imgui.same_line()
        if w.icon_button("more formulas", icons.MORE, "Formulas to begin with"):
            imgui.open_popup("formulas")
        if imgui.begin_popup("formulas"):
            for title, text in FORMULAS:
                if said.selectable(f"{title}##{text}", False)[0]:
                    self._text, changed, left = text, True, True
                w.tooltip(text)
            imgui.end_popup()
        now = time.monotonic()
        if changed:
            self._text = self._text[:FORMULA_CAP]
            self._fault, self._typed = fault(self._text), now
        if self._fault is None and self._text != self._known and (left or now - self._typed > _REST):
            self._known = self._text
        if self._fault is not None:
            _mistake(self._text, self._fault)
        return self._known


CONTROLS: dict[str, Callable[[Operations, Desk, Any, Any], Any]] = {
    "number": Operations._number,
    "choice": Operations._choice,
    "layer": Operations._layer,
    "offset": Operations._offset,
    "ramp": Operations._stops,
    "curve": Operations._curve,
}
_VOCABULARY = (
    "f of pic + d tex f: what is added to each channel, from\n"
    + "\n".join(f"{name}: {meaning}" for name, meaning in NAMES.items())
    + "\n\nwith + - * / % **, comparisons, a if b else c, and\n"
    + ", ".join(FUNCTIONS)
)


def fault(formula: str) -> FormulaError | None:
    """Returns what is wrong with a formula, if anything is."""
    try:
        parse(formula)
    except FormulaError as error:
        return error
    return None


def around(formula: str, column: int) -> tuple[str, str, str]:
    """Returns a piece of a formula: before, at and behind the column (from 1) of a mistake; an end is shown as a
    blank."""
    i = min(max(column - 1, 0), len(formula))
    before, behind = formula[max(0, i - ECHO) : i], formula[i + 1 : i + 1 + ECHO]
    before = ("…" if i > ECHO else "") + before
    return before, formula[i : i + 1] or " ", behind + ("…" if i + 1 + ECHO < len(formula) else "")


def _mistake(formula: str, error: FormulaError) -> None:
    """Draws the place of the mistake in its surroundings, and what was expected there."""
    before, there, behind = around(formula, error.column)
    corner, painter = imgui.get_cursor_screen_pos(), imgui.get_window_draw_list()
    x = corner.x
    warn, quiet, height = theme.packed(theme.look.warn), theme.packed(theme.look.soft), imgui.get_text_line_height()
    for text, colour in ((before, quiet), (there, warn), (behind, quiet)):
        width = max(said.calc_text_size(text).x, 4.0)
        said.add_text(painter, ImVec2(x, corner.y), colour, text)
        if colour == warn:
            painter.add_rect_filled(ImVec2(x, corner.y + height), ImVec2(x + width, corner.y + height + 2), warn)
        x += width
    imgui.dummy(ImVec2(1, height + 2))
    wanted = f"Column {error.column}: found {error.found}, expected {error.expected.partition(':')[0]}"
    imgui.push_text_wrap_pos(0.0)
    said.text_colored(theme.vec(theme.look.warn), wanted)
    imgui.pop_text_wrap_pos()
    w.tooltip(f"Found {error.found}, expected {error.expected}")


def op_hint(row: Op) -> str:
    """Returns a row's hint, with what it does to the other levels."""
    return f"{row.tooltip}\n\n{row.finer}\n{row.coarser}"


def _layers(desk: Desk) -> list[str]:
    return [row.name for row in desk.known.scene.layers if not row.group] if desk.known.scene else []


def copied(layers: Sequence[str], active: str | None) -> str:
    """Returns the layer that a clone begins to copy from, of all from the top: the one below, or else above, or the
    same."""
    if active not in layers:
        return layers[0]
    i = layers.index(active)
    return layers[i + 1] if i + 1 < len(layers) else layers[max(0, i - 1)]


def _started(desk: Desk, name: str) -> Any:
    """Returns the op as it begins: its name, with what has to be given; None if there is nothing to give."""
    if name == "formula":
        return Map({"formula": FORMULAS[0][1]})
    row = next(row for row in desk.known.tables.ops if row.name == name)
    given: dict[str, Any] = {}
    for parameter in row.parameters:
        if parameter.default is None and parameter.kind == "layer":
            layers, active = _layers(desk), desk.known.scene.active if desk.known.scene else None
            if not layers:
                return None
            given[parameter.name] = source = copied(layers, active)
            if source == active:
                given["offset"] = BESIDE
    return Map({"name": name} | given) if given else name
