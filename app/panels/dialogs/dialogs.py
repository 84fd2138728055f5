"""The windows that ask: a new painting, files, unsaved changes; the list of keys, about."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from imgui_bundle import ImVec2, ImVec4, imgui

from app.desk.desk import Desk
from app.language import said
from app.language.words import say
from app.panels.arranging.workspaces_dialog import WorkspacesDialog
from app.panels.controls import widgets as w
from app.panels.dialogs import file_browser
from app.panels.dialogs.adjust_dialog import AdjustDialog
from app.panels.dialogs.bake_dialog import BakeDialog
from app.panels.dialogs.bring_in import BringIn
from app.panels.dialogs.doctor_dialog import DoctorDialog
from app.panels.dialogs.earlier_versions import EarlierVersions
from app.panels.dialogs.erode_dialog import ErodeDialog
from app.panels.dialogs.export_dialog import ExportDialog
from app.panels.dialogs.film_dialog import FilmBeingMade, FilmDialog
from app.panels.dialogs.frame_dialog import FrameDialog
from app.panels.dialogs.ground_dialog import GroundDialog
from app.panels.dialogs.keys_dialog import Keys
from app.panels.dialogs.merge_dialog import MergeDialog
from app.panels.dialogs.overtaken import OvertakenSave
from app.panels.dialogs.paper_choice import PaperChoice, PaperDialog
from app.panels.dialogs.preferences_dialog import PreferencesDialog
from app.panels.dialogs.select_dialogs import ChangeSelection, KeepSelection, KeptSelections
from app.panels.recovery.cards import Bin, Cards
from engine.numeric.address import Rect
from engine.numeric.arithmetic import COARSE, FINE
from engine.studio.land.wear_records import StopWearing
from engine.studio.requests import New

MOST_SIDE = 1 << 20
_SIZES = (("Screen", 1280, 800), ("Square", 1024, 1024), ("Wide", 1920, 1080), ("A4, 150 dpi", 1240, 1754))


class Dialog(Protocol):
    """A window that asks something, and stands until it is answered."""

    title: str

    def draw(self, desk: Desk) -> bool:
        """Draws the contents; False when it is done."""
        ...


class Dialogs:
    """Shows the dialog that was asked for, in the middle of the screen, above everything; one at a time."""

    def __init__(self) -> None:
        self._open: Dialog | None = None
        self._box = 0.0, 0.0, 0.0, 0.0

    @property
    def open(self) -> bool:
        """Tells whether one is on the screen."""
        return self._open is not None

    def leaves(self, x: float, y: float) -> bool:
        """Tells whether a place is the canvas's still: beside a dialog in a corner, so that one sees the picture."""
        if not getattr(self._open, "aside", False) or len(imgui.get_current_context().open_popup_stack) > 1:
            return False
        x0, y0, x1, y1 = self._box
        return not (x0 <= x < x1 and y0 <= y < y1)

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        if desk.asked.dialog and self._open is None and not desk.painting:
            self._open = DIALOGS[desk.asked.taken()](desk)
            imgui.open_popup("###dialog")
        dialog = self._open
        if dialog is None:
            return
        self._place(desk, dialog)
        imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(18 * desk.scale, 14 * desk.scale))
        imgui.push_style_var(imgui.StyleVar_.window_border_size, imgui.get_style().popup_border_size)
        flags = imgui.WindowFlags_.always_auto_resize | imgui.WindowFlags_.no_saved_settings
        if said.begin_popup_modal(f"{dialog.title}###dialog", flags):
            # Escape closes a list or a colour that the dialog has opened first.
            corner, size = imgui.get_window_pos(), imgui.get_window_size()
            self._box = corner.x, corner.y, corner.x + size.x, corner.y + size.y
            given_up, stays = imgui.is_key_pressed(imgui.Key.escape) and not _closed_inner(), dialog.draw(desk)
            if given_up:
                desk.asked.give_up()
                desk.asked.go_back()
            if given_up or not stays:
                imgui.close_current_popup()
                self._open = None
            imgui.end_popup()
        else:
            self._open = None
        imgui.pop_style_var(2)
        imgui.pop_style_color()
        if self._open is None:
            desk.asked.shown = ""
            desk.adjusting.leave(desk.post)
            desk.trial.leave()
            if desk.known.wearing is not None:
                desk.post(StopWearing())

    def _place(self, desk: Desk, dialog: Dialog) -> None:
        """In the middle, over a dimmed picture; in a corner over the picture as it is, where that is to be seen."""
        aside = getattr(dialog, "aside", False)
        left, top = desk.free_area()[:2]
        corner = ImVec2(left + 10 * desk.scale, top + 10 * desk.scale)
        at = corner if aside else ImVec2(desk.view.width / 2, desk.view.height / 2)
        imgui.set_next_window_pos(at, imgui.Cond_.always, ImVec2(0, 0) if aside else ImVec2(0.5, 0.5))
        dim = imgui.get_style().color_(imgui.Col_.modal_window_dim_bg)
        shade = ImVec4(dim.x, dim.y, dim.z, 0.0 if aside else dim.w)
        imgui.push_style_color(imgui.Col_.modal_window_dim_bg, shade)


def _closed_inner() -> bool:
    """Closes what the dialog that is drawn has opened; tells whether there was such a thing."""
    context = imgui.get_current_context()
    own = len(context.begin_popup_stack)
    if len(context.open_popup_stack) <= own:
        return False
    imgui.internal.close_popup_to_level(own, True)
    return True


class NewPainting:
    """Asks how large a new painting is to be, and on what it is painted."""

    title = "New painting"

    def __init__(self) -> None:
        self._width, self._height = 1280, 800
        self._small = False
        self._paper = PaperChoice("#ffffff")

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window."""
        column = imgui.get_font_size() * 10
        for i, (name, width, height) in enumerate(_SIZES):
            if i % 2:
                imgui.same_line()
            if w.lines_button((name, f"{width} × {height}"), "Use this size", column):
                self._width, self._height = width, height
        imgui.spacing()
        hint = "Of the frame, in pixels of level 0; you can paint outside it and inside every pixel"
        self._width = _side("Width", self._width, hint, column)
        imgui.same_line()
        self._height = _side("Height", self._height, "Of the frame, in pixels of level 0", column)
        self._paper.draw(column)
        good = 1 <= self._width <= MOST_SIDE and 1 <= self._height <= MOST_SIDE
        hint = "Colours of 12 bits in place of 16, for good: enough to paint and print; not for relief or height maps"
        _, self._small = w.tick("Smaller files", self._small, hint)
        imgui.spacing()
        if w.default_button("Start", "Start the new painting", enabled=good, width=column):
            frame, grid = Rect(0, 0, self._width, self._height), COARSE if self._small else FINE
            desk.post(New(frame, grid=grid, paper=self._paper.colour))
            return False
        imgui.same_line()
        return not w.text_button("Cancel", "Go back", width=column)


def _side(name: str, value: int, hint: str, width: float) -> int:
    """Draws a field for pixels after its name, `width` wide together; gives what stands in it now."""
    left = imgui.get_cursor_pos_x()
    imgui.align_text_to_frame_padding()
    said.text_unformatted(name)
    imgui.same_line(left + 3.4 * imgui.get_font_size())
    imgui.set_next_item_width(left + width - imgui.get_cursor_pos_x())
    value = imgui.input_int(f"##{name}", value, 0)[1]
    w.named(name)
    w.tooltip(hint)
    return value


class Unsaved:
    """Asks what is to become of changes before something replaces the painting."""

    title = "Unsaved changes"

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window."""
        then, going = desk.asked.then, False
        changed = desk.known.modified or desk.behind()
        if then is not None and not changed:  # nothing was, or it is saved by now
            desk.asked.go_on()
            return False
        name, writing = desk.known.path.name if desk.known.path else "This painting", desk.known.writing
        grown = f", growing {writing.grown * 100:.0f} %" if writing.grown < 1.0 else ""
        told = f"is still being saved{grown}." if writing.saving else "has changes that are not saved."
        said.text_unformatted(f"{say(name)} {say(told)}")
        if desk.asked.why:
            said.text_unformatted(desk.asked.why)
        imgui.spacing()
        em = imgui.get_font_size()
        if writing.saving:
            if w.default_button("Wait", "Go on as soon as it is saved", width=em * 7) and then is not None:
                desk.asked.after_save, going = (lambda: desk.guard(then)), True
        elif w.default_button("Save", "Save, then go on", width=em * 7):
            desk.asked.after_save, going = then, True
            desk.save()
        imgui.same_line()
        if w.text_button("Don’t save", "Go on; the changes are lost", width=em * 7):
            going = True
            desk.asked.go_on()
        imgui.same_line()
        back = w.text_button("Cancel", "Go back to the painting", width=em * 7)
        if back:
            desk.asked.go_back()
        return not (back or going)


class About:
    """Says what the program is."""

    title = "About Inkfall"

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window."""
        em = imgui.get_font_size()
        imgui.push_text_wrap_pos(em * 28)
        said.text_unformatted(
            "Inkfall is a paint program without a bottom: paint is a bandpass pyramid, and textured ink keeps showing "
            "new detail as you zoom in.\n\nAfter “Live Paint: Painting with Procedural Multiscale Textures” "
            "(Perlin & Velho, 1995). MIT licence."
        )
        imgui.pop_text_wrap_pos()
        imgui.spacing()
        return not w.default_button("Close", "Close", width=em * 7)


def _overtaken(desk: Desk) -> Dialog:
    assert desk.asked.overtaken is not None
    return OvertakenSave(desk.asked.overtaken)


def _earlier(desk: Desk) -> Dialog:
    assert desk.known.path is not None
    return EarlierVersions(desk.known.path)


DIALOGS: dict[str, Callable[[Desk], Dialog]] = {
    "new": lambda desk: NewPainting(),
    "open": file_browser.opening,
    "save as": file_browser.saving,
    "export": ExportDialog,
    "export to": file_browser.exporting,
    "film": lambda desk: FilmDialog(),
    "select_change": lambda desk: ChangeSelection(),
    "select_keep": lambda desk: KeepSelection(),
    "select_kept": lambda desk: KeptSelections(),
    "film to": file_browser.filming,
    "filming": lambda desk: FilmBeingMade(),
    "texture picture": file_browser.choosing_texture,
    "lab picture": file_browser.choosing_spectrum,
    "match picture 0": file_browser.choosing_example(0),
    "match picture 1": file_browser.choosing_example(1),
    "example picture": file_browser.choosing_own,
    "texture text": file_browser.choosing_text,
    "texture text to": file_browser.writing_text,
    "solid mesh": file_browser.choosing_mesh,
    "solid cube": file_browser.choosing_cube,
    "drawn cube": file_browser.choosing_drawn_cube,
    "wrapped picture": file_browser.choosing_wrapped,
    "bring from": file_browser.choosing_to_bring,
    "bring in": BringIn,
    "texture doctor": DoctorDialog,
    "palette from": file_browser.choosing_palette,
    "palette of picture": file_browser.choosing_palette_picture,
    "palette to": file_browser.writing_palette,
    "share brush": file_browser.sharing_brush,
    "brush from": file_browser.choosing_brush,
    "unsaved": lambda desk: Unsaved(),
    "overtaken": _overtaken,
    "earlier": _earlier,
    "frame": lambda desk: FrameDialog(desk.known.frame),
    "ground": GroundDialog,
    "erode": lambda desk: ErodeDialog(),
    "paper": lambda desk: PaperDialog(desk.known.paper),
    "merge": lambda desk: MergeDialog(),
    "bake": lambda desk: BakeDialog(),
    "adjust": lambda desk: AdjustDialog(),
    "unclosed": Cards,
    "bin": Bin,
    "preferences": PreferencesDialog,
    "workspaces": lambda desk: WorkspacesDialog(),
    "screen profile": file_browser.choosing_profile("profile"),
    "proof profile": file_browser.choosing_profile("proof"),
    "keys": Keys,
    "keys from": file_browser.choosing_keys,
    "keys to": file_browser.writing_keys,
    "about": lambda desk: About(),
}
