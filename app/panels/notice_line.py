"""Notices in the status line: the newest with what can be done about it, and all of them in a list above."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.actions.actions import ACTIONS, perform
from app.desk.desk import Desk
from app.desk.notices import Notice
from app.language import said
from app.language.words import say
from app.panels.controls import widgets as w

LIST_WIDTH, LIST_HEIGHT = 44.0, 0.6  # of the list: ems; part of the window's height, at most
_LIST = "notices"


def count_button(desk: Desk, right: float, least: int = 1) -> float:
    """Draws a button at the end of the free part of the line, which opens the list; returns where that part ends now.
    Nothing, if there are fewer notices than `least`."""
    count = len(desk.notices.rows)
    if count >= least:
        label = f"{icons.WARNING} {count} note{'s' if count > 1 else ''}"
        right -= said.calc_text_size(label).x + 2 * imgui.get_style().frame_padding.x
        imgui.same_line(right)
        pressed = said.small_button(label)
        w.named(label)
        w.tooltip("All that went wrong and is not dealt with, to be read at leisure")
        if pressed:
            imgui.open_popup(_LIST)
        right -= imgui.get_font_size()
    _list(desk)
    return right


def draw(desk: Desk, right: float) -> None:
    """Draws the newest notice from here on, as much of it as fits before `right`, and its buttons."""
    notice = desk.notices.rows[-1]
    style, em = imgui.get_style(), imgui.get_font_size()
    named = [ACTIONS[offer].title for offer in _possible(desk, notice)] + (["Details"] if notice.lines else [])
    taken = sum(said.calc_text_size(title).x + 2 * style.frame_padding.x + 0.5 * em for title in named) + 2 * em
    text = _fitted(say(f"{icons.WARNING}  {notice.short}"), right - imgui.get_cursor_pos_x() - taken)
    said.text_colored(theme.vec(theme.look.warn if notice.bad else theme.look.text), text)
    w.named(notice.short)
    w.tooltip(notice.text)
    if notice.lines:
        imgui.same_line(0, em)
        if said.small_button("Details"):
            imgui.open_popup(_LIST)
        w.named("Details")
        w.tooltip("All lines of it")
    _offers(desk, notice)
    imgui.same_line(0, 0.5 * em)
    _close(desk, notice)


def _offers(desk: Desk, notice: Notice) -> None:
    """Draws what can be done about a notice, behind what is drawn."""
    em = imgui.get_font_size()
    for offer in _possible(desk, notice):
        imgui.same_line(0, 0.5 * em)
        action = ACTIONS[offer]
        pressed = said.small_button(action.title)
        w.named(action.title)
        w.tooltip(action.hint)
        if pressed:
            desk.notices.chosen = notice
            perform(desk, action)
            desk.notices.chosen = None


def _close(desk: Desk, notice: Notice) -> None:
    if w.icon_button("close note", icons.CLOSE, "Close this note", size=imgui.get_text_line_height()):
        desk.notices.close(notice)


def _possible(desk: Desk, notice: Notice) -> list[str]:
    return [offer for offer in notice.offers if ACTIONS[offer].when(desk)]


def _list(desk: Desk) -> None:
    """Draws the list of all notices above the line, while it is open."""
    em = imgui.get_font_size()
    corner = imgui.get_window_pos()
    at = ImVec2(corner.x + imgui.get_window_width() - 8 * desk.scale, corner.y - 4 * desk.scale)
    imgui.set_next_window_pos(at, imgui.Cond_.always, ImVec2(1, 1))
    wide = min(LIST_WIDTH * em, desk.view.width - 24 * desk.scale)
    imgui.set_next_window_size_constraints(ImVec2(wide, 0), ImVec2(wide, LIST_HEIGHT * desk.view.height))
    imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(14, 10) * desk.scale)
    if imgui.begin_popup(_LIST):
        for number, notice in enumerate(reversed(desk.notices.rows)):
            imgui.push_id(number)
            if number:
                imgui.separator()
            _entry(desk, notice)
            imgui.pop_id()
        if not desk.notices.rows:
            imgui.close_current_popup()
        imgui.end_popup()
    imgui.pop_style_var()


def _entry(desk: Desk, notice: Notice) -> None:
    """Draws a notice in the list: its line, what closes it at the right end, all else that there is to read."""
    right = imgui.get_window_width() - imgui.get_style().window_padding.x - imgui.get_text_line_height()
    imgui.push_text_wrap_pos(right - imgui.get_font_size())
    said.text_colored(theme.vec(theme.look.warn if notice.bad else theme.look.text), notice.text)
    w.named(notice.text)
    imgui.same_line(right)
    _close(desk, notice)
    for line in notice.lines:
        imgui.bullet()
        said.text_unformatted(line)
        w.named(line)
    imgui.pop_text_wrap_pos()
    if _possible(desk, notice):
        imgui.dummy(ImVec2(0, 0))
        _offers(desk, notice)


def _fitted(text: str, width: float) -> str:
    """Returns a text that is at most so wide, cut in its middle if it must be."""
    if said.calc_text_size(text).x <= width:
        return text
    few, many = 0, len(text)
    while few < many:
        half = (few + many + 1) // 2
        few, many = (half, many) if said.calc_text_size(_cut(text, half)).x <= width else (few, half - 1)
    return _cut(text, few)


def _cut(text: str, count: int) -> str:
    """Returns `count` letters of a text, from both ends."""
    return text if count >= len(text) else f"{text[: count - count // 3]}…{text[len(text) - count // 3 :]}"
