"""Height maps from outside that become ground of the land: read beside the window, then asked about, then laid."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from immutables import Map

from app.canvas.view import Place
from app.desk.desk import Desk, FileWork
from app.desk.outside.bringing import picture_level
from app.desk.outside.found_map import FoundMap
from app.desk.outside.pictured import free_layer_name, free_texture_name
from engine.checks.roles import AS_HEIGHT
from engine.numeric.address import Rect
from engine.painting.commands import AddLayer, DefineTexture, LayGround, SetLayer
from engine.studio.requests import Do

_LAND = "Land"  # the layer, where there is none of heights


@dataclass(frozen=True, slots=True)
class _ReadMap(FileWork):
    path: Path
    place: Place

    def carry_out(self) -> FoundMap:
        from engine.session.landforms.laid_map import map_in, usual_ends  # here: it takes its time to load

        held, found = map_in(str(self.path))
        height, width = found.heights.shape
        ends = usual_ends(found, Rect.at(0, 0, width, height))
        return FoundMap(self.path, self.place, held, found.told, (width, height), ends, found.pixel is not None)

    def arrive(self, desk: Desk, found: FoundMap) -> None:
        desk.asked.ground = found
        desk.asked.show("ground")
        desk.say("")


def read_map(desk: Desk, path: Path, place: Place) -> None:
    """Reads a height map, then asks how high it is to be."""
    desk.say(f"Reading {path.name}")
    desk.work(_ReadMap(path, place))


def lay_map(desk: Desk, found: FoundMap, ends: tuple[float, float], rock: float, rim: float) -> None:
    """Lays a map as ground of the land, a pixel on a pixel of the level seen, its middle where it was dropped; makes a
    layer of heights where there is none."""
    level = picture_level(desk.view.shown_level)
    x, y = found.place.pixel(level)
    width, height = found.size
    texture = free_texture_name(desk, found.path.stem)
    told = Map({"path": str(found.path.absolute()), "holds": "file", "sha": found.held.sha})
    desk.post(Do(DefineTexture(texture, "image", told), lent=found.held))
    scene = desk.known.scene
    if scene is None or not any(row.height for row in scene.layers):
        name = free_layer_name(desk, _LAND)
        desk.post(Do(AddLayer(name)))
        desk.post(Do(SetLayer(name, role=AS_HEIGHT)))
    rect = Rect.at(x - width // 2, y - height // 2, width, height)
    desk.post(Do(LayGround(texture, rect, level, None, ends, rock=rock, rim=rim)))
    desk.say(f"Laying “{found.path.stem}” as ground; Terrain shows it")
