"""A linen cloth that lies on the table and hangs over its edge."""

from __future__ import annotations

from scene.easel import Easel, Point
from scene.forms import curve, rows, tapered
from scene.room import FRONT
from scene.shading import EVEN, THINNING, fill, glow, shade, spray

_EDGE: tuple[Point, ...] = (
    *((128, 411), (170, 407), (214, 410), (262, 406), (274, 425), (284, FRONT + 1), (287, 470), (282, 489)),
    *((268, 487), (250, 496), (232, 488), (214, 500), (196, 490), (180, 497), (164, 486), (146, 492)),
    *((134, 480), (136, 466), (131, FRONT + 1), (120, 430)),
)
_HEM: tuple[Point, ...] = (
    *((132, 474), (147, 482), (164, 477), (181, 487), (197, 480)),
    *((214, 490), (232, 479), (250, 486), (268, 478), (290, 480)),
)
_FOLDS = ((152, 6, -4), (181, 7, 3), (206, 6, -2), (233, 8, 3), (262, 7, -3))  # x, radius, lean
_CREASES = ((((136, 424), (170, 419), (206, 424), (244, 418)), 7), (((160, 440), (200, 434), (252, 438)), 6))


def cloth(easel: Easel) -> None:
    easel.layer("Cloth shadow", blend="multiply")
    below = curve([(134, 470), (150, 486), (210, 494), (282, 486), (296, 462), (296, 440)], 4)
    spray(easel, below, 12, "#30222a", 0.8, flow=0.12)
    spray(easel, [(126, 416), (200, 413), (270, 411), (284, 430), (292, 446)], 6, "#4a3a40", 0.6, flow=0.15)
    easel.layer("Cloth")
    outline = curve(_EDGE, 4)
    fill(easel, outline, 3.4, ("#c9bb9c", "#efe6cf"), 120)
    easel.lock("Cloth")
    _weave(easel, outline)
    for fold in _FOLDS:
        _hanging(easel, *fold)
    _lying(easel)


def _weave(easel: Easel, outline: list[Point]) -> None:
    threads = {"colour": "#a3927a", "hardness": 0.9, "opacity": 0.7, "periods": {"Canvas": 13}}
    easel.touch("Canvas weave", rows(outline, 6), 2, radius=12, **threads, **EVEN)
    blue = {"colour": "#35486a", "tints": {"Wax drag": "#5f7799"}, "periods": {"Wax drag": 20}, "edge": None}
    for shift in (0, 6):
        stripe = curve([(x, y - shift) for x, y in _HEM], 4)
        grain = {"texture": "Canvas", "amount": 0.6, "period": 6}
        easel.touch("Oil pastel", stripe, 2, radius=1.6 - shift / 12, grain=grain, **blue, **EVEN)


def _hanging(easel: Easel, x: float, radius: float, lean: float) -> None:
    """A fold: the light comes from the left, so it is bright on that side and dark on the other."""

    def down(by: float) -> list[Point]:
        path = curve([(x + by, FRONT + 1), (x + by + lean / 2, 472), (x + by + lean, 500)], 4)
        return [(a, b, 0.1 + 0.9 * k / 8) for k, (a, b) in enumerate(path)]

    shade(easel, down(6), radius * 1.5, "#6f6070", 0.85, 0.09, **THINNING)
    glow(easel, down(-6), radius, "#6c634c", 0.8, 0.09, **THINNING)


def _lying(easel: Easel) -> None:
    for points, radius in _CREASES:
        crease = curve(points, 5)
        shade(easel, tapered(crease, 0.2), radius, "#a0909a", 0.6, 0.08, **THINNING)
        glow(easel, tapered([(x, y - 6) for x, y in crease], 0.2), radius * 0.8, "#5c5440", 0.6, 0.08, **THINNING)
    over = curve([(128, FRONT - 4), (180, FRONT - 1), (240, FRONT - 3), (288, FRONT - 1)], 4)
    glow(easel, over, 5, "#7a6e54", 0.85, 0.12)
    shade(easel, [(x, y + 13) for x, y in over], 11, "#8f8090", 0.8, 0.07)
    shade(easel, [(286, 410), (290, 450), (290, 500)], 20, "#7a6c7a", 0.8, 0.06)
