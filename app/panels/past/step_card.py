"""A step as a card: its small picture, and a line or two under it."""

from __future__ import annotations

from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui

from app import theme
from app.language import said
from app.language.words import say
from app.panels.controls import widgets as w
from app.panels.controls.fitting import ended

WIDE, TALL = 96.0, 72.0  # points of the picture
_GAP = 4.0


@dataclass(frozen=True, slots=True)
class Look:
    """How a card is drawn: `now`: the painting is as it was after it; `seen`: it is looked at; `undone`; `count`: of
    the steps that it stands for."""

    now: bool = False
    seen: bool = False
    undone: bool = False
    count: int = 1


def size(scale: float, lines: int) -> tuple[float, float]:
    """Returns the width and height of a card with so many lines of text, pixels."""
    return (WIDE + 2 * _GAP) * scale, (TALL + 2 * _GAP) * scale + lines * imgui.get_text_line_height()


def draw(name: str, picture: object | None, lines: tuple[str, ...], look: Look, hint: str) -> str:
    """Draws a card where the cursor is; tells with which button it was pressed, "left" or "right", if it was.  `name`:
    what tests call it."""
    scale = imgui.get_style().font_scale_dpi
    corner, (wide, tall) = imgui.get_cursor_screen_pos(), size(scale, len(lines))
    pressed = imgui.invisible_button(f"##{name}", ImVec2(wide, tall), imgui.ButtonFlags_.enable_nav)
    right = imgui.is_item_clicked(imgui.MouseButton_.right)
    over = imgui.is_item_hovered()
    w.named(name)
    w.tooltip(hint)
    painter, end = imgui.get_window_draw_list(), ImVec2(corner.x + wide, corner.y + tall)
    rounding = imgui.get_style().frame_rounding
    if look.now or look.seen or over:
        grey = theme.look.accent_soft if look.now or look.seen else theme.look.raised
        painter.add_rect_filled(corner, end, theme.packed(grey), rounding)
    strength = 0.35 if look.undone else 1.0
    gap = _GAP * scale
    at = ImVec2(corner.x + gap, corner.y + gap)
    edge = ImVec2(at.x + WIDE * scale, at.y + TALL * scale)
    _picture(painter, picture, (at, edge), strength)
    if look.seen:
        painter.add_rect(at, edge, theme.packed(theme.look.warn), rounding, thickness=2.0 * scale)
    if look.count > 1:
        _count(painter, look.count, edge, strength)
    painter.push_clip_rect(at, ImVec2(edge.x, end.y), True)
    for n, text in enumerate(lines):
        colour = theme.look.text if n == 0 else theme.look.soft
        y = edge.y + 0.5 * gap + n * imgui.get_text_line_height()
        said.add_text(
            painter, ImVec2(at.x, round(y)), theme.packed(colour, max(strength, 0.5)), ended(say(text), WIDE * scale)
        )
    painter.pop_clip_rect()
    return "left" if pressed else "right" if right else ""


def _picture(painter: imgui.ImDrawList, picture: object | None, box: tuple[ImVec2, ImVec2], strength: float) -> None:
    rounding = imgui.get_style().frame_rounding
    painter.add_rect_filled(*box, theme.packed(theme.look.field), rounding)
    if picture is not None:
        tint = theme.packed((1.0, 1.0, 1.0), strength)
        painter.add_image_rounded(picture, *box, ImVec2(0, 0), ImVec2(1, 1), tint, rounding)  # type: ignore[arg-type]


def _count(painter: imgui.ImDrawList, count: int, edge: ImVec2, strength: float) -> None:
    """Draws how many steps it stands for, in the picture's lower right corner."""
    text = f"{count}"
    room, scale = said.calc_text_size(text), imgui.get_style().font_scale_dpi
    corner = ImVec2(edge.x - room.x - 10 * scale, edge.y - room.y - 4 * scale)
    painter.add_rect_filled(corner, edge, theme.packed((0.08,) * 3, 0.8 * strength), imgui.get_style().frame_rounding)
    said.add_text(
        painter, ImVec2(corner.x + 5 * scale, corner.y + 2 * scale), theme.packed((1.0, 1.0, 1.0), strength), text
    )
