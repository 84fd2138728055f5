"""How the painting is looked at: plainly, or lit by its own relief.  Nothing of it is stored in the painting."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from engine.light.light import BY_ALPHA, BY_IMPASTO, BY_PICTURE, Light
from engine.studio.results import Scene

NO_LAYERS = BY_PICTURE, BY_ALPHA, BY_IMPASTO  # what heights are taken from, if not from a layer
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

    def keep_to(self, scene: Scene | None) -> None:
        """Takes the heights from the picture where they were a layer's that the painting does not have."""
        known = {*NO_LAYERS, *(row.name for row in scene.layers)} if scene is not None else {self.light.height}
        if self.light.height not in known:
            self.light = replace(self.light, height=BY_PICTURE)


def height_layers(scene: Scene | None) -> tuple[str, ...]:
    """Returns what heights may be taken from by name: layers, groups and placements, from the top, but that of the role
    "height" before all others."""
    rows = () if scene is None else scene.layers
    named = [row for row in rows if row.name not in NO_LAYERS]
    return tuple(row.name for row in sorted(named, key=lambda row: not row.height))


def sun_at(x: float, y: float) -> tuple[float, float]:
    """Returns azimuth and altitude, whole degrees, of a sun that stands over a point of a dome of radius one, which is
    seen from above; outside of it, of the nearest one that is allowed."""
    altitude = math.degrees(math.acos(min(1.0, math.hypot(x, y))))
    return round(math.degrees(math.atan2(x, -y))) % 360, max(LEAST_ALTITUDE, round(altitude))
