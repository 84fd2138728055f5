"""The window that adjusts colours of a layer, or of what is selected of it, seen while it is set."""

from __future__ import annotations

from imgui_bundle import imgui
from immutables import Map

from app.desk.colours import to_hex
from app.desk.desk import Desk
from app.desk.knots import STRAIGHT
from app.language import said
from app.panels.brush.operations import FORMULAS, Operations, op_hint
from app.panels.controls import widgets as w
from engine.brush.settings import Brush
from engine.numeric.address import Rect
from engine.studio.requests import SCREEN_TILE

# Those that are offered, in order, as they begin: what changes nothing yet, where there is such a thing.
_ADJUSTMENTS: dict[str, dict[str, object]] = {
    "tone": {"brightness": 0.0, "contrast": 1.0},
    "levels": {"black": 0.0, "white": 1.0, "gamma": 1.0},
    "curves": {"all": STRAIGHT},
    "recolour": {"turn": 0.0, "amount": 1.0, "light": 0.0},
    "invert": {},
    "posterise": {},
    "gradient": {},
    "smooth": {},
    "sharpen": {},
}
_GREY, _FORMULA, _BRUSH = "grey", "formula", "brush"  # besides those
_TITLES = {_GREY: "Desaturate", _FORMULA: "Formula", _BRUSH: "As the brush changes"}
_HINTS = {
    _GREY: "Leave the brightness alone",
    _FORMULA: "Write yourself what is added to each channel",
    _BRUSH: "Do what the brush in hand does",
}
_WIDE = 19  # ems


class AdjustDialog:
    """Remembers how each adjustment is set."""

    title = "Adjust"
    aside = True

    def __init__(self) -> None:
        self._chosen = next(iter(_ADJUSTMENTS))
        self._given: dict[str, Map[str, object]] = {name: Map(given) for name, given in _ADJUSTMENTS.items()}
        self._formula = FORMULAS[0][1]
        self._controls = Operations()

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window; False when it is done."""
        em, level = imgui.get_font_size(), desk.view.shown_level
        rows = {row.name: row for row in desk.known.tables.ops}
        options = [(name, rows[name].label) for name in _ADJUSTMENTS if name in rows] + list(_TITLES.items())
        hint = op_hint(rows[self._chosen]) if self._chosen in rows else _HINTS[self._chosen]
        self._chosen = w.choice("adjustment", self._chosen, options, hint, em * _WIDE) or self._chosen
        imgui.push_item_width(em * _WIDE)
        for parameter in rows[self._chosen].parameters if self._chosen in rows else ():
            given = self._given[self._chosen]
            self._given[self._chosen] = self._controls.parameter(desk, given, parameter)
        if self._chosen == _FORMULA:
            self._formula = self._controls.formula(self._formula)
        imgui.pop_item_width()
        said.text_disabled("Of what is selected" if desk.selecting.selected else "Of the whole layer")
        desk.adjusting.look(desk.post, self._brush(desk), level, _whole_tiles(desk.view.visible(level)))
        row, best = desk.known.active, desk.adjusting.best
        known = row is not None and best is not None and best.layer == row.name
        imgui.spacing()
        if w.default_button("Adjust", "Do it, as one step", enabled=known and not self._idle, width=em * 7):
            desk.adjusting.done(desk.post)
            return False
        imgui.same_line()
        return not w.text_button("Cancel", "Leave the layer as it is", width=em * 7)

    @property
    def _idle(self) -> bool:
        """Tells whether it is set so that it changes nothing."""
        begins = _ADJUSTMENTS.get(self._chosen, {})
        return len(begins) > 0 and self._given[self._chosen] == Map(begins)

    def _brush(self, desk: Desk) -> Brush:
        colour = to_hex(desk.hand.colour)
        if self._chosen == _BRUSH:
            held = desk.hand.dipped()
            return Brush(mode="raster", op=held.op, ink=held.ink, colour=held.colour)
        if self._chosen == _FORMULA:
            return Brush(mode="raster", op=Map({"formula": self._formula}), colour=colour)
        if self._chosen == _GREY:
            return Brush(mode="raster", op=Map({"name": "saturate", "amount": 0.0}), colour=colour)
        return Brush(mode="raster", op=self._given[self._chosen].set("name", self._chosen), colour=colour)


def _whole_tiles(seen: Rect) -> Rect:
    """Returns the tiles of the screen that meet what is seen, so that not each move of the view asks anew."""
    x0, y0 = seen.x0 // SCREEN_TILE * SCREEN_TILE, seen.y0 // SCREEN_TILE * SCREEN_TILE
    return Rect(x0, y0, -(-seen.x1 // SCREEN_TILE) * SCREEN_TILE, -(-seen.y1 // SCREEN_TILE) * SCREEN_TILE)
