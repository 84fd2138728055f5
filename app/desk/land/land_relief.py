"""What brushes lay on the layer of heights while the land is looked at: relief of the size that is seen there."""

from __future__ import annotations

from dataclasses import replace

from app.desk.desk import Desk
from engine.brush.settings import AUTO, Brush
from engine.light.light import BRIGHTNESS


def seen_brush(desk: Desk, brush: Brush) -> Brush:
    """Returns the brush of a stroke, magnified to its level, as the active layer takes it: by lightness a stroke deep
    in the land would be a canyon or a peak of many screens, since its heights are those of level 0."""
    row = desk.known.active
    if not desk.land.on or row is None or not row.height or desk.masks.on(row):
        return brush
    return in_relief(brush)


def in_relief(brush: Brush) -> Brush:
    """Returns a brush that paints by lightness as one that heaps: white a quarter of its radius up, black as much down,
    a middle grey nothing.  One that has heights of its own, and what lays no paint, stay as they are."""
    if brush.height is not None or not brush.row.lays_ink:
        return brush
    most = replace(brush, height=AUTO).heaps
    assert most is not None
    bright = sum(weight * part for weight, part in zip(BRIGHTNESS, brush.rgb, strict=True))
    return replace(brush, height=(2.0 * bright - 1.0) * most)
