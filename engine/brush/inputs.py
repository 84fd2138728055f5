"""What a brush's settings can follow besides the pen's pressure, as one table: light to import, for the window too.

Each input is a number at every dab, in its own unit; a curve of it gives the factor by which a setting is multiplied.
"""

from __future__ import annotations

from dataclasses import dataclass

# Their numbers, in the order of the table.
PRESSURE, TILT, TILT_DIRECTION, ROTATION, DIRECTION, SPEED, DISTANCE, DAB_NUMBER, RANDOM_DAB, RANDOM_STROKE = range(10)
PEN = 10  # after them, what a tip that follows the pen is turned by: its barrel, or where it leans
_FARTHEST = 1e9


@dataclass(frozen=True, slots=True)
class Input:
    """A row: `most` is the highest place of a knot, `span` what a new curve goes over; `open_ended`: the span is the
    artist's to choose."""

    name: str
    label: str
    tooltip: str
    unit: str = ""
    most: float = 1.0
    span: float = 1.0

    @property
    def open_ended(self) -> bool:
        """Tells whether it has no natural end."""
        return self.most == _FARTHEST

    @property
    def in_pixels(self) -> bool:
        """Tells whether it is measured in pixels of the stroke's level."""
        return self.unit.startswith("px")


INPUTS: dict[str, Input] = {
    row.name: row
    for row in (
        Input("pressure", "Pressure", "How firmly the pen is pressed"),
        Input("tilt", "Tilt", "How far the pen leans: 0 upright, 90 lying", "°", 90.0, 90.0),
        Input(
            "tilt_direction", "Tilt direction", "Where the pen leans to, clockwise from the right", "°", 360.0, 360.0
        ),
        Input("rotation", "Rotation", "How the pen's barrel is turned", "°", 360.0, 360.0),
        Input("direction", "Direction", "Where the stroke goes, clockwise from the right", "°", 360.0, 360.0),
        Input("speed", "Speed", "How fast the pen goes", "px/s", _FARTHEST, 2000.0),
        Input("distance", "Distance", "How long the stroke is up to here", "px", _FARTHEST, 1000.0),
        Input("fade", "Fade", "How many dabs the stroke has up to here", "dabs", _FARTHEST, 100.0),
        Input("random_dab", "Random by dab", "Another number for every dab"),
        Input("random_stroke", "Random by stroke", "Another number for every stroke"),
    )
}
NUMBERS = {name: number for number, name in enumerate(INPUTS)}
