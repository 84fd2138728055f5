"""How the painting is looked at: plainly, or lit by its own relief.  Nothing of it is stored in the painting."""

from __future__ import annotations

import math
from dataclasses import dataclass

from engine.light.light import Light

LEAST_ALTITUDE = 5.0  # degrees that the sun may be dragged down to


@dataclass(slots=True)
class LightState:
    """`light`: as it was last set, whether it is `on` or not."""

    on: bool = False
    light: Light = Light()  # noqa: RUF009  # it never changes

    @property
    def shown(self) -> Light | None:
        """Gives the light that the canvas is seen in; None for none."""
        return self.light if self.on else None


def sun_at(x: float, y: float) -> tuple[float, float]:
    """Returns azimuth and altitude, whole degrees, of a sun that stands over a point of a dome of radius one, which is
    seen from above; outside of it, of the nearest one that is allowed."""
    altitude = math.degrees(math.acos(min(1.0, math.hypot(x, y))))
    return round(math.degrees(math.atan2(x, -y))) % 360, max(LEAST_ALTITUDE, round(altitude))
