"""The jug of clay, its glaze run down over the bare foot."""

from __future__ import annotations

import math

from scene.easel import Easel, Point
from scene.forms import Turned, curve, rows, solid
from scene.shading import EVEN, fill, glow, line, shade, spray

BODY = Turned(
    (190, 386),
    (
        *((30, 0), (37, 2), (52, 24), (68, 62), (74, 98), (66, 136)),
        *((46, 166), (34, 184), (31, 196), (35, 206), (38, 210), (38, 214)),
    ),
)
_RUNS = (74, 66, 78, 58, 64, 42, 56, 50, 68, 40, 60, 54, 72, 62, 76)  # how far down the glaze came, round the jug
_CRACKS = {"texture": "Stones", "amount": 0.45, "colour": "#ffffff", "period": 68,
           "shaping": [[0, 0], [0.46, 0], [0.5, 1], [0.54, 0], [1, 0]]}  # fmt: skip


def _ellipse(wide: float, high: float, start: float, end: float, count: int) -> list[Point]:
    """Around the middle of the mouth, from one part of a turn to another."""
    turns = (math.tau * (start + (end - start) * k / count) for k in range(count + 1))
    return [(190 + wide * math.cos(t), 172 + high * math.sin(t)) for t in turns]


def jug(easel: Easel) -> None:
    easel.layer("Jug")
    _handle(easel)
    clay = {"colour": "#7d4a30", "tints": {"Plaster wall": "#c98a5e"}, "periods": {"Plaster wall": 70}, "grain": None}
    thin = {"radius": [[0, 0], [1, 1]]}
    easel.touch("Rough plaster", solid(BODY.outline, 3.4), 2, radius=3.6, hardness=0.97, dynamics=thin, **clay)
    easel.lock("Jug")
    _glaze(easel)
    _model(easel)


def _handle(easel: Easel) -> None:
    loop = curve([(222, 186), (250, 180), (276, 196), (282, 226), (272, 254), (254, 272)], 5)
    line(easel, loop, 7.5, ("#1f4a50", "#35696a"), 60)
    shine = [(x - 2.2, y - 2.2) for x, y in loop[1:-2]]
    line(easel, shine, 2.4, ("#6fa39c", "#a8cfc2"), hardness=0.2, opacity=0.75)
    spray(easel, [(x + 4.5, y + 3) for x, y in loop], 4, "#0d1f26", 0.6, 2)


def _glaze(easel: Easel) -> None:
    foot = [BODY.at(-1 + 2 * k / (len(_RUNS) - 1), height + 8) for k, height in enumerate(_RUNS)]
    sides = [BODY.at(1.05, h) for h in (*range(90, 214, 12), 215)]
    sides += [BODY.at(-1.05, h) for h in (215, *range(208, 84, -12))]
    thick = {"curve": [[0, 1], [1, 1]], "width": 1.2, "amount": 0.9, "colour": "#0d2b33"}
    fill(easel, [*curve(foot, 3), *sides], 4.2, ("#215a61", "#3f8480"), 150, edge=thick, rim=1.6)
    for across, low, high in ((-0.62, 0.42, 0.8), (-0.2, 0.36, 0.9), (0.25, 0.4, 0.72), (0.6, 0.5, 0.75)):
        easel.touch(
            "Wet in wet", BODY.along(across, low, high), radius=22, colour="#7fb8a8", opacity=0.6, flow=0.08,
            hardness=0, tints={"Blooms": "#c8dcb4"}, periods={"Blooms": 90},
        )  # fmt: skip
    band = [BODY.at(k / 4 - 1, 178 - 3 * (1 - (k / 4 - 1) ** 2)) for k in range(9)]
    easel.touch("Dry bristle", band, 2, radius=5, colour="#0f2f3a", opacity=0.7, **EVEN)
    easel.touch(
        "Crazy paving", rows(BODY.outline, 12), 2, radius=14, colour="#41565a", hardness=0.8, mode="raster",
        op="multiply", ink=[_CRACKS], **EVEN,
    )  # fmt: skip


def _model(easel: Easel) -> None:
    """Shadow on the right, in which the table is reflected; light on the left, with the window in it."""
    for across, radius, colour, part in (
        *((1.0, 46, "#2f2a48", 0.95), (0.6, 48, "#5c5a78", 0.75), (-1.08, 20, "#5e5c6c", 0.7)),
    ):
        shade(easel, BODY.along(across, 0, 0.97), radius, colour, part, 0.11)
    shade(easel, [(150, 390), (190, 392), (236, 390)], 24, "#5b4048", 0.9, 0.08)
    glow(easel, BODY.along(0.9, 0.14, 0.55), 10, "#5e4434", 0.6, 0.06)
    glow(easel, BODY.along(-0.42, 0.12, 0.92), 36, "#56604c", 0.8, 0.06)
    for left, low in ((-0.58, 104), (-0.45, 104), (-0.58, 121), (-0.45, 121)):
        pane = [BODY.at(left + a, low + h) for a, h in ((0, 0), (0.1, -1), (0.1, 13), (0, 14))]
        fill(easel, pane, 1.6, ("#e4f0e2", "#ffffff"), hardness=0.4, opacity=0.7, rim=0.8)


def mouth(easel: Easel) -> None:
    easel.layer("Mouth")
    for by, colours in ((0.0, ("#2f6468", "#8db8ac")), (2.2, ("#0e1a1d", "#1d3a3f"))):
        fill(easel, _ellipse(37.6 - by, 7.4 - 0.7 * by, 0, 1, 40)[:-1], 1.8, colours, 40, rim=0.9)


def lip(easel: Easel) -> None:
    """The near edge of the mouth, before the stems."""
    easel.layer("Lip")
    edge = _ellipse(38, 7.6, 0, 0.5, 12)
    line(easel, edge, 1.5, ("#5f9a94", "#b9d8c8"))
    line(easel, edge[8:11], 0.9, ("#f2f4e2", "#ffffff"), hardness=0.4)
