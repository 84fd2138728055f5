"""The windows about films: how it was made, a flight, or both, with a picture of it and how long it is; and what is to
become of the one that is being made."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.desk.asked import FILM_SIZES, film_wish, fitted_frame
from app.desk.desk import Desk
from app.desk.places import going
from app.language import said
from app.language.words import say
from app.panels.controls import widgets as w
from engine.studio.filing.film_requests import FilmWish, PreviewFilm, StopFilm

_WIDE, _TALL = 25.0, 14.0  # ems: the room for the picture
_KINDS = (
    ("replay", "How it was made", "The painting is made again, stroke by stroke"),
    ("flight", "Flight", "Fly through the painting as it is"),
    ("both", "Both", "Fly through it while it is being made"),
)
_FPS = tuple((str(n), str(n), f"{n} frames a second") for n in (24, 30, 60))
_MOST_SECONDS = 600


class FilmDialog:
    """Asks for a film; then where it goes."""

    title = "Film"

    def __init__(self) -> None:
        self._asked: tuple[FilmWish, float] | None = None

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window; False when it is done."""
        em, film = imgui.get_font_size(), desk.asked.film
        self._preview(desk, em)
        picked = w.segments("kind", film.kind, _KINDS, em * _WIDE)
        film.kind = picked or film.kind
        self._where(desk, em)
        self._size(desk, em)
        self._pace(desk, em)
        replays = film.kind != "flight"
        imgui.begin_disabled(not replays)
        _, film.brush = w.tick("Brush", film.brush, "Show a ring where the brush is")
        imgui.same_line(0, em)
        _, film.undone = w.tick("What was undone", film.undone, "Show what was taken back, and how it is")
        imgui.same_line(0, em)
        _, film.by_clock = w.tick("By the clock", film.by_clock, "As fast as it was painted; else all strokes alike")
        imgui.end_disabled()
        length = desk.known.film_length
        fault = length.fault if replays else ""
        long = f"{length.seconds:.3g} s, {length.frames:,} frames" if length.frames else f"{icons.WAIT} counting…"
        told = fault or long
        imgui.push_text_wrap_pos(em * (_WIDE + 1))
        said.text_colored(theme.vec(theme.look.warn if fault else theme.look.quiet), told)
        imgui.pop_text_wrap_pos()
        imgui.spacing()
        chosen = w.default_button("Choose file…", "Choose where to write it", enabled=not fault, width=em * 8)
        if chosen:
            desk.asked.show("film to")
        imgui.same_line()
        return not (w.text_button("Cancel", "Go back", width=em * 7) or chosen)

    def _preview(self, desk: Desk, em: float) -> None:
        """Draws a picture of the film, and what chooses of which part."""
        film = desk.asked.film
        here = going.here(desk).bookmark("", going.free_size(desk))
        wish = film.wished = film_wish(film, desk.known, here)
        if (wish, film.at) != self._asked:
            self._asked = wish, film.at
            desk.post(PreviewFilm(wish, film.at))
        scale = min(_WIDE * em / wish.size[0], _TALL * em / wish.size[1])
        width, height = wish.size[0] * scale, wish.size[1] * scale
        left, top = imgui.get_cursor_pos_x(), imgui.get_cursor_pos_y()
        imgui.set_cursor_pos(ImVec2(left + (_WIDE * em - width) / 2, top + (_TALL * em - height) / 2))
        hint = "What the film shows there, with all that is painted now"
        w.picture(desk.pictures.get("film"), (width, height), hint, name="film picture")
        imgui.set_cursor_pos(ImVec2(left, top + _TALL * em + imgui.get_style().item_spacing.y))
        imgui.dummy(ImVec2(0, 0))
        imgui.begin_disabled(len(wish.places) < 2)
        imgui.set_next_item_width(_WIDE * em)
        clamped = imgui.SliderFlags_.always_clamp
        changed, part = imgui.slider_float("##moment", film.at * 100, 0.0, 100.0, "%.0f %%", clamped)
        w.named("moment")
        w.tooltip("How far into the film this picture is")
        film.at = part / 100 if changed else film.at
        imgui.end_disabled()

    def _where(self, desk: Desk, em: float) -> None:
        """Draws what is seen, or where it flies."""
        film = desk.asked.film
        _label("Shows" if film.kind == "replay" else "Flies", em)
        if film.kind == "replay":
            rows = (("frame", "the whole frame"), ("view", "what is in view now"))
            picked = w.choice("where", "view" if film.close else "frame", rows, "What the film shows", em * 14)
            film.close = film.close if picked is None else picked == "view"
            return
        scene = desk.known.scene
        rows = (("view", "from the frame to what is in view now"), ("marks", "from the frame through the bookmarks"))
        some = scene is not None and len(scene.bookmarks) > 0
        current = "marks" if film.marks and some else "view"
        picked = w.choice("where", current, rows if some else rows[:1], "Where the film looks", em * 18)
        film.marks = film.marks if picked is None else picked == "marks"

    def _size(self, desk: Desk, em: float) -> None:
        film, frame = desk.asked.film, desk.known.frame
        own = fitted_frame(frame.width, frame.height)
        rows = [("", f"{own[0]} × {own[1]}, as the frame")]
        rows += [(f"{width}x{height}", f"{width} × {height}") for width, height in FILM_SIZES]
        current = "" if film.size is None else f"{film.size[0]}x{film.size[1]}"
        _label("Size", em)
        picked = w.choice("size", current, rows, "Width and height of the film, in pixels", em * 14)
        if picked is not None:
            film.size = next((size for size in FILM_SIZES if f"{size[0]}x{size[1]}" == picked), None)

    def _pace(self, desk: Desk, em: float) -> None:
        film = desk.asked.film
        _label("Takes", em)
        imgui.set_next_item_width(em * 11)
        text = "as long as needed" if film.seconds == 0 else "%d s"
        _, film.seconds = imgui.slider_int(
            "##seconds",
            film.seconds,
            0,
            _MOST_SECONDS,
            say(text),
            imgui.SliderFlags_.always_clamp | imgui.SliderFlags_.logarithmic,
        )
        w.named("seconds")
        w.tooltip("How long the film is; at the left end, as long as it needs")
        imgui.same_line()
        film.fps = int(w.segments("fps", str(film.fps), _FPS, em * 7) or film.fps)


class FilmBeingMade:
    """Asks what is to become of the film that is being made before the window goes."""

    title = "A film is being made"

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window; False when it is answered, or the film is made, or could not be."""
        part = desk.known.filming
        if part is None:
            if not desk.notices.about("film"):
                desk.guard(desk.asked.close)
            return False
        em = imgui.get_font_size()
        said.text_unformatted(f"So far {part * 100:.0f} % of it is made.")
        said.text_disabled("You can go on painting until it is.")
        imgui.spacing()
        if w.default_button("Wait", "Close the window as soon as the film is made", width=em * 7):
            desk.asked.after_film = lambda: desk.guard(desk.asked.close)
            return False
        imgui.same_line()
        if w.text_button("Give it up", "Close the window now; no film is written", width=em * 7):
            desk.post(StopFilm())
            desk.guard(desk.asked.close)
            return False
        imgui.same_line()
        return not w.text_button("Cancel", "Go back to the painting; the film goes on", width=em * 7)


def _label(text: str, em: float) -> None:
    left = imgui.get_cursor_pos_x()
    imgui.align_text_to_frame_padding()
    said.text_unformatted(text)
    imgui.same_line(left + 3.6 * em)
