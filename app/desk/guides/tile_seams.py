"""Painting on a layer that wraps around: which textures of a brush do not meet at the rim of the tile."""

from __future__ import annotations

from app.desk.desk import Desk
from engine.brush.parts import Component, Surface
from engine.brush.settings import Brush
from engine.canvas.placing.pose import SourcePart
from engine.checks.values import is_number

_EVERYWHERE = ("white",)  # the same wherever one looks
_ENDLESS = ("rock", "sparse", "gradient")  # repeat nowhere


def tell_seams(desk: Desk, cell: SourcePart, level: int, brush: Brush) -> None:
    """Says which textures of a brush do not fit a tile, if there are any; not again while the same do not."""
    found = seams(desk, cell, level, brush)
    if found and found != desk.guides.seams:
        desk.say(f"{', '.join(f'“{name}”' for name in found)}: its repeats do not fit the tile, its rim shows")
    desk.guides.seams = found


def seams(desk: Desk, cell: SourcePart, level: int, brush: Brush) -> tuple[str, ...]:
    """Returns the names of the textures of a brush, in pixels of a level, whose period does not divide the tile."""
    parts: list[tuple[Component | Surface | None, int]] = [(part, level) for part in (*brush.ink, brush.density)]
    parts.append((brush.grain, level if brush.grain is None else brush.grain.level))
    found = [part.texture for part, at in parts if part is not None and not _fits(desk, cell, at, part)]
    if brush.row.grows and brush.example is not None:  # it is grown as if there were nothing beyond the rim
        found.append(brush.example)
    return tuple(dict.fromkeys(found))


def _fits(desk: Desk, cell: SourcePart, level: int, part: Component | Surface) -> bool:
    scene = desk.known.scene
    kinds = dict(scene.texture_kinds) if scene is not None else {}
    laid = desk.filling.gradient
    if laid is not None and laid.name == part.texture:  # the painting may not tell of it yet
        kinds[laid.name] = laid.maker
    kind = kinds.get(part.texture, part.texture)
    if kind in _EVERYWHERE:
        return True
    given = next((said for name, _, said in scene.definitions if name == part.texture), {}) if scene else {}
    widths = dict(scene.texture_widths) if scene is not None else {}
    told = {"period": widths.get(part.texture, 32.0), "angle": 0.0, **given, **part.parameters}
    period, angle = told["period"], told["angle"]
    if kind in _ENDLESS or not is_number(period) or not is_number(angle) or float(angle) % 90.0:
        return False
    tile = cell.rect.zoomed(level - cell.level)
    return not tile.width % float(period) and not tile.height % float(period)
