"""A map of the chosen example while it is painted: which one, with what, and the stroke in progress."""

from __future__ import annotations

from dataclasses import dataclass, field

from immutables import Map

from app.desk.examples.charts import Chart, chart_of
from engine.texture.example.parameters import ORIENTATION, RIM_CHANNEL

USUAL_WIDTH, WIDTHS = 32, (3.0, 160.0)  # of a rim, pixels of the example
_NEAR = 4.0  # px^2 between points
_POINTS, _STROKES = 500, 256


@dataclass(slots=True)
class ChartState:
    """`name`: of the map; `value`: what a stroke tells, 0..1, of a map that tells no way; `radius`: of such a stroke,
    in pixels of the picture; `live`: the stroke in progress; `undone`: strokes that were taken back."""

    name: str = ORIENTATION
    value: float = 1.0
    radius: float = 12.0
    live: list[tuple[float, float]] = field(default_factory=list)
    undone: list[object] = field(default_factory=list)

    def extend(self, x: float, y: float) -> None:
        """The stroke goes on, in pixels of the picture."""
        far = not self.live or (x - self.live[-1][0]) ** 2 + (y - self.live[-1][1]) ** 2 >= _NEAR
        if far and len(self.live) < _POINTS:
            self.live.append((x, y))

    def end(self, maps: Map[str, object], kept: bool) -> Map[str, object]:
        """It ends: the maps with it, if it is kept."""
        points, self.live = self.live, []
        least = 2 if self.name == ORIENTATION else 1
        strokes = strokes_of(maps, self.name)
        if not kept or len(points) < least or len(strokes) >= _STROKES:
            return maps
        stroke: Map[str, object] = Map({"points": tuple((round(x, 1), round(y, 1)) for x, y in points)})
        if self.name != ORIENTATION:
            grey = f"{round(255 * self.value):02x}"
            brush = {"radius": round(self.radius, 1), "hardness": 1.0, "colour": f"#{grey * 3}", "dynamics": Map()}
            stroke = stroke.set("brush", Map(brush))
        self.undone = []
        return with_strokes(maps, self.name, (*strokes, stroke))

    def step(self, maps: Map[str, object], back: bool) -> Map[str, object]:
        """Returns the maps without the last stroke, or with the one that was taken back last."""
        strokes = strokes_of(maps, self.name)
        if back and strokes:
            self.undone.append(strokes[-1])
            return with_strokes(maps, self.name, strokes[:-1])
        if not back and self.undone:
            return with_strokes(maps, self.name, (*strokes, self.undone.pop()))
        return maps


def strokes_of(maps: Map[str, object], name: str) -> tuple[object, ...]:
    """Returns the strokes of a map."""
    found = chart_of(maps.get(name)).get("strokes", ())
    return found if isinstance(found, tuple) else ()


def with_strokes(maps: Map[str, object], name: str, strokes: tuple[object, ...]) -> Map[str, object]:
    """Returns maps of which one has other strokes."""
    return maps.set(name, chart_of(maps.get(name)).set("strokes", strokes))


def rim_width(maps: Map[str, object]) -> int:
    """Returns how wide the rim is, in pixels of the example; 0 where it does not count."""
    if RIM_CHANNEL not in maps:
        return 0
    told = chart_of(maps[RIM_CHANNEL]).get("width", USUAL_WIDTH)
    return told if isinstance(told, int) else USUAL_WIDTH


def with_rim_width(maps: Map[str, object], width: int) -> Map[str, object]:
    """Returns maps with a rim of that width, or none."""
    chart: Chart = chart_of(maps.get(RIM_CHANNEL))
    if width:
        return maps.set(RIM_CHANNEL, chart.set("width", width))
    return maps.delete(RIM_CHANNEL) if RIM_CHANNEL in maps else maps
