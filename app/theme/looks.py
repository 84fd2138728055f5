"""The looks of the window: colours of panels, texts and controls, neutral greys so that colours are judged well.

Which colours lie on which, and how far they have to differ, is told here too; a test computes it for every look.
"""

from __future__ import annotations

from typing import NamedTuple

Tone = tuple[float, float, float]  # sRGB, 0..1
TEXT_CONTRAST, CONTROL_CONTRAST = 4.5, 3.0  # WCAG 2.1, AA


def _grey(value: float) -> Tone:
    return value, value, value


class WindowLook(NamedTuple):
    """`text`, `soft` and `quiet`: what is read, names of what is set, hints.  Grounds: `panel`, `popup`, `shade` of
    menus and the status line, `field`, `raised` for buttons, which `hover` and `pressed` follow, `card` of a list and
    `card_lit`, `filled` of a slider and `filled_lit`, `accent_soft` of what is chosen.  Marks: `accent`, `warn`, `knob`
    of a switch that is off, `grab` of a slider, `edge` around boxes that are ticked, `line` between panels, `border`
    and `grid`, which only adorn.  `frames`: how wide an edge fields and buttons have, points; `dimmed`: how opaque what
    cannot be used is."""

    title: str
    hint: str
    text: Tone
    soft: Tone
    quiet: Tone
    panel: Tone
    popup: Tone
    shade: Tone
    field: Tone
    raised: Tone
    hover: Tone
    pressed: Tone
    card: Tone
    card_lit: Tone
    filled: Tone
    filled_lit: Tone
    accent: Tone
    accent_soft: Tone
    warn: Tone
    knob: Tone
    grab: Tone
    edge: Tone
    line: Tone
    border: Tone
    grid: Tone
    frames: float = 0.0
    dimmed: float = 0.72


LOOKS = {
    "dark": WindowLook(
        "Dark",
        "Dark grey: the painting is the brightest thing",
        text=_grey(0.90),
        soft=_grey(0.80),
        quiet=_grey(0.66),
        panel=_grey(0.165),
        popup=_grey(0.145),
        shade=_grey(0.13),
        field=_grey(0.115),
        raised=_grey(0.235),
        hover=_grey(0.30),
        pressed=_grey(0.37),
        card=_grey(0.19),
        card_lit=_grey(0.215),
        filled=_grey(0.29),
        filled_lit=_grey(0.33),
        accent=(0.53, 0.69, 0.88),
        accent_soft=(0.26, 0.33, 0.41),
        warn=(0.95, 0.65, 0.40),
        knob=_grey(0.62),
        grab=_grey(0.68),
        edge=_grey(0.48),
        line=_grey(0.10),
        border=_grey(0.27),
        grid=_grey(0.19),
    ),
    "light": WindowLook(
        "Light grey",
        "Light grey, for bright rooms",
        text=_grey(0.09),
        soft=_grey(0.20),
        quiet=_grey(0.31),
        panel=_grey(0.85),
        popup=_grey(0.93),
        shade=_grey(0.79),
        field=_grey(0.95),
        raised=_grey(0.755),
        hover=_grey(0.70),
        pressed=_grey(0.64),
        card=_grey(0.80),
        card_lit=_grey(0.77),
        filled=_grey(0.78),
        filled_lit=_grey(0.74),
        accent=(0.09, 0.30, 0.55),
        accent_soft=(0.62, 0.74, 0.88),
        warn=(0.52, 0.20, 0.0),
        knob=_grey(0.36),
        grab=_grey(0.36),
        edge=_grey(0.44),
        line=_grey(0.72),
        border=_grey(0.66),
        grid=_grey(0.84),
        dimmed=0.78,
    ),
    "contrast": WindowLook(
        "High contrast",
        "White on black, with edges around everything that can be used",
        text=_grey(1.0),
        soft=_grey(1.0),
        quiet=_grey(0.82),
        panel=_grey(0.0),
        popup=_grey(0.0),
        shade=_grey(0.0),
        field=_grey(0.0),
        raised=_grey(0.10),
        hover=_grey(0.24),
        pressed=_grey(0.32),
        card=_grey(0.07),
        card_lit=_grey(0.16),
        filled=(0.0, 0.24, 0.44),
        filled_lit=(0.0, 0.30, 0.54),
        accent=(1.0, 0.85, 0.20),
        accent_soft=(0.0, 0.28, 0.60),
        warn=(1.0, 0.72, 0.45),
        knob=_grey(0.85),
        grab=_grey(1.0),
        edge=_grey(0.75),
        line=_grey(0.60),
        border=_grey(0.60),
        grid=_grey(0.25),
        frames=1.0,
        dimmed=0.70,
    ),
}
USUAL_LOOK = "dark"

# What is read or used, and what it lies on.
TEXTS: dict[str, tuple[str, ...]] = {
    "text": (
        "panel", "popup", "shade", "field", "raised", "hover", "pressed", "card", "card_lit", "filled", "filled_lit",
        "accent_soft",
    ),
    "soft": ("panel", "popup", "shade", "field", "filled", "filled_lit", "card", "card_lit", "accent_soft"),
    "quiet": ("panel", "popup", "shade", "field", "card", "card_lit", "raised"),
    "accent": ("panel", "popup", "shade", "field"),
    "warn": ("panel", "popup", "shade", "field"),
}  # fmt: skip
CONTROLS: dict[str, tuple[str, ...]] = {
    "knob": ("raised", "hover"),
    "grab": ("field", "filled", "filled_lit"),
    "edge": ("panel", "popup", "field"),
    "accent": ("accent_soft",),
}


def contrast(one: Tone, other: Tone) -> float:
    """Returns the contrast of two colours, 1 to 21, as WCAG 2.1 defines it."""
    lighter, darker = sorted((_luminance(one), _luminance(other)), reverse=True)
    return (lighter + 0.05) / (darker + 0.05)


def tone_over(upper: Tone, lower: Tone, alpha: float) -> Tone:
    """Returns a colour laid over another one, as the card does it."""
    r, g, b = (alpha * a + (1 - alpha) * z for a, z in zip(upper, lower, strict=True))
    return r, g, b


def _luminance(tone: Tone) -> float:
    red, green, blue = (v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in tone)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue
