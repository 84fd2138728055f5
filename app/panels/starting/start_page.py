"""The page that the first start shows over the canvas: a painting to play with, things to try, and what was open.

A press beside it goes to the canvas, which the router sees to.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import NamedTuple

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.actions.action import ready
from app.actions.actions import ACTIONS, perform
from app.desk import presets, previews
from app.desk.desk import Desk
from app.desk.holding.taking import take_preset
from app.desk.previews import FileRow
from app.desk.recovery.recovery_work import CARDS
from app.language import said
from app.panels.controls import widgets as w
from app.panels.recent_menu import draw_recent
from app.panels.starting.recent_pictures import ask_pictures

_WIDE, _NARROW = 43.0, 27.0  # ems of the card at most; of it where its two halves lie one below the other
_ONE_LINE = 37.0  # ems of a card in which the last words stand on one line
_RATIO = 0.625  # of the picture's height to its width
_DEMO = presets.bundled_folder().with_name("demo")
_LAKE = FileRow("lake.png", False)
_SIDE = 352  # pixels of its picture
_RECENT = 3


class Try(NamedTuple):
    """A thing to try: what is said of it, what does it, an action or a word, and what a press on it does."""

    title: str
    by: str
    hint: str
    do: Callable[[Desk], None]


def _does(name: str) -> Callable[[Desk], None]:
    return lambda desk: void(perform(desk, ACTIONS[name]))


def void(_done: bool) -> None:
    """Nothing: whether it was done is seen."""


def _granite(desk: Desk) -> None:
    found = presets.nearest(desk.known.presets, "granite")
    if found is not None:
        take_preset(desk, found)
        desk.say("Brush: Granite. Paint, then turn the wheel over it")


TRIES = (
    Try("Zoom in, and on, and on", "Wheel", "Paint keeps showing new detail, however near you go", _does("in")),
    Try("Paint with granite, then zoom into it", "", "Takes the brush Granite", _granite),
    Try("Brushes and colours at hand", "Right click", "Favourites, wheel and zoom", _does("pop_up")),
    Try("Make a texture of your own", "lab", "The texture lab: paint how coarse and how fine it is", _does("lab")),
    Try("See the painting as land", "land", "Light and dark are heights; fly over them", _does("land")),
)


@contextmanager
def card_style(desk: Desk) -> Iterator[None]:
    """Within it windows look like a card."""
    imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(22, 16) * desk.scale)
    imgui.push_style_var(imgui.StyleVar_.window_rounding, 8 * desk.scale)
    imgui.push_style_var(imgui.StyleVar_.window_border_size, 1)
    try:
        yield
    finally:
        imgui.pop_style_var(3)


class StartPage:
    """Draws the card into a window of its own, which the layout begins."""

    def box(self, desk: Desk) -> tuple[float, float, float, float] | None:
        """Returns left, top, width and height of the card, whole in what the panels leave free; None while it is not
        shown."""
        if not desk.start.shown:
            return None
        em = imgui.get_font_size()
        x0, y0, x1, y1 = desk.free_area()
        wide = min(_WIDE * em, x1 - x0 - 2 * em)
        tall = min(self._tall(desk, wide), y1 - y0 - 2 * em)
        return (x0 + x1 - wide) / 2, (y0 + y1 - tall) / 2, wide, tall

    def _tall(self, desk: Desk, wide: float) -> float:
        """Returns the height that all of it takes."""
        em, line = imgui.get_font_size(), imgui.get_frame_height_with_spacing()
        half = (wide - 4.4 * em) / 2 if wide >= _NARROW * em else wide - 3 * em
        left, right = half * _RATIO + 1.5 * line, (len(TRIES) + 1) * 2.05 * em
        body = max(left, right) if wide >= _NARROW * em else left + right + em
        recent = 5.6 * em if desk.opened.paths else 0.0
        return (5.9 if wide >= _ONE_LINE * em else 7.2) * em + body + line + recent

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        em, wide = imgui.get_font_size(), imgui.get_window_width()
        self._title(desk, em)
        beside = wide >= _NARROW * em
        half = (imgui.get_content_region_avail().x - 1.4 * em) / 2 if beside else imgui.get_content_region_avail().x
        imgui.begin_group()
        self._lake(desk, half)
        imgui.end_group()
        if beside:
            imgui.same_line(0, 1.4 * em)
        imgui.begin_group()
        self._tries(desk, half, em)
        imgui.end_group()
        imgui.spacing()
        self._begin(desk)
        if desk.opened.paths:
            self._recent(desk, em)
        imgui.spacing()
        imgui.push_text_wrap_pos(0)
        said.text_disabled("Or just paint: a press beside this page closes it. Help > Start page shows it again.")
        imgui.pop_text_wrap_pos()
        if not desk.asked.shown and not imgui.is_popup_open("", imgui.PopupFlags_.any_popup):
            self._ask(desk)

    def _title(self, desk: Desk, em: float) -> None:
        imgui.push_font(None, imgui.get_style().font_size_base * 1.5)
        said.text_unformatted("Welcome to Inkfall")
        imgui.pop_font()
        imgui.same_line(imgui.get_window_width() - imgui.get_frame_height() - imgui.get_style().window_padding.x)
        if w.icon_button("close page", icons.CLOSE, "Close  (Escape)"):
            desk.start.leave()
        imgui.dummy(ImVec2(0, 0.1 * em))

    def _lake(self, desk: Desk, wide: float) -> None:
        """Draws the painting to play with, whose picture is pressed as its button is."""
        corner, size = imgui.get_cursor_screen_pos(), ImVec2(wide, round(wide * _RATIO))
        hint = "It is painted before your eyes, in a minute or more; zoom in or stop it meanwhile"
        pressed = imgui.invisible_button("lake", size, imgui.ButtonFlags_.enable_nav) and ready(desk)
        w.named("lake picture")
        w.tooltip(hint)
        end, painter = ImVec2(corner.x + size.x, corner.y + size.y), imgui.get_window_draw_list()
        painter.add_rect_filled(corner, end, theme.packed(theme.look.field), imgui.get_style().frame_rounding)
        shown = desk.pictures.get(previews.ident(_DEMO, _LAKE))
        if shown is not None:
            cut = (1.0 - _RATIO) / 2  # it lies in the middle of a square
            rounding, white = imgui.get_style().frame_rounding, theme.packed((1.0, 1.0, 1.0))
            painter.add_image_rounded(shown, corner, end, ImVec2(0, cut), ImVec2(1, 1 - cut), white, rounding)
        if w.accent_button("Play with the lake", hint, enabled=ready(desk), width=wide) or pressed:
            desk.guard(lambda: desk.open(_DEMO / "demo.jsonl", live=True))

    def _tries(self, desk: Desk, wide: float, em: float) -> None:
        said.text_disabled("Five things to try")
        for i, row in enumerate(TRIES):
            corner = imgui.get_cursor_screen_pos()
            if said.selectable(f"##try {i}", False, 0, ImVec2(wide, 1.55 * em))[0] and ready(desk):
                desk.start.leave()
                row.do(desk)
            w.named(row.title)
            w.tooltip(row.hint)
            painter, y = imgui.get_window_draw_list(), corner.y + 0.28 * em
            said.add_text(painter, ImVec2(corner.x + 0.3 * em, y), theme.packed(theme.look.text), row.title)
            keys = (*ACTIONS[row.by].keys, "")[0] if row.by in ACTIONS else row.by
            right = corner.x + wide - said.calc_text_size(keys).x - 0.3 * em
            if right > corner.x + said.calc_text_size(row.title).x + em:
                said.add_text(painter, ImVec2(right, y), theme.packed(theme.look.accent), keys)

    def _begin(self, desk: Desk) -> None:
        for i, name in enumerate(("new", "open")):
            if i:
                imgui.same_line()
            action = ACTIONS[name]
            if w.text_button(f"{action.title}##start", action.hint, enabled=action.when(desk)):
                perform(desk, action)
        count = len(desk.recovery.cards)
        if count:
            imgui.same_line()
            label = f"Recover {count} painting{'s' if count > 1 else ''}…##start"
            if w.text_button(label, "Paintings that were not closed"):
                desk.asked.show(CARDS)

    def _recent(self, desk: Desk, em: float) -> None:
        imgui.spacing()
        said.text_disabled("Open recent")
        gap = imgui.get_style().item_spacing.x
        wide = imgui.get_content_region_avail().x
        count = max(1, min(_RECENT, len(desk.opened.paths), int(wide / (12.0 * em))))
        for i, path in enumerate(desk.opened.paths[:count]):
            if i:
                imgui.same_line(0, gap)
            imgui.push_id(i)
            if draw_recent(desk, path, "start", (wide - (_RECENT - 1) * gap) / _RECENT) and ready(desk):
                desk.guard(partial(desk.open, path))
            imgui.pop_id()

    def _ask(self, desk: Desk) -> None:
        """Asks for the pictures, one kind after the other: what is asked for last takes the place of all before."""
        if previews.ident(_DEMO, _LAKE) in desk.pictures:
            ask_pictures(desk, desk.opened.paths[:_RECENT])
        else:
            desk.previews(_DEMO, [_LAKE], _SIDE)
