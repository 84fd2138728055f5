"""Behind and below the orange: a dark wall, and a table with a linen cloth over its edge."""

from __future__ import annotations

from typing import Any

from cutting.board import Board
from cutting.shapes import ellipse

BACK, EDGE = 470.0, 655.0  # of the table top


def wall(board: Board) -> None:
    """Lighter where the light from the left falls on it."""
    board.layer("Wall")
    texture = {"name": "Plaster", "maker": "spectrum", "size": [256, 256], "roughness": 0.65, "seed": 8}
    shapes = [{"shape": "noise", "b": 1.3, "from": 0.02, "to": 0.25}]
    board.lines.append({"do": "texture", **texture, "shapes": shapes})
    ink = [{"texture": "Plaster", "amount": 0.3, "colour": "#4a5250", "period": 760}]
    _wash(board, 0, BACK, "#3a4241", ink)
    for x, y, radius, colour, part in (
        *((170, 120, 330, "#8f8a76", 0.42), (330, 330, 260, "#7d7866", 0.30), (960, 130, 380, "#14181a", 0.65)),
        *((1000, 430, 300, "#101416", 0.6), (40, 520, 240, "#1c2122", 0.35)),
    ):
        board.soft([(x, y), (x + 30, y + 10)], radius, colour, part, flow=0.6)


def cloth(board: Board) -> None:
    board.layer("Cloth")
    texture = {"name": "Linen", "maker": "spectrum", "size": [256, 256], "roughness": 0.6, "seed": 6}
    shapes: list[dict[str, Any]] = [
        *({"shape": "wedge", "angle": a, "spread": 1.2, "from": 0.2, "to": 0.3, "slope": 0} for a in (0, 90)),
        {"shape": "noise", "b": 0.5, "strength": 0.05},
    ]
    board.lines.append({"do": "texture", **texture, "shapes": shapes})
    ink = [{"texture": "Linen", "amount": 0.5, "colour": "#d9d3c4", "period": 150}]
    _wash(board, BACK, EDGE, "#bdb6a7", ink)
    _wash(board, EDGE, 960, "#7c766c", [ink[0] | {"colour": "#8d877b"}])
    shade = {"mode": "raster", "op": "multiply", "flow": 0.06}
    light = {"mode": "raster", "op": "screen", "flow": 0.2}
    # The far edge is out of the light; what hangs down is darker than the top, most below and on the right.
    board.soft([(-200, BACK), (1200, BACK)], 90, "#77736c", 0.75, **shade)
    board.soft([(-400, 1080), (1400, 1080)], 420, "#3c3a42", 1.0, **(shade | {"flow": 0.12}))
    board.soft([(1120, 440), (1120, 1000)], 420, "#66656b", 0.7, **shade)
    board.soft([(-200, EDGE + 16), (1200, EDGE + 14)], 40, "#6a665f", 0.8, **shade)
    board.soft([(-200, EDGE - 3), (1200, EDGE - 3)], 8, "#57524a", 0.7, **light)


def shadows(board: Board) -> None:
    """Of the orange, to the right of it."""
    board.layer("Shadows", blend="multiply")
    for x, y, a, b, radius, colour, part in (
        *((590, 560, 170, 8, 64, "#4a3e3a", 0.6), (510, 560, 110, 8, 40, "#3a2a24", 0.55)),
        *((428, 556, 48, 1, 22, "#2a140c", 0.8),),
    ):
        oval = ellipse(x, y, a, b, count=36)
        board.soft([*oval, oval[0]], radius, colour, part, flow=0.06)


def _wash(board: Board, top: float, bottom: float, colour: str, ink: list[dict[str, Any]]) -> None:
    """An even ground between two heights, with straight borders: a broad brush drawn in rows."""
    step = 14.0
    count = max(1, round((bottom - top) / (2 * step)))
    half = (bottom - top) / (2 * count)
    points = []
    for k in range(count):
        y = top + half * (2 * k + 1)
        points += [(-40.0, y), (1040.0, y)] if k % 2 == 0 else [(1040.0, y), (-40.0, y)]
    board.soft(points, half + 0.5, colour, 1.0, hardness=1, ink=ink)
