"""Numbers of the active layer: how opaque it is and, where it is the land's height, how high and how wet that is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from imgui_bundle import ImVec2, imgui

from app.desk.desk import Desk
from app.panels.controls import widgets as w
from engine.painting import commands as c
from engine.studio.requests import Do
from engine.studio.results import LayerRow

_PART = 6  # of the frame's width: how high white lies if nothing is said
_LEAST, _MOST = 1.0, 1000.0  # pixels of height, unless the frame is wider


@dataclass(frozen=True)
class LayerNumber:
    """A number of a layer: how a slider shows it, and what sets it."""

    label: str
    hint: str
    ends: tuple[float, float]
    form: str
    told: Callable[[str, float], c.SetLayer]
    curved: bool = False


class LayerSlider:
    """A slider that sets a layer's number when it is let go, so that a drag is one step to undo."""

    def __init__(self) -> None:
        self._dragged: tuple[str, float] | None = None

    def draw(self, desk: Desk, row: LayerRow | None, value: float, number: LayerNumber) -> None:
        """Draws it into the present window."""
        if self._dragged and row and self._dragged[0] == row.name:
            value = self._dragged[1]
        changed, value = w.slider(number.label, value, number.ends, number.hint, form=number.form, curved=number.curved)
        if changed and row:
            self._dragged = row.name, value
        if self._dragged and not imgui.is_item_active():
            told, self._dragged = number.told(*self._dragged), None
            desk.post(Do(told))


class LayerSliders:
    """The sliders of the active layer."""

    def __init__(self) -> None:
        self._opacity, self._scale, self._sea = LayerSlider(), LayerSlider(), LayerSlider()

    def draw_opacity(self, desk: Desk, row: LayerRow | None) -> None:
        """Draws how opaque it is into what is left of the present line."""
        imgui.push_style_var(imgui.StyleVar_.cell_padding, ImVec2(0, 0))
        imgui.begin_child("opacity", ImVec2(0, imgui.get_frame_height()))
        self._opacity.draw(desk, row, row.opacity * 100 if row else 100.0, _OPACITY)
        imgui.end_child()
        imgui.pop_style_var()

    def draw_land(self, desk: Desk, row: LayerRow | None) -> None:
        """Draws how high and how wet it is, where it is the land's height."""
        if row is None or not row.height or row.group or row.shows is not None:
            return
        wide = float(desk.known.frame.width)
        scale = wide / _PART if row.scale is None else row.scale
        most = LayerNumber("Height##layer", _HIGH, (_LEAST, max(_MOST, wide)), "%.0f px", _with_scale, curved=True)
        self._scale.draw(desk, row, scale, most)
        self._sea.draw(desk, row, row.sea or 0.0, _WATER)


def _with_scale(name: str, value: float) -> c.SetLayer:
    return c.SetLayer(name, scale=round(max(value, _LEAST), 1))


_OPACITY = LayerNumber(
    "Opacity##layer",
    "How opaque the layer is",
    (0.0, 100.0),
    "%.0f%%",
    lambda name, value: c.SetLayer(name, opacity=round(value / 100, 4)),
)
_HIGH = "How high white lies above black, in pixels of the painting"
_WATER = LayerNumber(
    "Water##layer",
    "The brightness up to which the land lies under water: 0 is dry",
    (0.0, 1.0),
    "%.2f",
    lambda name, value: c.SetLayer(name, sea=round(value, 3)),
)
