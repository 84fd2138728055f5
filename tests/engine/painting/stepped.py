"""Strokes for tests of old steps, and what is stored of a painting."""

from engine.painting import commands as c
from engine.session.held_pyramids import pyramids

ROCK = [{"texture": "rock", "colour": "#ffffff", "period": 16}]


def stroke(n, level=0, radius=5.0, ink=()):
    """A stroke whose place and colour follow from its number."""
    at = [float(17 * n % 90), float(29 * n % 70)]
    brush = {"radius": radius, "opacity": 0.6, "colour": f"#{40 * n % 256:02x}6080", "ink": list(ink)}
    points = [[v * 2.0**level for v in at], [v * 2.0**level + 12 for v in at]]
    return c.parse({"do": "stroke", "level": level, "points": points, "brush": brush})


def thick(n, mode="paint"):
    """As `stroke`, of thick paint: it lies in a heap."""
    at = [float(17 * n % 90), float(29 * n % 70)]
    brush = {"radius": 9.0, "colour": "#b04020", "mode": mode}
    if mode == "paint":
        brush["impasto"] = 1.0 + n % 3
    return c.parse({"do": "stroke", "points": [at, [v + 12 for v in at]], "brush": brush})


def contents(painting, depth=True):
    """All that is stored of a painting, copied; `depth`: with how many strokes there were when it was stored, which is
    another number when it is played anew."""
    return [
        (*sheet, key, r.rect, r.inks, r.depth if depth else 0, r.data.dtype, r.data.tobytes())
        for sheet, pyramid in pyramids(painting.root).items()
        for key, r in pyramid.all_records()
    ]


def records(painting):
    """All records of a painting."""
    return [record for pyramid in pyramids(painting.root).values() for _, record in pyramid.all_records()]
