"""Colours for the panels: sRGB, HSV, OkLCH of single colours, as plain floats.

OkLCH after Ottosson 2020, "A perceptual color space for image processing".
"""

from __future__ import annotations

import cmath
import math

RGB = tuple[float, float, float]
MOST_CHROMA = 0.33  # of any sRGB colour
GREY = 0.015  # chroma below which a colour has no hue to turn others by


def to_hex(rgb: RGB) -> str:
    """Writes a colour as #rrggbb, each channel held to 0..1."""
    return "#" + "".join(f"{round(max(0.0, min(1.0, v)) * 255):02x}" for v in rgb)


def from_hex(text: str) -> RGB:
    """`#rrggbb`; ValueError for anything else."""
    if len(text) != 7 or text[0] != "#":
        raise ValueError(f"colour {text!r}: expected #rrggbb")
    r, g, b = (int(text[i : i + 2], 16) / 255 for i in (1, 3, 5))
    return r, g, b


def _linear(v: float) -> float:
    return v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4


def _encoded(v: float) -> float:
    return 12.92 * v if v <= 0.0031308 else 1.055 * v ** (1 / 2.4) - 0.055


def to_oklch(rgb: RGB) -> RGB:
    """Lightness 0..1, chroma 0..0.33, hue in degrees 0..360."""
    r, g, b = (_linear(v) for v in rgb)
    long = math.cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b)
    mid = math.cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b)
    short = math.cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b)
    lightness = 0.2104542553 * long + 0.7936177850 * mid - 0.0040720468 * short
    a = 1.9779984951 * long - 2.4285922050 * mid + 0.4505937099 * short
    b = 0.0259040371 * long + 0.7827717662 * mid - 0.8086757660 * short
    return lightness, math.hypot(a, b), math.degrees(math.atan2(b, a)) % 360


def _oklch_rgb(lightness: float, chroma: float, hue: float) -> RGB:
    """Linear sRGB, perhaps outside 0..1."""
    a, b = chroma * math.cos(math.radians(hue)), chroma * math.sin(math.radians(hue))
    long = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3
    mid = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3
    short = (lightness - 0.0894841775 * a - 1.2914855480 * b) ** 3
    return (
        4.0767416621 * long - 3.3077115913 * mid + 0.2309699292 * short,
        -1.2684380046 * long + 2.6097574011 * mid - 0.3413193965 * short,
        -0.0041960863 * long - 0.7034186147 * mid + 1.7076147010 * short,
    )


def from_oklch(lightness: float, chroma: float, hue: float) -> RGB:
    """sRGB 0..1: where the colour cannot be shown, the nearest chroma that can, same lightness and hue."""
    lightness = max(0.0, min(1.0, lightness))
    if not _shows(_oklch_rgb(lightness, chroma, hue)):
        chroma = most_chroma(lightness, hue, chroma)
    r, g, b = (_encoded(max(0.0, min(1.0, v))) for v in _oklch_rgb(lightness, chroma, hue))
    return r, g, b


def gone_along(rgb: RGB, old: RGB, new: RGB) -> RGB:
    """Returns the colour that lies to `new` as `rgb` lies to `old`: as much lighter, and as far off in chroma and hue,
    which turn with the hue.  Where there is no room to be so much lighter, or darker, it goes the other way; along with
    a grey all is grey, unless `old` is one, too."""
    if new == old:
        return rgb
    (light, *own), (light_old, *first), (light_new, *then) = (to_oklch(colour) for colour in (rgb, old, new))
    by = light - light_old
    room = 1.0 - light_new if by > 0 else light_new
    by = by if 2.0 * room >= abs(by) else -by
    away = _plane(*own) - _plane(*first)
    if first[0] >= GREY:
        away *= cmath.rect(min(1.0, then[0] / first[0]), math.radians(then[1] - first[1]))
    chroma, hue = cmath.polar(_plane(*then) + away)
    return from_oklch(light_new + by, chroma, math.degrees(hue) % 360)


def _plane(chroma: float, hue: float) -> complex:
    return cmath.rect(chroma, math.radians(hue))


def most_chroma(lightness: float, hue: float, up_to: float = MOST_CHROMA) -> float:
    """Returns the chroma of the most colourful sRGB colour of a lightness and hue."""
    low, high = 0.0, up_to
    for _ in range(12):
        middle = (low + high) / 2
        low, high = (middle, high) if _shows(_oklch_rgb(lightness, middle, hue)) else (low, middle)
    return low


def on_disc(lch: RGB) -> complex:
    """Returns where a colour lies on the disc of its lightness: the hue round it, grey in the middle, and on the rim
    the most colourful that shows."""
    light, chroma, hue = lch
    return _plane(min(1.0, chroma / max(most_chroma(light, hue), 1e-6)), hue)


def off_disc(lightness: float, at: complex) -> RGB:
    """Returns lightness, chroma and hue of what lies at a place of the disc."""
    part, hue = abs(at), math.degrees(cmath.phase(at)) % 360
    return lightness, min(1.0, part) * most_chroma(lightness, hue), hue


def _shows(linear: RGB) -> bool:
    return all(-1e-4 <= v <= 1.0001 for v in linear)
