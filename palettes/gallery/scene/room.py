"""The wall of rough plaster, the table of old planks, and the shadows of what stands on it."""

from __future__ import annotations

from scene.easel import Easel, Point
from scene.forms import curve, rows
from scene.shading import EVEN, glow, shade, spray

BACK, FRONT = 336, 452  # the far and the near edge of the table
_BARE = (((396, 40), (420, 74), (416, 110)), ((24, 236), (44, 262), (30, 290)), ((470, 214), (486, 250)))
_CRACKS = (
    ((452, -8), (440, 34), (448, 70), (428, 112), (433, 150), (420, 186)),
    ((428, 112), (410, 128), (404, 146)),
)
_PLANKS = ((BACK, 362, "#5a3822", "#b07a48"), (362, 400, "#643e25", "#bf8850"), (400, FRONT, "#5c3820", "#b98049"))
_CAST: tuple[tuple[tuple[Point, ...], float, float], ...] = (  # path, radius, opacity
    (((196, 384, 0.7), (262, 372, 1), (300, 356, 0.9), (322, 340, 0.7)), 24, 0.6),  # of the jug
    (((404, 396, 0.8), (462, 394, 1), (520, 384, 1)), 17, 0.6),  # of the bowl
    (((300, 404, 0.8), (342, 402, 1), (384, 394, 0.5)), 15, 0.6),  # of three pears
    (((98, 425, 0.9), (150, 424, 1), (186, 416, 0.4)), 13, 0.6),
    (((352, 436, 0.9), (410, 438, 1), (462, 430, 0.4)), 13, 0.7),
    (((462, 430, 0.6), (480, 430, 1), (504, 425, 0.4)), 8, 0.7),  # of a plum
)
_STANDING = (  # where things touch the table
    *(((166, 388), (196, 391), (226, 387)), ((280, 407), (302, 409), (322, 406)), ((76, 427), (98, 430), (122, 427))),
    *(((346, 438), (372, 441), (402, 434)), ((388, 396), (406, 398), (426, 396)), ((454, 434), (462, 436), (471, 434))),
)


def wall(easel: Easel) -> None:
    easel.layer("Wall")
    field = rows([(-30, -30), (530, -30), (530, 380), (-30, 380)], 40)
    easel.touch("Rough plaster", field, radius=52, colour="#978a78", tints={"Plaster wall": "#d8c9b0"}, grain=None)
    for y, tone in ((60, "#c9b79b"), (190, "#d6c6ae"), (300, "#bda98d")):
        sweep = curve([(-30, y), (120, y - 22), (300, y + 14), (530, y - 8)], 5)
        easel.touch("Soft pastel", sweep, radius=46, colour=tone, opacity=0.3, tints={"Pastel bloom": "#efe2c8"})
    flaking = {"texture": "Plaster wall", "period": 90, "shaping": "threshold"}
    brick = {"mode": "paint", "colour": "#8d5c44", "hardness": 0.4, "opacity": 0.75, "density": flaking, "ink": None}
    for spot in _BARE:
        easel.touch("Scraper", spot, radius=17, **brick)
    for crack in _CRACKS:
        path = curve(crack, 4)
        easel.touch("Pencil", path, 2, radius=0.8, colour="#4c4036", **EVEN)
        easel.touch("Pencil", [(x - 1.2, y + 0.6) for x, y in path], 2, radius=0.6, colour="#f3e6cd", **EVEN)
    for path, radius, colour in (
        (((520, -20), (500, 150), (515, 340)), 150, "#7d7590"),
        (((-20, 0), (260, -30), (520, 10)), 80, "#8a8198"),
        (((-20, 350), (250, 340), (520, 345)), 60, "#86786f"),
    ):
        shade(easel, curve(path, 5), radius, colour, 0.75, 0.12, fine=0)


def table(easel: Easel) -> None:
    easel.layer("Table")
    for k, (top, foot, dark, light) in enumerate(_PLANKS):
        quarter = (foot - top) / 4
        field = rows([(-20, top), (520, top), (520, foot + 1), (-20, foot + 1)], quarter)
        wood = {"tints": {"Oak": light, "Fibres": "#2c180d"}, "periods": {"Oak": 190 + 90 * k, "Fibres": 90 + 40 * k}}
        easel.touch("Wood grain", field, radius=quarter + 0.8, colour=dark, hardness=0.98, **wood, **EVEN)
    for y, radius in ((362, 0.7), (400, 0.9)):
        joint = curve([(-10, y), (160, y + 0.4), (340, y - 0.3), (510, y + 0.2)], 3)
        easel.touch("Pencil", joint, 2, radius=radius, colour="#1c0f08", opacity=0.95, **EVEN)
        lit = [(x, v + 1.6) for x, v in joint]
        easel.touch("Pencil", lit, 2, radius=0.5, colour="#e2b47c", opacity=0.6, **EVEN)
    front = rows([(-20, FRONT), (520, FRONT), (520, 520), (-20, 520)], 12)
    deep = {"tints": {"Oak": "#6e4526", "Fibres": "#1a0d06"}, "periods": {"Oak": 210, "Fibres": 110}}
    easel.touch("Wood grain", front, radius=13, colour="#2f1b10", **deep, **EVEN)
    rounded = {"tints": {"Oak": "#e8bd85", "Fibres": "#6b4426"}, "periods": {"Oak": 230}}
    easel.touch("Wood grain", [(-10, FRONT), (510, FRONT)], radius=2.6, colour="#a06e40", **rounded, **EVEN)
    _dusk(easel)


def _dusk(easel: Easel) -> None:
    """Shadow under the table's edge, along the wall, and far from the window; light near it."""
    for path, radius, colour, part in (
        (((-20, 462), (250, 461), (520, 463)), 9, "#4a3a3c", 0.8),
        (((-20, 505), (250, 505), (520, 505)), 34, "#4f4247", 0.9),
        (((-20, 334), (250, 333), (520, 334)), 12, "#7c6258", 0.7),
        (((520, 340), (470, 400), (520, 460)), 70, "#85747a", 0.7),
    ):
        shade(easel, curve(path, 4), radius, colour, part, 0.3, fine=0)
    glow(easel, curve([(20, 392), (120, 388), (210, 396)], 4), 42, "#5e4a30", 0.7, 0.2, fine=0)


def shadows(easel: Easel) -> None:
    """Cast on the table, to the right and away from the light."""
    easel.layer("Cast shadows", blend="multiply")
    soft = {"hardness": 0.1, "dynamics": {"radius": [[0, 0.2], [1, 1]]}, "spacing": 0.12}
    for path, radius, part in _CAST:
        spray(easel, curve(path, 5), radius, "#4b3a4a", part, 0, flow=0.35, **soft)
    for path in _STANDING:
        spray(easel, curve(path, 3), 4.5, "#22151c", 0.85, flow=0.5, **soft)
