"""What of a brush can follow the pen, the stroke and chance, as one table: settings, its tip, its colour."""

from __future__ import annotations

from dataclasses import dataclass

# Their numbers, in the order of the table; INK_AMOUNT is that of the first component of the ink.
RADIUS, OPACITY, FLOW, HARDNESS, SPACING, ANGLE, RATIO, SCATTER, HUE, LIGHTNESS, CHROMA, INK_AMOUNT = range(12)
INKS = 8


@dataclass(frozen=True, slots=True)
class Target:
    """A row: its value at a dab is the brush's times what the curves of its inputs give, within `lo`..`hi`.

    `turns`: its value is an angle, to which they add as parts of a full turn, so that 1 leaves it, as it does others.
    `own`: its value, of a target that is no setting of the brush or of its tip.
    """

    name: str
    label: str
    lo: float
    hi: float
    turns: bool = False
    own: float | None = None


FOLLOWERS: dict[str, Target] = {
    row.name: row
    for row in (
        Target("radius", "Radius", 0.0, 4000.0),
        Target("opacity", "Opacity", 0.0, 1.0),
        Target("flow", "Flow", 0.0, 1.0),
        Target("hardness", "Hardness", 0.0, 1.0),
        Target("spacing", "Spacing", 0.0, 16.0),
        Target("angle", "Angle", -1e6, 1e6, turns=True),
        Target("ratio", "Roundness", 0.01, 1.0),
        Target("scatter", "Scatter", 0.0, 16.0),
        Target("hue", "Hue", -1e6, 1e6, turns=True, own=0.0),
        Target("lightness", "Lightness", 0.0, 16.0, own=1.0),
        Target("chroma", "Chroma", 0.0, 16.0, own=1.0),
        *(Target(f"ink_{n}", f"Ink {n}", 0.0, 16.0, own=1.0) for n in range(1, INKS + 1)),
    )
}
COLOUR_TARGETS = ("hue", "lightness", "chroma")
