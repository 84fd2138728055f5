"""The wall with its panelling, the window and what is seen through it, and the floor of one tile."""

from __future__ import annotations

import math
import random

from interior.sheet import EYE, FLOOR, HEIGHT, WIDTH, WINDOW, Sheet, behind, box, ink, ring


def wall(sheet: Sheet) -> None:
    sheet.layer("Wall")
    sheet.gradient("day", (80, 200), (1010, 420), "#efe2c2", "#dcc79d", "#b39a73")
    sheet.fill(
        box(-8, -8, WIDTH + 8, FLOOR + 8),
        0,
        1,
        colour="#dcc79d",
        ink=[{"texture": "day"}, ink("Plaster", "#8d7650", 0.22, 300), ink("rock", "#fff4d8", 0.14, 420)],
    )


def panelling(sheet: Sheet) -> None:
    """The lower part of the wall."""
    top = FLOOR - 96
    sheet.layer("Panels")
    wood = {"colour": "#6f7f74", "ink": [ink("Oak", "#3d4a44", 0.45, 420), ink("rock", "#90a093", 0.3, 300)]}
    sheet.fill(box(-8, top, WIDTH + 8, FLOOR + 2), 0, 1, **{**wood, "ink": [ink("Oak", "#3d4a44", 0.45, 210)]})
    sheet.fill(box(-8, top - 8, WIDTH + 8, top + 2), colour="#94a397", ink=[ink("Grain", "#5a685e", 0.4, 420)])
    sheet.fill(box(-8, top + 2, WIDTH + 8, top + 6), 1, colour="#38433d")
    sheet.fill(box(-8, FLOOR - 16, WIDTH + 8, FLOOR), colour="#7f8f84", ink=[ink("Grain", "#45524a", 0.4, 420)])
    sheet.fill(box(-8, FLOOR - 18, WIDTH + 8, FLOOR - 16), 0.6, colour="#a9b7ab")
    for n in range(-1, 9):
        x = 22 + 128 * n
        sheet.fill(box(x, top + 18, x + 100, FLOOR - 28), 0.8, colour="#4b5850")
        sheet.fill(box(x + 3, top + 21, x + 100, FLOOR - 28), 0.6, colour="#98a79b")
        sheet.fill(
            box(x + 3, top + 21, x + 97, FLOOR - 31), 0.4, colour="#78887c", ink=[ink("Oak", "#4a5850", 0.5, 260)]
        )


def view(sheet: Sheet) -> None:
    """What is seen through the window: evening, hills, cypresses."""
    x0, y0, x1, y1 = WINDOW
    told = random.Random(3)
    sheet.layer("View")
    sheet.gradient("sky", (220, y0), (220, y1 - 90), "#5f8fae", "#a9c4c0", "#f3dfae", "#f6c98a")
    sheet.fill(box(x0, y0, x1, y1), 0, colour="#a9c4c0", ink=[{"texture": "sky"}])
    sheet.fill(ring(304, 232, 21), 1.5, colour="#fff3cf")
    for y, rise, light, dark, period in (
        (286, 20, "#9db0a0", "#7d9488", 200),
        (312, 15, "#7f9a72", "#54724f", 170),
        (344, 12, "#8fa04f", "#4c6a32", 130),
        (378, 8, "#a58f45", "#5d6a2c", 100),
    ):
        edge = [
            (x, y - rise * math.sin(x / 41 + y) - 0.4 * rise * math.sin(x / 17 + 2 * y)) for x in range(x0, x1 + 1, 4)
        ]
        sheet.fill([*edge, (x1, y1), (x0, y1)], 0.7, colour=light, ink=[ink("Moss", dark, 0.75, period)])
        for _ in range(5 if y < 370 else 0):
            x = told.uniform(x0 + 10, x1 - 10)
            high = told.uniform(0.05, 0.09) * y
            foot = y + 3 - rise * math.sin(x / 41 + y) - 0.4 * rise * math.sin(x / 17 + 2 * y)
            tree = [
                (x - high * 0.14, foot),
                (x - high * 0.17, foot - high * 0.4),
                (x, foot - high),
                (x + high * 0.17, foot - high * 0.4),
                (x + high * 0.14, foot),
            ]
            sheet.fill(tree, 0.7, colour="#2f4a35", ink=[ink("Moss", "#14261c", 0.7, 40)])


def window(sheet: Sheet) -> None:
    """The window's frame, seen into by the depth of the wall: its sides run to one point."""
    x0, y0, x1, y1 = WINDOW
    (left, top), (right, bottom) = behind((x0, y0), (x1, y1))
    middle = (left + right) / 2
    told = {"kind": "perspective-1", "points": [list(EYE), [WIDTH, EYE[1]]], "off": True}
    sheet.lines.append({"do": "guide", "name": "Eye", **told})
    sheet.layer("Window")
    bar = {"colour": "#e8dcc0", "ink": [ink("Oak", "#a58d63", 0.45, 300)]}
    flat = {"colour": "#efe4ca", "ink": [ink("Grain", "#a58d63", 0.45, 300)]}
    dark = {"colour": "#5d4d33"}
    for y in (y0 + 112, y0 + 224):
        (_, high), (_, low) = behind((x0, y - 5), (x0, y + 5))
        sheet.fill(box(left, high, x1, low), 0.4, **flat)
        sheet.fill(box(left, low, x1, low + 1.5), 0.8, **dark)
    sheet.fill(box(middle - 6, top, middle + 6, bottom), 0.4, **bar)
    sheet.fill(box(middle + 6, top, middle + 7.5, bottom), 0.8, **dark)
    for edge in (box(left, top, left + 9, bottom), box(left, top, x1, top + 8), box(left, bottom - 9, x1, bottom)):
        sheet.fill(edge, 0.4, **flat)
    sheet.fill(box(left + 9, top + 8, x1, top + 10), 0.8, **dark)
    reveals(sheet)
    sheet.fill(box(x0 - 22, y0 - 22, x0 + 4, y1 + 8), 0.4, **bar)
    sheet.fill(box(x1 - 4, y0 - 22, x1 + 22, y1 + 8), 0.4, **bar)
    sheet.fill(box(x0 - 28, y0 - 28, x1 + 28, y0 + 4), 0.4, **flat)
    sheet.fill(box(x0 - 40, y1 - 2, x1 + 40, y1 + 20), 0.4, **flat)
    for edge in (
        box(x0 - 24, y0 - 22, x0 - 22, y1),
        box(x1 + 22, y0 - 22, x1 + 25, y1),
        box(x0 - 40, y1 + 20, x1 + 42, y1 + 24),
        box(x0 + 4, y0 + 4, x0 + 6, y1 - 2),
    ):
        sheet.fill(edge, 1, **dark)
    sheet.fill(box(x0 + 4, y0 + 4, x1 - 4, y0 + 7), 2, **dark)


def reveals(sheet: Sheet) -> None:
    """The wall's thickness beside, above and below the window; that on the right is hidden."""
    x0, y0, x1, y1 = WINDOW
    (left, top), (_, bottom) = behind((x0, y0), (x1, y1))
    for name, away, here, colours, points in (
        ("side", (left, 0), (x0, 0), ("#8d7650", "#c7ae82"), [(x0, y0), (left, top), (left, bottom), (x0, y1)]),
        ("head", (0, top), (0, y0), ("#7a6544", "#a58d66"), [(x0, y0), (x1, y0), (x1, top), (left, top)]),
        ("sill", (0, bottom), (0, y1), ("#fdf0cf", "#dcc79d"), [(x0, y1), (left, bottom), (x1, bottom), (x1, y1)]),
    ):
        sheet.gradient(name, away, here, *colours)
        inks = [{"texture": name}, ink("Plaster", "#8d7650", 0.25, 120)]
        sheet.fill(points, 0.6, colour=colours[1], ink=inks)


def floor(sheet: Sheet) -> None:
    """A tile that is painted on a torus, and laid in rows that are ever larger to the front."""
    wide, high = 128, 40
    sheet.layer("Tile", wrap=[0, 0, 0, wide, high])
    sheet.fill(
        box(0, 0, wide, high),
        colour="#b5673f",
        ink=[ink("rock", "#7c3a22", 0.75, 128), ink("rock", "#d99a68", 0.3, 64)],
    )
    sheet.all_free()
    for points in ([(0, 0), (wide, 0)], [(0, 0), (0, high)]):
        sheet.stroke([(*p, 1) for p in points], 1.3, colour="#5b3a2c", hardness=0.6)
    sheet.stroke([(4, 2.4, 1), (wide - 3, 2.4, 1)], 0.7, colour="#e3ac7c", opacity=0.7)
    sheet.stroke([(*p, 1) for p in ring(64, 20, 15, 60, 0.62)], 1.2, colour="#f0d9a8")
    sheet.fill(ring(64, 20, 12, 48, 0.62), 0.5, colour="#3f6f73", ink=[ink("rock", "#1e4448", 0.6, 60)])
    sheet.fill(ring(64, 20, 4.5, 32, 0.62), 0.4, colour="#f0d9a8")
    for corner in (0, wide):
        for y in (0, high):
            sheet.fill(
                [(corner - 22, y), (corner, y - 13), (corner + 22, y), (corner, y + 13)],
                0.4,
                colour="#ead6ab",
                ink=[ink("rock", "#b79a66", 0.6, 80)],
            )
    sheet.all_free()
    sheet.lines.append({"do": "layer", "set": "Tile", "visible": False})
    sheet.add("Floor", kind="group")
    y, scale, row = float(FLOOR), 0.5, 0
    while y < HEIGHT:
        deep = high * scale
        name, group = f"tiles {row + 1}", f"row {row + 1}"
        sheet.lines.append({"do": "layer", "add": group, "kind": "group", "group": "Floor"})
        at = [round(WIDTH / 2 + (row % 2) * wide * scale / 2), round(y)]
        levels = math.floor(math.log2(scale))
        laid = {"kind": "placement", "of": "Tile", "rect": [0, 0, 0, wide, high], "repeat": True, "group": group}
        sheet.lines.append(
            {"do": "layer", "add": name, **laid, "at": at, "levels": levels, "c": [scale / 2.0**levels, 0]}
        )
        end = y + deep
        sheet.region(box(-8, round(y), WIDTH + 8, round(end)))
        sheet.lines.append({"do": "layer", "set": group, "mask": True})
        y, scale, row = end, scale * 1.24, row + 1
    sheet.all_free()
