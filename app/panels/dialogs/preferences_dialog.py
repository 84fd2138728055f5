"""The preferences: pen, display, memory and files.  What can be is in force at once."""

from __future__ import annotations

from pathlib import Path

from imgui_bundle import ImVec2, imgui

from app import theme
from app.actions.actions import keyed
from app.desk.desk import Desk
from app.desk.preferring.pen_trial import PenTrail
from app.desk.preferring.preferring import keep_preferences, prefer
from app.desk.proofing.proof_work import BY_NONE, BY_SYSTEM
from app.language import said
from app.language.words import known_languages
from app.panels.controls import widgets as w
from app.panels.controls.curve_editor import CurveEditor
from app.panels.pens.pen_tester import draw_tester
from app.theme.looks import LOOKS
from engine.keeping.preferences import Preferences, preferences_file

_WIDE, _TALL = 30.0, 22.0  # ems of the page
_PAGES = (
    ("pen", "Pen", "How pens are felt, with a place to try it"),
    ("tester", "Tester", "What the pen tells: pressure, tilt, buttons, how often and how evenly"),
    ("display", "Display", "Colours of the window, and how large all beside the canvas is"),
    ("memory", "Memory", "What paintings may take"),
    ("files", "Files", "Earlier versions and the bin"),
)
_ROOM = 900, 560  # points of a window that panels and dialogs want
_PERCENTS = (75, 100, 125, 150, 175, 200, 250, 300)
_FILE = "file"  # in a list of profiles, that another one is asked for
_MEMBERS = {"screen profile": "profile", "proof profile": "proof"}  # of the preferences
_LATER = "From the next start on"


class PreferencesDialog:
    """Changes them; Escape and Close keep what was changed, Reset has a page as it comes."""

    title = "Preferences"

    def __init__(self, desk: Desk) -> None:
        self._page, self._trail = "pen", PenTrail()
        self._curve = CurveEditor(smooth=False)
        self._curve.by_hand = False

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window; False when it is done."""
        em = imgui.get_font_size()
        chosen = w.segments("page", self._page, _PAGES, _WIDE * em)
        self._page = chosen or self._page
        imgui.spacing()
        tall = min(_TALL * em, imgui.get_main_viewport().work_size.y - 9 * em)
        imgui.begin_child("page", ImVec2(_WIDE * em, tall))
        if self._page not in ("pen", "tester"):
            desk.trial.leave()
        pages = {"pen": self._pen, "tester": draw_tester, "display": _display, "memory": _memory, "files": _files}
        pages[self._page](desk)
        imgui.end_child()
        if not imgui.is_mouse_down(imgui.MouseButton_.left):
            keep_preferences(desk, desk.preferred.now)
        closes = w.default_button("Close", "All of it is kept", width=em * 7)
        imgui.same_line()
        if _OF_PAGES.get(self._page) and w.text_button("Reset this page", "As they come", width=em * 9):
            usual = Preferences()
            prefer(desk, **{name: getattr(usual, name) for name in _OF_PAGES[self._page]})
        return not closes and desk.asked.dialog not in _MEMBERS

    def _pen(self, desk: Desk) -> None:
        now = desk.preferred.now
        imgui.begin_disabled(bool(now.constant))
        hint = "What the pressure of every pen becomes, before brushes follow it"
        changed, curve = self._curve.row("Pressure", now.curve or None, (), hint)
        imgui.end_disabled()
        if changed:
            prefer(desk, curve=curve if isinstance(curve, tuple) else ())
        hint = "Each pen paints with this pressure, however hard it is pressed"
        changed, on = w.tick("Constant pressure", bool(now.constant), hint)
        if changed:
            prefer(desk, constant=1.0 if on else 0.0)
        if now.constant:
            changed, value = w.slider("How hard", now.constant, (0.05, 1.0), hint)
            if changed:
                prefer(desk, constant=value)
        hint = "Fingers on the screen or the tablet do nothing, as far as the system tells them from pens"
        changed, on = w.tick("Ignore touch", now.ignore_touch, hint)
        if changed:
            prefer(desk, ignore_touch=on)
        imgui.spacing()
        self._test(desk)

    def _test(self, desk: Desk) -> None:
        """Draws an area in which a pen leaves discs as wide as its pressure is felt."""
        em, at = imgui.get_font_size(), desk.pointer
        felt = f"Pressed {at.pressed:.2f}, felt {at.pressure:.2f}"
        told = felt if at.pen else "No pen has come yet: a mouse presses 1"
        said.text_disabled(f"Try it here.  {told}")
        corner, size = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail()
        imgui.invisible_button("test area", size)
        w.named("test area")
        w.tooltip("Draw with the pen: discs are as wide as the pressure is felt")
        desk.trial.on = True
        self._trail.follow(desk.trial.reports, (corner.x, corner.y, size.x, size.y))
        if imgui.is_item_active() and not at.pen:
            self._trail.lay(at.x - corner.x, at.y - corner.y, 1.0, begins=imgui.is_item_activated())
        painter, end = imgui.get_window_draw_list(), ImVec2(corner.x + size.x, corner.y + size.y)
        painter.add_rect_filled(corner, end, theme.packed((0.9,) * 3), imgui.get_style().frame_rounding)
        painter.push_clip_rect(corner, end, True)
        for dot in self._trail.dots:
            place = ImVec2(corner.x + dot.x, corner.y + dot.y)
            painter.add_circle_filled(place, max(0.5, dot.pressure * em), theme.packed((0.15,) * 3), 24)
        painter.pop_clip_rect()


_OF_PAGES = {
    "pen": ("curve", "constant", "ignore_touch"),
    "tester": ("driver",),
    "display": ("look", "scale", "font_size", "profile", "proof", "language"),
    "memory": ("megabytes",),
    "files": ("versions", "gigabytes", "part_of_free"),
}


def _display(desk: Desk) -> None:
    now = desk.preferred.now
    said.text_disabled("Colours of the window")
    looks = [(name, look.title, look.hint) for name, look in LOOKS.items()]
    chosen = w.segments("look", now.look, looks)
    if chosen:
        prefer(desk, look=chosen)
    imgui.spacing()
    em, hint = imgui.get_font_size(), "Of panels, buttons and texts, in that of the screen"
    hint += "; larger ones than this window has room for are left out"
    said.text_disabled("Size of all beside the canvas")
    room = min(desk.view.width / _ROOM[0], desk.view.height / _ROOM[1]) * now.scale / desk.scale  # in which all fits
    fitting = [percent for percent in _PERCENTS if percent <= max(100.0, 100 * room)]
    sizes = [(f"{percent}", f"{percent} %") for percent in fitting]
    picked = w.choice("scale", f"{now.scale * 100:.0f}", sizes, hint, 9 * em)
    if picked:
        prefer(desk, scale=int(picked) / 100)
    imgui.spacing()
    said.text_disabled("Size of texts")
    points = [(f"{size}", f"{size} points") for size in range(12, 21)]
    picked = w.choice("points", f"{now.font_size:.0f}", points, "Of the font; panels widen as it grows", 9 * em)
    if picked:
        prefer(desk, font_size=float(picked))
    imgui.spacing()
    said.text_disabled("Colours of the screen")
    hint = "By which the window is shown; the painting and what is exported stay sRGB"
    usual = ((BY_SYSTEM, "The system’s profile"), (BY_NONE, "Sent as they are"))
    _profile(desk, "screen profile", now.profile, usual, hint)
    imgui.spacing()
    said.text_disabled("Soft proof")
    told = keyed("What View > Soft proof imitates", "soft_proof")
    _profile(desk, "proof profile", now.proof, (("", "Nothing"),), told)
    _language(desk)


def _language(desk: Desk) -> None:
    imgui.spacing()
    said.text_disabled("Language")
    now = desk.preferred.now
    languages = (("", "That of the system"), *known_languages().items())
    picked = w.choice("language", now.language, languages, "Of menus, panels and hints", 14 * imgui.get_font_size())
    if picked is not None:
        prefer(desk, language=picked)


def _profile(desk: Desk, name: str, chosen: str, usual: tuple[tuple[str, str], ...], hint: str) -> None:
    """Draws the choice of a profile: one of the usual ones, or a file that a dialog asks for."""
    own = () if chosen in dict(usual) else ((chosen, Path(chosen).name),)
    picked = w.choice(name, chosen, (*usual, *own, (_FILE, "A file…")), hint, 14 * imgui.get_font_size())
    if picked == _FILE:
        desk.asked.show(name)
    elif picked is not None:
        prefer(desk, **{_MEMBERS[name]: picked})


def _memory(desk: Desk) -> None:
    now = desk.preferred.now
    hint = "What paintings may take, undo and all; what is more goes to the disk"
    changed, own = w.tick(
        "As fits this machine", not now.megabytes, f"A quarter of its memory, at most 4 GB.  {_LATER}"
    )
    if changed:
        prefer(desk, megabytes=0 if own else 2048)
    if now.megabytes:
        changed, value = w.slider(
            "Memory", now.megabytes, (64.0, 65536.0), f"{hint}.  {_LATER}", form="%.0f MB", curved=True
        )
        if changed:
            prefer(desk, megabytes=round(value))
    said.text_disabled(_LATER)


def _files(desk: Desk) -> None:
    now = desk.preferred.now
    said.text_disabled("What a save replaces is kept")
    hint = "How many earlier versions of each file are kept (File > Earlier versions)"
    changed, count = w.stepper("Versions", now.versions, (1, 100), hint)
    if changed:
        prefer(desk, versions=count)
    hint = "All earlier versions and the bin take no more than this together"
    changed, value = w.slider("At most", now.gigabytes, (0.1, 500.0), hint, form="%.1f GB", curved=True)
    if changed:
        prefer(desk, gigabytes=round(value, 1))
    hint = "And no more than this part of what is free on the disk"
    changed, value = w.slider("Of the free disk", now.part_of_free * 100, (1.0, 100.0), hint, form="%.0f %%")
    if changed:
        prefer(desk, part_of_free=round(value) / 100)
    said.text_disabled(_LATER)
    imgui.spacing()
    imgui.push_text_wrap_pos(0)
    said.text_disabled(f"All preferences lie in {preferences_file()}")
    imgui.pop_text_wrap_pos()
