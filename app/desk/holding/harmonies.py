"""Colours that go with the present one: those across the wheel from it, and lighter, darker and duller ones."""

from __future__ import annotations

from dataclasses import dataclass

from app.desk.colours import GREY, RGB, from_oklch, to_oklch


@dataclass(frozen=True, slots=True)
class Harmony:
    """A row: what it is called, how it is told, and how far round the wheel the others lie, degrees."""

    title: str
    hint: str
    turns: tuple[float, ...] = ()


HARMONIES = {
    "": Harmony("No harmony", "No marks on the wheel"),
    "complement": Harmony("Complement", "The colour across the wheel", (180.0,)),
    "analogous": Harmony("Analogous", "The neighbours on both sides", (-30.0, 30.0)),
    "split": Harmony("Split complement", "Both neighbours of the colour across the wheel", (150.0, 210.0)),
    "triad": Harmony("Triad", "Three colours, a third of the wheel apart", (120.0, 240.0)),
    "tetrad": Harmony("Tetrad", "Four colours, a quarter of the wheel apart", (90.0, 180.0, 270.0)),
}
SHADES = 7  # of each row, the middle one the colour itself
_DULL, _DARKEST, _LIGHTEST = 0.45, 0.08, 0.97  # of the chroma; OkLCH lightness of the ends


def harmony(lch: RGB, name: str) -> list[RGB]:
    """Returns the other colours of a harmony, as lightness, chroma and hue; a grey has none."""
    light, chroma, hue = lch
    turns = HARMONIES[name].turns if name in HARMONIES and chroma >= GREY else ()
    return [(light, chroma, (hue + turn) % 360) for turn in turns]


def shades(rgb: RGB) -> tuple[tuple[RGB, ...], tuple[RGB, ...]]:
    """Returns a row from dark to light with the colour in its middle, and one as light that are duller."""
    light, chroma, hue = to_oklch(rgb)
    middle = SHADES // 2
    row, low, high = [], min(_DARKEST, light), max(_LIGHTEST, light)
    for i in range(SHADES):
        part = (i - middle) / middle
        row.append(light + part * (high - light if part > 0 else light - low))
    rows = [tuple(from_oklch(one, chroma * scale, hue) for one in row) for scale in (1.0, _DULL)]
    return (*rows[0][:middle], rgb, *rows[0][middle + 1 :]), rows[1]
