"""What can be set of a texture that is being written, its period and the sliders of its text; and the facts."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui
from immutables import Map

from app import theme
from app.desk.colours import from_hex, to_hex
from app.desk.desk import Desk
from app.desk.workshop.workshop_state import PERIODS, WorkshopState
from app.language import said
from app.panels.controls import widgets as w
from app.panels.controls.colour_popup import colour_popup
from engine.studio.workshop.workshop_records import Setting
from engine.texture.expression.written import (
    FELT,
    FULL_TURN,
    OWN_RIM,
    OWN_WAY,
    PRESSURE,
    STAGES_LEAST,
    STROKE_WAYS,
    samples_told,
)

_WAY = FULL_TURN / STROKE_WAYS
_SEEN = {
    PRESSURE: ("At pressure", "How hard the pen pressed in this picture: a stroke has its own pressure", 1.0, 0.01),
    OWN_RIM: ("From the rim", "How far within its stroke's rim this picture lies, 1 a radius or more", 1.0, 0.01),
    OWN_WAY: (
        "Running",
        "Which way the stroke runs in this picture, clockwise from rightwards",
        FULL_TURN - _WAY,
        _WAY,
    ),
}
_TONES = ((0.86, 0.36, 0.32), (0.36, 0.72, 0.36), (0.36, 0.52, 0.90))


def draw_settings(desk: Desk) -> None:
    """Draws them into the present window."""
    state = desk.workshop
    hint = "How many pixels of the level painted on the text calls 1: smaller makes the texture finer"
    changed, value = w.slider("Period", state.period, PERIODS, hint, form="%.0f px", curved=True)
    state.period = float(round(value)) if changed else state.period
    for row in state.scene.sliders:
        imgui.push_id(row[0])
        _setting(desk, row)
        imgui.pop_id()
    if state.scene.felt:
        _felt(state)
    if state.values:
        _values(desk)
    _facts(desk)


def _felt(state: WorkshopState) -> None:
    """Draws for how many pressures, and distances from the rim, there are textures, and which is looked at."""
    hint = "For how many pressures, or distances from the rim, a stroke has textures: what lies between is mixed"
    if state.scene.felt != (OWN_WAY,):
        most = float(state.stages_most)
        changed, value = w.slider("Stages", float(state.staged), (float(STAGES_LEAST), most), hint, form="%.0f")
        state.stages = round(value) if changed else state.stages
    felt = dict(zip(FELT, state.felt, strict=True))
    for name in state.scene.felt:
        label, hint, most, step = _SEEN[name]
        changed, value = w.slider(label, felt[name], (0.0, most), hint, form="%.2f" if most == 1.0 else "%.0f°")
        felt[name] = round(value / step) * step if changed else felt[name]
    state.felt = felt[PRESSURE], felt[OWN_RIM], felt[OWN_WAY]


def _setting(desk: Desk, row: Setting) -> None:
    name, usual, least, most, step = row
    state = desk.workshop
    value = state.value(name, usual)
    if isinstance(value, str):
        side, rgb = imgui.get_frame_height(), from_hex(value[:7])
        if w.swatch(name, rgb, "A colour that the text lets be set", (side * 1.6, side)):
            imgui.open_popup("pick")
        picked = colour_popup("pick", rgb)
        if picked is not None:
            state.values = state.values.set(name, to_hex(picked) + value[7:])
        imgui.same_line()
        imgui.align_text_to_frame_padding()
        said.own_text(name)
        return
    whole = step > 0.0 and step == int(step) and least == int(least)
    form = "%.0f" if whole else ("%.1f" if most - least >= 50.0 else "%.2f")
    hint = "A number that the text lets be set"
    changed, value = w.slider(name, float(value), (least, most), hint, form=form, own=True)
    if changed:
        moved = least + round((value - least) / step) * step if step > 0.0 else round(value, 4)
        state.values = state.values.set(name, max(least, min(most, moved)))


def _values(desk: Desk) -> None:
    state, wide = desk.workshop, (imgui.get_content_region_avail().x - 2 * desk.scale) / 2
    if w.text_button("As the text says", "Sets all sliders as the text does", width=wide):
        state.values = Map()
    imgui.same_line(0, 2 * desk.scale)
    hint = "Writes these values into the text, as its usual ones"
    if w.text_button("Into the text", hint, enabled=state.right, width=wide):
        state.settle()


def _facts(desk: Desk) -> None:
    """Draws how often values are seen, and what is known of what is looked at."""
    state, scene = desk.workshop, desk.workshop.scene
    if not scene.lines:
        return
    wide, tall = imgui.get_content_region_avail().x, 44 * desk.scale
    corner = w.picture(None, (wide, tall), "How often each value is seen in the picture", name="histogram")
    painter = imgui.get_window_draw_list()
    for n, counts in enumerate(scene.counts):
        colour = theme.look.soft if len(scene.counts) == 1 else _TONES[n]
        _graph(painter, corner, (wide, tall), counts, theme.packed(colour, 0.9))
    line = scene.lines[state.line if 0 <= state.line < len(scene.lines) else -1]
    said.text_disabled(f"{scene.least:g}")
    text = f"{scene.most:g}"
    imgui.same_line(wide - said.calc_text_size(text).x)
    said.text_disabled(text)
    imgui.push_style_color(imgui.Col_.text, theme.vec(theme.look.quiet))
    samples = samples_told(line.samples)
    said.text_wrapped(f"{line.cost:,.0f} ns a pixel, {samples}" if line.cost else "measuring…")
    imgui.pop_style_color()
    w.tooltip("What it costs, with all that it refers to; what has no exact mean is looked at in 4 or 16 points")
    if scene.shimmer >= 0.0:
        quiet = scene.shimmer <= 3.0
        text = f"Shimmer {scene.shimmer:.2f} of 255"
        imgui.push_style_color(imgui.Col_.text, theme.vec(theme.look.quiet if quiet else theme.look.warn))
        said.text_wrapped(text)
        imgui.pop_style_color()
        w.tooltip("How far it is from its next finer level, reduced: above 3 it shimmers as one zooms")


def _graph(
    painter: imgui.ImDrawList, corner: ImVec2, size: tuple[float, float], counts: tuple[int, ...], colour: int
) -> None:
    ordered = sorted(counts)
    most = max(ordered[-3], ordered[-1] // 4, 1)  # what two values alone have must not hide all others
    step = size[0] / len(counts)
    tops = [corner.y + size[1] - 2 - (size[1] - 4) * min(1.0, count / most) for count in counts]
    points = [(corner.x + (n + end) * step, top) for n, top in enumerate(tops) for end in (0, 1)]
    painter.add_polyline([ImVec2(x, y) for x, y in points], colour, 1.25, 0)
