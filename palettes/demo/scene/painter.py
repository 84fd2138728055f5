"""The painter in the studio, standing at the left of the canvas, one arm with the brush at it."""

from __future__ import annotations

from typing import Any

from scene.easel import FIRM, ROUND, SOFT, Easel, Point, hand, hatch, rock
from scene.window import CANVAS

SKIN = "#dba27c"
HAIR_TONE = "#5c3a30"


def painter(easel: Easel) -> None:
    x, y = CANVAS
    body = x - 0.36
    smock = [rock("#7f9cb4", 0.8, 0.3, 0.4, 35)]
    _clothes(easel, body, y, smock)
    _arm(easel, body, y, smock)
    _palette(easel, body, y)
    head = (body + 0.02, y - 0.03)
    easel.stroke("Window", 10, [(head[0], head[1] + 0.06), (head[0], y + 0.13)], 0.045, "#c88f6c", FIRM)
    _head(easel, head)
    _face(easel, head)
    _beret(easel, head)


def _clothes(easel: Easel, body: float, y: float, smock: list[dict[str, Any]]) -> None:
    legs = [[(body - 0.07, y + 0.75), (body - 0.09, y + 1.2)], [(body + 0.08, y + 0.75), (body + 0.09, y + 1.2)]]
    easel.touches("Window", 8, legs, 0.06, "#3a3440", FIRM)
    coat = [(body - 0.13, y + 0.14), (body + 0.13, y + 0.14), (body + 0.22, y + 0.86), (body - 0.22, y + 0.86)]
    easel.stroke("Window", 9, hatch(coat, 0.03, 1.4), 0.03, "#3f5f80", FIRM, smock)
    folds = [hand([(body + 0.05 * k, y + 0.3), (body + 0.075 * k, y + 0.82)], 0.1, 0.01, k) for k in (-2, -1, 1, 2)]
    easel.touches("Window", 9, folds, 0.014, "#2c4460", ROUND, opacity=0.7)
    lit = [[(body - 0.13, y + 0.18), (body - 0.2, y + 0.84)]]
    easel.touches("Window", 9, lit, 0.014, "#a9c0cc", ROUND, opacity=0.8)


def _arm(easel: Easel, body: float, y: float, smock: list[dict[str, Any]]) -> None:
    arm = hand([(body + 0.1, y + 0.2), (body + 0.19, y + 0.36), (body + 0.3, y + 0.25)], 0.04)
    easel.stroke("Window", 10, arm, 0.05, "#46688a", FIRM, smock)
    easel.stroke("Window", 10, [(px - 0.01, py - 0.035, 0.8) for px, py, _ in arm], 0.012, "#a9c0cc", ROUND)
    easel.stroke("Window", 10, [(body + 0.31, y + 0.235), (body + 0.33, y + 0.225)], 0.033, "#e8b48c", FIRM)
    easel.stroke("Window", 11, [(body + 0.27, y + 0.27), (body + 0.345, y + 0.205)], 0.006, "#6a4428", FIRM)
    easel.stroke("Window", 11, [(body + 0.345, y + 0.205), (body + 0.357, y + 0.195, 0.3)], 0.008, "#e8c468", ROUND)


def _palette(easel: Easel, body: float, y: float) -> None:
    outline = ((-0.2, 0.46), (-0.1, 0.42), (0.02, 0.47), (-0.08, 0.52), (-0.2, 0.47))
    palette = hand([(body + dx, y + dy) for dx, dy in outline], 0.05)
    easel.stroke("Window", 10, palette, 0.04, "#b07c4c", FIRM)
    for k, tone in enumerate(("#f6f0e0", "#e8b83c", "#c8402c", "#3c6a9c", "#4c7a44")):
        blob = [(body - 0.19 + 0.045 * k, y + 0.455 + 0.008 * (k % 2)), (body - 0.18 + 0.045 * k, y + 0.46)]
        easel.stroke("Window", 10, blob, 0.016, tone, ROUND, dynamics={})


def _at(head: Point, *places: Point) -> list[Point]:
    return [(head[0] + dx, head[1] + dy) for dx, dy in places]


def _head(easel: Easel, head: Point) -> None:
    easel.stroke("Window", 10, _at(head, (-0.005, -0.02), (0.008, 0.045)), 0.085, SKIN, FIRM)
    nose = hand(_at(head, (0.085, 0), (0.105, 0.02), (0.085, 0.03)), 0.01)
    easel.stroke("Window", 10, nose, 0.014, SKIN, FIRM)
    hair = hand(_at(head, (-0.07, 0.06), (-0.085, -0.03), (-0.02, -0.08)), 0.02)
    easel.stroke("Window", 10, hair, 0.035, HAIR_TONE, ROUND, dynamics={})


def _face(easel: Easel, head: Point) -> None:
    easel.stroke("Window", 11, _at(head, (0.05, -0.012), (0.052, -0.01)), 0.008, "#3a2a2a", FIRM)
    brow = hand(_at(head, (0.035, -0.03), (0.055, -0.035), (0.07, -0.028)), 0.01)
    easel.stroke("Window", 11, brow, 0.004, HAIR_TONE, FIRM)
    mouth = hand(_at(head, (0.05, 0.055), (0.065, 0.06), (0.08, 0.052)), 0.01)
    easel.stroke("Window", 11, mouth, 0.004, "#a85a4c", FIRM)
    cheek = _at(head, (0.02, 0.035), (0.022, 0.036))
    easel.stroke("Window", 10, cheek, 0.025, "#e8967c", SOFT, opacity=0.5, flow=0.5)
    ear = hand(_at(head, (-0.025, -0.005), (-0.04, 0.012), (-0.022, 0.03)), 0.01)
    easel.stroke("Window", 11, ear, 0.013, "#c88f6c", FIRM)


def _beret(easel: Easel, head: Point) -> None:
    beret = hand(_at(head, (-0.11, -0.07), (-0.02, -0.115), (0.1, -0.075)), 0.03)
    easel.stroke("Window", 10, beret, 0.045, "#8e2f34", FIRM, [rock("#d0605c", 0.7, 0.06, 0.3, 36)])
    easel.stroke("Window", 10, _at(head, (0, -0.15), (0.012, -0.18)), 0.011, "#8e2f34", FIRM)
