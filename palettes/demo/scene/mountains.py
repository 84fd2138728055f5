"""Mountains: rock lit from the left, snow on the heights, bluer and paler with distance."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from scene.colour import mix
from scene.easel import ROUND, SOFT, Easel, Point, rock
from scene.ground import along
from scene.noise import dice, fractal, ridged, value


@dataclass(frozen=True)
class Range:
    """`crest`: its line from left to right; `foot`: where it ends below; colours from deepest shade to full light."""

    name: str
    crest: Sequence[Point]
    foot: float
    tones: Sequence[str]
    snow: Sequence[str]
    snowline: float
    haze: str
    fade: float
    seed: int
    rough: float = 1.0
    scale: float = 1.0
    contrast: float = 0.38

    def ridge(self, x: float) -> float:
        """Height of the crest at x, as y downwards."""
        jag = 13 * fractal(self.seed, x / 46, 0, 5) + 5 * abs(value(self.seed + 9, x / 9))
        return along(self.crest, x) + self.rough * jag

    def light(self, x: float, y: float) -> float:
        """Of the face at a place, about -1..1: the sun stands low on the left."""
        down = (y - self.ridge(x)) / self.scale
        drift = 26 * fractal(self.seed + 20, x / 90, y / 70, 3) + 0.22 * down * value(self.seed + 4, x / 130)
        large = (self.ridge(x + drift - 16) - self.ridge(x + drift + 16)) / 26
        small = self._relief(x + 2.5, y) - self._relief(x - 2.5, y)
        return min(max(0.75 * large, -0.7), 0.7) + 5.5 * small * min(1.0, 0.35 + down / 60)

    def _relief(self, x: float, y: float) -> float:
        x, y = x / self.scale, y / self.scale
        bend = 22 * fractal(self.seed + 30, x / 80, y / 80, 2)
        return ridged(self.seed + 40, (x + bend) / 52, (y + 0.5 * bend) / 96, 3)

    def snowy(self, x: float, y: float) -> bool:
        light, depth = self.light(x, y), y - self.ridge(x)
        cover = self.snowline + 26 * fractal(self.seed + 50, x / 30, y / 24, 3) - 34 * self._relief(x, y) * (light > 0)
        return y < cover and depth < 95 * self.scale

    def stone(self, tone: str, snow: bool = False) -> tuple[str, dict, list[dict]]:
        """Colour, brush and ink of a tone: rock from its darker to its lighter side, the same rock for all tones."""
        if snow:
            return mix(tone, self.snow[0], 0.12), ROUND, [rock(mix(tone, "#ffffff", 0.7), 1.0, 28, 0.25, self.seed)]
        dark, light = mix(tone, self.tones[0], self.contrast), mix(tone, "#ffe9c4", self.contrast)
        return dark, ROUND, [rock(light, 1.0, 28, 0.25, self.seed)]

    def colour(self, x: float, y: float) -> str:
        """Of a touch at a place, one of a few dozen: touches of one colour become one stroke."""
        light = min(max(self.light(x, y), -1), 1)
        depth = y - self.ridge(x)
        if self.snowy(x, y):
            tone = mix(self.snow[0], self.snow[1], round((0.5 + 0.9 * light) * 2) / 2)
        else:
            at = round((light * 1.15 + 1) * (len(self.tones) - 1) / 2)
            at = min(max(at, 0), len(self.tones) - 1)
            tone = self.tones[at]
        fall = min(max(depth / max(20, self.foot - self.ridge(x)), 0), 1)
        return mix(tone, self.haze, self.fade * (int(fall * 2.5) / 2.5) ** 1.6)


FAR = Range(
    "far range",
    [(-30, 372), (60, 340), (170, 372), (300, 338), (390, 362), (560, 330), (640, 352), (760, 318), (850, 346),
     (960, 306), (1060, 340), (1150, 312), (1310, 350)],
    480, ("#9aaccb", "#b4bed2", "#dcc9c0", "#ecd3bd"), ("#c3cee2", "#fbe6d2"), 334, "#e9d3bb", 0.85, 3, 0.6, 0.7, 0.3,
)  # fmt: skip
MAIN = Range(
    "main range",
    [(90, 470), (160, 402), (232, 330), (268, 318), (330, 262), (372, 205), (420, 128), (446, 112), (476, 150),
     (520, 196), (556, 226), (590, 212), (640, 262), (690, 246), (742, 204), (770, 196), (812, 250), (870, 322),
     (930, 356), (1010, 420), (1100, 470)],
    492, ("#38446e", "#565f8c", "#927f8e", "#d8a17c", "#fbd09a"), ("#7f9ad0", "#fff4e2"), 262, "#c9b9b4", 0.7, 7,
)  # fmt: skip


def paint(easel: Easel) -> None:
    easel.layer("Mountains")
    _range(easel, FAR, (9.0 if easel.sketch else 6.0,))
    _mist(easel, 400, "#f0dcc4", 0.5)
    _range(easel, MAIN, (9.0,) if easel.sketch else (7.0, 3.6))
    _mist(easel, 470, "#eed6bd", 0.55)


def _range(easel: Easel, range_: Range, radii: Sequence[float]) -> None:
    """A ground of broad strokes under the crest, then strokes down the fall line, finer and finer."""
    left, right = range_.crest[0][0], range_.crest[-1][0]
    body = [(left, range_.foot)]
    x = left
    while x < right:
        body += [(x, range_.ridge(x) + 7), (x + 3, range_.ridge(x + 3) + 7), (x + 3, range_.foot), (x + 9, range_.foot)]
        x += 9
    easel.stroke(
        "Mountains", 1 - easel.sketch, body, 5, *range_.stone(mix(range_.tones[1], range_.haze, 0.2)), dynamics={}
    )
    chance = dice(range_.name)
    for radius in radii:
        gap = 2.0 * radius
        places = []
        x = left
        while x < right:
            y = range_.ridge(x) + 0.8 * radius
            while y < range_.foot:
                places.append((x + chance.uniform(-1, 1) * gap / 2, y + chance.uniform(-1, 1) * gap / 2))
                y += 2.4 * gap
            x += gap
        heaps: dict[tuple[int, str, bool], list[list[Point]]] = {}
        for x, y in places:
            facet = _facet(range_, x, y, radius)
            if facet[-1][1] < range_.foot + 8:
                key = (int(x // 400) + 9 * int(y // 260), range_.colour(x, y), range_.snowy(x, y))
                heaps.setdefault(key, []).append(facet)
        order = list(heaps)
        chance.shuffle(order)
        for key in order:
            easel.touches(
                "Mountains",
                0 if easel.sketch or radius > 5 else 1,
                heaps[key],
                radius,
                *range_.stone(*key[1:]),
                opacity=0.92,
            )


def _facet(range_: Range, x: float, y: float, radius: float) -> list[Point]:
    """One touch of the knife: down the slope, leaning towards the side that its light shows."""
    lean = -0.55 if range_.light(x, y) > 0.05 else 0.6
    length = radius * (4.0 + 3.0 * abs(value(range_.seed, x, y)))
    path: list[Point] = []
    for t, press in ((0.0, 0.3), (0.4, 1.0), (1.0, 0.2)):
        bend = 0.5 * value(range_.seed + 70, x / 20, (y + t * length) / 20)
        path.append((x + (lean + bend) * t * length, y + t * length, press))
    top = max(range_.ridge(px) - py + 0.8 * radius * press for px, py, press in path)
    return [(px, py + max(top, 0), press) for px, py, press in path]


def _mist(easel: Easel, y: float, colour: str, opacity: float) -> None:
    """Haze lying at the foot, so that what comes next stands before it."""
    for k in range(4):
        line = [(x, y + 14 * k + 8 * math.sin(x / 130 + k)) for x in range(-60, 1360, 60)]
        easel.stroke("Mountains", 0, line, 36, colour, SOFT, opacity=opacity * 0.5)
