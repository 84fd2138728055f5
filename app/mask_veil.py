"""The quick mask over the canvas: a tint where nothing is selected."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import theme
from app.canvas.gallery import Gallery
from app.canvas.view import place_of_pixel
from app.desk.desk import Desk
from engine.studio.selecting.tint_records import Tint

_NAME = "quick mask"


def hang(desk: Desk, gallery: Gallery, tint: Tint) -> None:
    """Takes over what the engine tells of the mask."""
    known = desk.selecting.tint
    whole = (tint.part.width, tint.part.height) == (tint.area.width, tint.area.height)
    if not whole and (known is None or (known.level, known.area) != (tint.level, tint.area)):
        return  # a part of what is not shown any more
    gallery.veil(_NAME, (tint.area.width, tint.area.height), tint.part, tint.alpha)
    desk.selecting.tint = tint


def draw_veil(desk: Desk) -> None:
    """Draws the tint while the mask is painted on."""
    state, shown = desk.selecting, desk.pictures.get(_NAME)
    if not state.masking or state.tint is None or shown is None:
        return
    r = state.tint.area
    places = ((r.x0, r.y0), (r.x1, r.y0), (r.x1, r.y1), (r.x0, r.y1))
    a, b, c, d = (ImVec2(*desk.view.to_screen(place_of_pixel(state.tint.level, x, y))) for x, y in places)
    ends = ImVec2(0, 0), ImVec2(1, 0), ImVec2(1, 1), ImVec2(0, 1)
    colour = theme.packed(state.mask_colour, state.mask_part)
    imgui.get_background_draw_list().add_image_quad(shown, a, b, c, d, *ends, colour)
