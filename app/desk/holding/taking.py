"""Choosing a brush from among the presets."""

from __future__ import annotations

from app.desk import palette
from app.desk.desk import Desk
from app.desk.examples import example_use
from app.desk.hand import go_on_with_brush
from app.desk.presets import Preset


def take_preset(desk: Desk, preset: Preset, keep_size: bool = False) -> None:
    """Paints with a brush from now on, in the colour that is there, unless it is about its own; one that lays no paint
    has the size that it had."""
    go_on_with_brush(desk.hand)
    radius = desk.hand.brush.radius
    palette.take(desk, preset)
    example_use.adopt(desk)
    if preset.coloured:
        desk.hand.colour = preset.brush.rgb
    desk.hand.change(radius=radius if keep_size else desk.hand.sizes.of(preset.name, desk.hand.brush))
