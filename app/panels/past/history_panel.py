"""The history: every step with a small picture, and what was painted at a place."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.actions.actions import ACTIONS, perform
from app.desk.desk import Desk
from app.desk.guides import symmetry
from app.panels.controls import widgets as w
from app.panels.panel import Panel
from app.panels.past.film_strip import FilmStrip
from app.panels.past.here_list import HereList
from engine.studio.past.past_records import AskHere, Here, PastScene, ShowPast
from engine.studio.results import Scene

_LISTS = (
    ("steps", "Steps", "Every step, strokes of one brush together"),
    ("here", "Painted here", "The strokes that show at a place"),
)

_LISTS_WIDE, _WAYS_WIDE = 14.0, 17.0  # ems


class HistoryPanel(Panel):
    """Draws the strip; the engine is asked for the pictures in sight."""

    def __init__(self) -> None:
        self._film, self._here = FilmStrip(), HereList()
        self._asked: tuple[int, ...] | None = None  # pictures; None: the engine tells nothing
        self._serial = 0  # of the painting whose past it shows
        self.hears = {PastScene: self._heard, Here: self._found, Scene: self._painting}

    def hint(self, desk: Desk) -> str:
        """Says what is looked at."""
        past, count = desk.past, len(desk.past.scene.steps)
        if past.looking is not None:
            return f"As it was after step {past.looking} of {count}"
        if past.listing == "here":
            place = past.here.place if past.here else None
            return "" if place is None else f"At {_short(place[1])}, {_short(place[2])} of level {place[0]}"
        return f"Step {past.scene.done} of {count}"

    def bar(self, desk: Desk) -> None:
        """Draws the two lists to choose from at the right end, and left of them the ways back."""
        past, ems = desk.past, imgui.get_font_size()
        gap = imgui.get_style().item_spacing.x
        right = imgui.get_window_width() - imgui.get_frame_height() - imgui.get_style().window_padding.x - 2 * gap
        if past.scene.playing is not None:
            imgui.same_line(right - _LISTS_WIDE * ems - gap - _WAYS_WIDE * ems)
            self._way(desk, past.scene.playing)
        elif past.looking is not None:
            imgui.same_line(right - _LISTS_WIDE * ems - gap - _WAYS_WIDE * ems)
            self._ways_back(desk, past.looking)
        imgui.same_line(right - _LISTS_WIDE * ems)
        chosen = w.segments("history", past.listing, _LISTS, _LISTS_WIDE * ems)
        if chosen is not None:
            past.listing, past.asking = chosen, chosen == "here"

    def _way(self, desk: Desk, part: float) -> None:
        """Draws how far the painting is played anew, and what gives it up."""
        wide = _WAYS_WIDE * imgui.get_font_size() - imgui.get_frame_height() - imgui.get_style().item_spacing.x
        imgui.progress_bar(part, ImVec2(wide, 0), f"{part:.0%}")
        w.tooltip("The painting is played anew up to that step")
        imgui.same_line()
        if w.icon_button("stop", icons.CLOSE, "Stay where you are"):
            desk.past.stop(desk.post)

    def _ways_back(self, desk: Desk, looking: int) -> None:
        wide = (_WAYS_WIDE * imgui.get_font_size() - imgui.get_style().item_spacing.x) / 2
        imgui.push_style_color(imgui.Col_.text, theme.vec(theme.look.warn))
        back = w.text_button("Back to now", ACTIONS["now"].hint, width=wide)
        imgui.pop_style_color()
        if back:
            perform(desk, ACTIONS["now"])
        imgui.same_line()
        if w.text_button("Go on from here", "Undo what came after; it can be done again", width=wide):
            symmetry.keep(desk)
            desk.past.jump(desk.post, looking)

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        if desk.past.listing == "here":
            self._here.draw(desk)
        else:
            self._film.draw(desk)

    def wants(self, desk: Desk, now: float) -> None:
        """Asks for the pictures in sight."""
        seen = self._here.pictures if desk.past.listing == "here" else self._film.pictures
        wanted = tuple(dict.fromkeys(seen))
        if wanted != self._asked:
            self._asked = wanted
            desk.post(ShowPast(True, wanted))

    def closed(self, desk: Desk) -> None:
        """The painting is seen as it is again."""
        if self._asked is not None:
            self._asked = None
            desk.post(ShowPast(False))
        if desk.past.looking is not None:
            desk.past.look(desk.post, None)
        desk.past.asking = False

    def _painting(self, desk: Desk, scene: Scene, _now: float) -> None:
        """Forgets the strokes of a place of another painting."""
        if scene.serial != self._serial:
            self._serial, desk.past.here, desk.past.opened = scene.serial, None, None

    def _heard(self, desk: Desk, scene: PastScene, _now: float) -> None:
        before, desk.past.scene = desk.past.scene, scene
        if desk.past.here is not None and (before.done, before.steps) != (scene.done, scene.steps):
            desk.post(AskHere(*desk.past.here.place))  # others may show there now

    def _found(self, desk: Desk, here: Here, _now: float) -> None:
        desk.past.take(here)


def _short(place: int) -> str:
    """Returns a number as it fits into a line."""
    text = f"{place:,}"
    return text if len(text) <= 16 else f"{text[:6]}…{text[-6:]}"
