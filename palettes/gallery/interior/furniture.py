"""What stands and hangs in the room: the frame, a plate, the table with a jug and fruit, and their shadows."""

from __future__ import annotations

import math
import random

from interior.sheet import FINER, FLOOR, HEIGHT, PICTURE, SMALLER, WIDTH, Sheet, box, ink, ring, rounded


def frame(sheet: Sheet) -> None:
    """The moulding around the picture on the wall."""
    (x0, y0), thick = PICTURE, 30
    x1, y1 = x0 + (WIDTH >> SMALLER), y0 + (HEIGHT >> SMALLER)
    sheet.layer("Frame")
    sheet.fill(
        box(x0 - thick + 10, y0 - thick + 16, x1 + thick + 16, y1 + thick + 26), 12, colour="#5a4527", opacity=0.6
    )
    for out, light, dark in (
        (thick, "#8a5a2c", "#3f2410"),
        (thick - 6, "#c1914a", "#6d4517"),
        (10, "#7a4c22", "#341c0b"),
    ):
        for texture, side in (
            ("Grain", [(x0 - out, y0 - out), (x1 + out, y0 - out), (x1, y0), (x0, y0)]),
            ("Grain", [(x0 - out, y1 + out), (x1 + out, y1 + out), (x1, y1), (x0, y1)]),
            ("Oak", [(x0 - out, y0 - out), (x0, y0), (x0, y1), (x0 - out, y1 + out)]),
            ("Oak", [(x1 + out, y0 - out), (x1, y0), (x1, y1), (x1 + out, y1 + out)]),
        ):
            sheet.fill(side, 0.3, colour=light, ink=[ink(texture, dark, 0.6, 300)])
    for points, colour in (
        ([(x0 - thick, y0 - thick), (x1 + thick, y0 - thick)], "#e0b878"),
        ([(x0 - thick, y0 - thick), (x0 - thick, y1 + thick)], "#d0a566"),
        ([(x0 - thick, y1 + thick), (x1 + thick, y1 + thick)], "#2b1708"),
        ([(x1 + thick, y0 - thick), (x1 + thick, y1 + thick)], "#2b1708"),
    ):
        sheet.all_free()
        sheet.stroke([(*p, 1) for p in points], 1.1, colour=colour)


def plate(sheet: Sheet) -> None:
    """A painted plate, drawn with symmetry."""
    x, y, size = 482, 196, 46
    sheet.layer("Plate")
    sheet.fill(ring(x + 6, y + 10, size), 7, colour="#5a4527", opacity=0.6)
    sheet.fill(ring(x, y, size), 0.4, colour="#f1e6cd", ink=[ink("rock", "#cdbb92", 0.4, 120)])
    sheet.all_free()
    for n, (radius, colour, wide) in enumerate(
        ((size - 2, "#2e5f7d", 1.4), (size - 7, "#2e5f7d", 0.6), (22, "#c1763a", 0.9))
    ):
        sheet.stroke([(*p, 1) for p in ring(x, y, radius)], wide, colour=colour, opacity=1 - 0.1 * n)
    turned = {"centre": [x * FINER, y * FINER], "count": 8, "mirror": True}
    petal = [
        (x + 7 + 14 * t, y + 6 * math.sin(math.pi * t), 0.3 + 0.7 * math.sin(math.pi * t))
        for t in (n / 16 for n in range(17))
    ]
    thin = {"dynamics": {"radius": [[0, 0.3], [1, 1]]}}
    sheet.stroke(petal, 1.5, turned, colour="#2e5f7d", **thin)
    sheet.stroke([(x + 31, y, 1)], 3.2, {**turned, "mirror": False}, colour="#c1763a")
    sheet.stroke(
        [(x + 26 + 9 * t, y + 5 + 5 * t, 1 - t) for t in (n / 8 for n in range(9))],
        1.4,
        turned,
        colour="#5b8a5a",
        **thin,
    )
    sheet.stroke([(x, y, 1)], 4, colour="#c1763a")


def bench(sheet: Sheet) -> None:
    """A bench under the picture, on it a jug with twigs."""
    sheet.layer("Bench")
    sheet.fill([(556, 640), (900, 640), (960, 676), (590, 676)], 9, colour="#2a1a12", opacity=0.75)
    wood = {"colour": "#8f6238", "ink": [ink("Grain", "#4a2a13", 0.65, 380)]}
    leg = {"colour": "#6d4626", "ink": [ink("Oak", "#331b0b", 0.65, 200)]}
    for x in (572, 860):
        sheet.fill([(x, 520), (x + 26, 520), (x + 22, 650), (x + 4, 650)], 0.4, **leg)
        sheet.fill([(x + 18, 520), (x + 26, 520), (x + 22, 650), (x + 17, 650)], 2, colour="#2b170a", opacity=0.8)
    sheet.fill(box(580, 530, 880, 552), 0.4, colour="#6d4626", ink=[ink("Grain", "#331b0b", 0.65, 300)])
    sheet.fill(box(580, 528, 880, 536), 3, colour="#241308", opacity=0.8)
    sheet.fill([(566, 492), (900, 492), (916, 514), (550, 514)], 0.4, **{**wood, "colour": "#b5834c"})
    sheet.fill(box(550, 514, 916, 528), 0.4, **wood)
    jug = [
        (650, 508),
        (638, 480),
        (640, 452),
        (654, 434),
        (656, 420),
        (650, 410),
        (690, 410),
        (684, 420),
        (686, 434),
        (702, 452),
        (704, 480),
        (692, 508),
    ]
    sheet.fill([(650, 500), (700, 496), (772, 508), (700, 514), (652, 512)], 4, colour="#3a2212", opacity=0.8)
    sheet.fill(
        rounded(jug), 0.5, colour="#3f6f73", ink=[ink("rock", "#1e4448", 0.5, 160), ink("Plaster", "#7fb0a8", 0.3, 200)]
    )
    sheet.fill(
        rounded([(688, 414), (690, 436), (704, 456), (704, 482), (692, 508), (676, 508), (690, 478), (684, 440)]),
        4,
        colour="#12292c",
        opacity=0.7,
    )
    sheet.fill(rounded([(648, 450), (656, 440), (654, 470), (648, 482)]), 2.5, colour="#cfe6dc", opacity=0.7)
    for x, size, colour, dark in (
        (780, 17, "#c9803a", "#7d3f14"),
        (812, 16, "#b8452f", "#5c150e"),
        (797, 15, "#d3a03f", "#7d5214"),
    ):
        y = 510 - size if size != 15 else 484
        sheet.fill(ring(x + 8, 511, size, 40, 0.25), 3, colour="#3a2212", opacity=0.7)
        sheet.fill(ring(x, y, size), 0.6, colour=colour, ink=[ink("rock", dark, 0.5, 70)])
        sheet.fill(ring(x - 5, y - 5, size / 3), 3, colour="#fff0cf", opacity=0.6)
    twigs(sheet)


def twigs(sheet: Sheet) -> None:
    told = random.Random(8)
    sheet.all_free()
    thin = {"dynamics": {"radius": [[0, 0.2], [1, 1]]}}
    for lean in (-46, -20, 6, 34, 58):
        tall = told.uniform(42, 64)
        stem = [(670 + lean * t * t, 414 - tall * t, 1 - 0.6 * t) for t in (n / 12 for n in range(13))]
        sheet.stroke(stem, 1.6, colour="#4a3b22", **thin)
        for n in range(4, 13):
            x, y, _ = stem[n]
            for side in (-1, 1):
                angle = math.atan2(-tall, lean * 1.6) + side * told.uniform(0.5, 1.0)
                long = told.uniform(9, 15)
                leaf = [
                    (
                        x + long * t * math.cos(angle),
                        y + long * t * math.sin(angle),
                        math.sin(math.pi * (0.08 + 0.92 * t)),
                    )
                    for t in (k / 6 for k in range(7))
                ]
                colour = told.choice(("#6f8a4a", "#56743c", "#8fa35a", "#3f5c33"))
                sheet.stroke(leaf, 2.9, colour=colour, ink=[ink("Moss", "#2c4424", 0.5, 60)], **thin)


def shade(sheet: Sheet) -> None:
    sheet.layer("Shade", blend="multiply")
    sheet.gradient("dusk", (300, 200), (1040, 820), "#ffffff", "#e9dccb", "#8f7768")
    sheet.fill(box(-8, -8, WIDTH + 8, HEIGHT + 8), 0, 1, colour="#ffffff", ink=[{"texture": "dusk"}])
    sheet.fill(box(-40, FLOOR - 3, WIDTH + 40, FLOOR + 10), 7, colour="#6b5647", opacity=0.8)
    sheet.gradient("corner", (0, 60), (0, -60), "#ffffff", "#a58f78")
    sheet.fill(box(-40, -60, WIDTH + 40, 10), 18, colour="#b9a48c", opacity=0.7)
