"""The pen tester: what the pen tells, as it came and as it is felt, how often, and how evenly."""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence

from imgui_bundle import ImVec2, imgui

from app import theme
from app.desk.desk import Desk
from app.desk.preferring.pen_trial import SECONDS, PenTrial, Report, motion_measured
from app.desk.preferring.preferring import prefer
from app.language import said
from app.panels.controls import widgets as w

_TALL = 6.5  # ems, of the graph and the dial
_BUTTONS = 6
_DRIVERS = (
    ("ink", "Windows Ink", "Pens by the messages of Windows itself"),
    ("wintab", "Wintab", "Pens by the tablet’s own driver; where Ink lacks pressure, or is slow"),
)


def draw_tester(desk: Desk) -> None:
    """Fills the present page."""
    trial, em, gap = desk.trial, imgui.get_font_size(), imgui.get_style().item_spacing.x
    trial.on = True
    said.text_unformatted(f"Heard by: {trial.driver or 'the mouse alone'}")
    told = ", ".join(trial.pens or ()) or "No pen is there: plug one in"
    imgui.push_text_wrap_pos(0.0)
    said.text_disabled(told)
    imgui.pop_text_wrap_pos()
    if sys.platform == "win32":
        chosen = w.segments("driver", desk.preferred.now.driver, _DRIVERS, 18 * em)
        if chosen:
            prefer(desk, driver=chosen)
        said.text_disabled("From the next start on")
    last = trial.reports[-1] if trial.reports else None
    side = _TALL * em
    _graph(trial.reports, ImVec2(imgui.get_content_region_avail().x - side - gap, side))
    imgui.same_line(0, gap)
    _dial(last, side)
    _numbers(trial, last)
    _buttons(trial, last)
    _trail(desk, trial.reports)


def _framed(name: str, size: ImVec2, hint: str) -> tuple[ImVec2, ImVec2]:
    """Draws a field; returns its corners."""
    corner = imgui.get_cursor_screen_pos()
    imgui.dummy(size)
    w.named(name)
    w.tooltip(hint)
    end, rounding = corner + size, imgui.get_style().frame_rounding
    imgui.get_window_draw_list().add_rect_filled(corner, end, theme.packed(theme.look.field), rounding)
    return corner, end


def _graph(reports: Sequence[Report], size: ImVec2) -> None:
    """Draws pressure over the last seconds."""
    hint = "Pressure over the last seconds: grey as the pen tells it, coloured as it is felt"
    corner, end = _framed("pressure graph", size, hint)
    if not reports:
        return
    painter, now, wide = imgui.get_window_draw_list(), reports[-1].time, imgui.get_style().font_scale_dpi
    seen = [report for report in reports if 0 <= now - report.time <= SECONDS]
    for tone, part in ((theme.look.quiet, 3), (theme.look.accent, 4)):
        points = [
            ImVec2(
                end.x - (now - report.time) / SECONDS * size.x,
                end.y - 2 - max(0.0, min(1.0, float(report[part]))) * (size.y - 4),  # type: ignore[arg-type]
            )
            for report in seen
        ]
        painter.push_clip_rect(corner, end, True)
        painter.add_polyline([*points], theme.packed(tone), 1.5 * wide, 0)
        painter.pop_clip_rect()


def _dial(last: Report | None, side: float) -> None:
    """Draws from where the pen leans, and how its barrel is turned."""
    corner, end = _framed(
        "tilt dial", ImVec2(side, side), "Where the pen leans to: upright in the middle; a line: its barrel"
    )
    painter, middle, reach = imgui.get_window_draw_list(), (corner + end) * 0.5, 0.44 * side
    for part in (1 / 3, 2 / 3, 1.0):
        painter.add_circle(middle, reach * part, theme.packed(theme.look.border), 48)
    if last is None:
        return
    scale = imgui.get_style().font_scale_dpi
    if last.event.rotation is not None:
        angle = math.radians(last.event.rotation - 90)
        tip = middle + ImVec2(math.cos(angle), math.sin(angle)) * reach
        painter.add_line(middle, tip, theme.packed(theme.look.quiet), 2 * scale)
    at = middle + ImVec2(last.event.tilt_x, last.event.tilt_y) * (reach / 90)
    painter.add_circle_filled(at, 4 * scale, theme.packed(theme.look.accent), 24)


def _numbers(trial: PenTrial, last: Report | None) -> None:
    """Tells the last report, and what is measured of the last motion."""
    em, found = imgui.get_font_size(), motion_measured(trial.reports)
    turned = last.event.rotation if last is not None else None
    rows = (
        ("Pressed", f"{last.pressed:.3f}" if last else "", "As the pen tells it, 0 to 1"),
        ("Felt", f"{last.felt:.3f}" if last else "", "As brushes get it, by the curve of the page Pen"),
        (
            "Tilt",
            f"{last.event.tilt_x:.0f}°, {last.event.tilt_y:.0f}°" if last else "",
            "To the right, and towards you",
        ),
        ("Rotation", f"{turned:.0f}°" if turned is not None else "", "Of the barrel, where the pen tells it"),
        ("Rate", f"{found.rate:.0f} a second" if found else "", "Reports of the last motion"),
        ("Uneven", f"{found.uneven:.1f} ms" if found else "", "How much the time between reports differs"),
        ("Jitter", f"{found.jitter:.2f} px" if found else "", "How far places lie off the line of their neighbours"),
        ("End", ("eraser" if last.event.eraser else "tip") if last else "", "Which end of the pen is down"),
    )
    for i, (name, value, hint) in enumerate(rows):
        if i % 4:
            imgui.same_line(7.4 * em * (i % 4))
        imgui.begin_group()
        said.text_disabled(name)
        said.text_unformatted(value or "–")
        imgui.end_group()
        w.named(name)
        w.tooltip(hint)


def _buttons(trial: PenTrial, last: Report | None) -> None:
    """Draws which buttons are down."""
    em, painter = imgui.get_font_size(), imgui.get_window_draw_list()
    for number in range(1, _BUTTONS + 1):
        if number > 1:
            imgui.same_line(0, 0.3 * em)
        corner = imgui.get_cursor_screen_pos()
        imgui.dummy(ImVec2(1.6 * em, 1.4 * em))
        w.named(f"button {number}")
        w.tooltip("The tip" if number == 1 else f"Button {number} of pen or mouse")
        end, down = corner + ImVec2(1.6 * em, 1.4 * em), number in trial.buttons
        ground = theme.look.accent_soft if down else theme.look.raised
        painter.add_rect_filled(corner, end, theme.packed(ground), imgui.get_style().frame_rounding)
        at = ImVec2((corner.x + end.x - said.calc_text_size(f"{number}").x) / 2, corner.y + 0.2 * em)
        said.add_text(painter, at, theme.packed(theme.look.text), f"{number}")


def _trail(desk: Desk, reports: Sequence[Report]) -> None:
    """Draws where the pen was in the rest of the page, each report a dot as large as its pressure is felt."""
    room = imgui.get_content_region_avail()
    corner, end = _framed(
        "trail", ImVec2(room.x, max(room.y, 3 * imgui.get_font_size())), "Draw here: each report is a dot"
    )
    painter, most = imgui.get_window_draw_list(), 0.5 * imgui.get_font_size()
    now = reports[-1].time if reports else 0.0
    painter.push_clip_rect(corner, end, True)
    for report in reports:
        if 0 <= now - report.time <= SECONDS:
            radius = max(0.8 * desk.scale, report.felt * most)
            tone = theme.look.warn if report.event.eraser else theme.look.text
            painter.add_circle_filled(ImVec2(report.x, report.y), radius, theme.packed(tone, 0.8), 12)
    painter.pop_clip_rect()
