"""The windows that ask: a new painting, unsaved changes, the list of keys, about."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from imgui_bundle import ImVec2, imgui

from app import theme
from app.desk import Desk
from app.panels import widgets as w
from engine.numeric.address import Rect
from engine.painting.requests import New

MOST_SIDE = 1 << 20
_SIZES = (("Screen", 1280, 800), ("Square", 1024, 1024), ("Wide", 1920, 1080), ("A4, 150 dpi", 1240, 1754))


class Dialog(Protocol):
    title: str

    def draw(self, desk: Desk) -> bool:
        """Draws the contents; False when it is done."""
        ...


def draw(desk: Desk) -> None:
    """Shows the dialog that is open, in the middle of the screen, above everything."""
    dialog = desk.dialog
    if dialog is None:
        return
    name = f"{dialog.title}###dialog"
    if not imgui.is_popup_open("###dialog"):
        imgui.open_popup("###dialog")
    imgui.set_next_window_pos(ImVec2(desk.view.width / 2, desk.view.height / 2), imgui.Cond_.always, ImVec2(0.5, 0.5))
    imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(18 * desk.scale, 14 * desk.scale))
    flags = imgui.WindowFlags_.always_auto_resize | imgui.WindowFlags_.no_saved_settings
    if imgui.begin_popup_modal(name, None, flags)[0]:
        if not dialog.draw(desk) or imgui.is_key_pressed(imgui.Key.escape):
            imgui.close_current_popup()
            if desk.dialog is dialog:
                desk.dialog = None
        imgui.end_popup()
    imgui.pop_style_var()


class NewPainting:
    title = "New painting"

    def __init__(self) -> None:
        self._width, self._height = 1280, 800

    def draw(self, desk: Desk) -> bool:
        em = imgui.get_font_size()
        for i, (name, width, height) in enumerate(_SIZES):
            if i % 2:
                imgui.same_line()
            if w.text_button(f"{name}\n{width} × {height}##{name}", "Use this size", width=em * 10):
                self._width, self._height = width, height
        imgui.spacing()
        imgui.set_next_item_width(em * 8)
        _, self._width = imgui.input_int("Width", self._width, 0)
        w.tooltip("Of the frame, in pixels of level 0; you can paint outside it and inside every pixel")
        imgui.same_line()
        imgui.set_next_item_width(em * 8)
        _, self._height = imgui.input_int("Height", self._height, 0)
        w.tooltip("Of the frame, in pixels of level 0")
        good = 1 <= self._width <= MOST_SIDE and 1 <= self._height <= MOST_SIDE
        imgui.spacing()
        if w.text_button("Start", "Start the new painting", enabled=good, width=em * 8):
            desk.post(New(Rect(0, 0, self._width, self._height)))
            return False
        imgui.same_line()
        return not w.text_button("Cancel", "Go back", width=em * 8)


class Unsaved:
    """Asks what is to become of changes before something replaces the painting."""

    title = "Unsaved changes"

    def __init__(self, save: Callable[[Desk], None], then: Callable[[Desk], None]) -> None:
        self._save, self._then = save, then

    def draw(self, desk: Desk) -> bool:
        name = desk.path.name if desk.path else "This painting"
        imgui.text_unformatted(f"{name} has changes that are not saved.")
        imgui.spacing()
        em = imgui.get_font_size()
        if w.text_button("Save", "Save, then go on", width=em * 7):
            desk.after_save = lambda: self._then(desk)
            desk.dialog = None
            self._save(desk)
            return False
        imgui.same_line()
        if w.text_button("Don’t save", "Go on; the changes are lost", width=em * 7):
            desk.dialog = None
            self._then(desk)
            return False
        imgui.same_line()
        return not w.text_button("Cancel", "Go back to the painting", width=em * 7)


class Keys:
    title = "Keys"

    def draw(self, desk: Desk) -> bool:
        from app.actions import ACTIONS, MENUS

        rows = [
            ("Wheel", "Zoom about the pointer"),
            ("Space + drag, middle button", "Pan"),
            ("Shift + Space + drag", "Turn the view"),
            ("Ctrl + Space + drag", "Zoom"),
            ("Ctrl + click, right button", "Pick a colour"),
        ]
        rows += [(", ".join(a.keys), a.title) for menu in MENUS for a in ACTIONS.values() if a.menu == menu and a.keys]
        half = -(-len(rows) // 2)
        em = imgui.get_font_size()
        if imgui.begin_table("keys", 4, 0, ImVec2(em * 42, 0)):
            for i in range(half):
                imgui.table_next_row()
                for keys, title in rows[i : i + half + 1 : half]:
                    imgui.table_next_column()
                    imgui.text_colored(theme.vec(theme.ACCENT), keys)
                    imgui.table_next_column()
                    imgui.text_unformatted(title)
            imgui.end_table()
        imgui.spacing()
        return not w.text_button("Close", "Close the list", width=em * 7)


class About:
    title = "About Inkfall"

    def draw(self, desk: Desk) -> bool:
        em = imgui.get_font_size()
        imgui.push_text_wrap_pos(em * 28)
        imgui.text_unformatted(
            "Inkfall is a paint program without a bottom: paint is a bandpass pyramid, and textured ink keeps showing "
            "new detail as you zoom in.\n\nAfter “Live Paint: Painting with Procedural Multiscale Textures” "
            "(Perlin & Velho, 1995). MIT licence."
        )
        imgui.pop_text_wrap_pos()
        imgui.spacing()
        return not w.text_button("Close", "Close", width=em * 7)


def guarded(desk: Desk, then: Callable[[Desk], None]) -> None:
    """Does `then`, after asking about unsaved changes if there are any."""
    from app.panels import files

    if desk.modified:
        desk.dialog = Unsaved(files.save, then)
    else:
        then(desk)


def ask_new(desk: Desk) -> None:
    guarded(desk, lambda d: setattr(d, "dialog", NewPainting()))


def show_keys(desk: Desk) -> None:
    desk.dialog = Keys()


def show_about(desk: Desk) -> None:
    desk.dialog = About()
