"""The symmetry of strokes in the brush panel: which, how many parts, and where its axis lies."""

from __future__ import annotations

from imgui_bundle import imgui

from app.actions import actions
from app.desk.desk import Desk
from app.desk.guides import symmetry
from app.panels.controls import widgets as w

_MOVE = "Drag the axis: its middle moves it, its end turns it"


class SymmetrySection:
    """`_count`: the parts while their slider is dragged."""

    def __init__(self) -> None:
        self._count: int | None = None

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        guide = symmetry.guide_of(desk)
        way = symmetry.way_of(guide)
        options = [(name, row.title) for name, row in symmetry.WAYS.items()]
        width, hints = imgui.get_content_region_avail().x, [row.hint for row in symmetry.WAYS.values()]
        picked = w.choice("Symmetry", way, options, "Strokes are painted several times in one step", width, hints)
        if picked is not None:
            symmetry.choose(desk, picked)
        if guide is None or way == "off":
            return
        if symmetry.WAYS[way].counts:
            self._parts(desk, guide.count)
        spacing = imgui.get_style().item_spacing.x
        half = (width - spacing) / 2
        if w.lit_button("Move axis", _MOVE, desk.hand.tool == "guides", half):
            actions.perform(desk, actions.ACTIONS["guides"])
        imgui.same_line(0, spacing)
        if w.lit_button("Bring here", actions.tip("symmetry_here"), False, half):
            actions.perform(desk, actions.ACTIONS["symmetry_here"])

    def _parts(self, desk: Desk, count: int) -> None:
        """The slider of the parts; one step when it is let go."""
        shown = count if self._count is None else self._count
        changed, parts = w.slider("Parts", shown, (2, symmetry.MOST_PARTS), "Parts of a full turn", form="%.0f")
        if changed:
            self._count = round(parts)
        if self._count is not None and not imgui.is_item_active():
            symmetry.set_count(desk, self._count)
            self._count = None
