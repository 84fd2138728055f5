"""Files of layers from outside: their layers come into the painting as a group, in one step."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from immutables import Map

from app.canvas.view import Place
from app.desk.desk import Desk, FileWork
from app.desk.notices import Notice
from app.desk.outside.bringing import picture_level
from app.desk.outside.pictured import free_layer_name, free_stem, free_texture_name
from engine.files.layered.layer_sheet import FoundGroup, FoundLayers, FoundPicture
from engine.painting.commands import AddPictures, DefineTexture
from engine.painting.layering.pictures_member import Brought, BroughtGroup, BroughtPicture
from engine.studio.requests import Do

if TYPE_CHECKING:
    from engine.texture.image import ImageSource

_NOTES = 20  # lines that are told


@dataclass(frozen=True, slots=True)
class _Read:
    found: FoundLayers
    sheet: ImageSource


@dataclass(frozen=True, slots=True)
class _LayLayers(FileWork):
    path: Path
    place: Place

    def carry_out(self) -> _Read:
        from engine.files.layered.reading_layers import read_layers  # here: it takes its time to load
        from engine.painting.capture import read_straight
        from engine.texture.image import ImageSource

        found = read_layers(self.path)
        return _Read(found, ImageSource.of_raster(self.path.stem, read_straight(str(self.path), None)))

    def arrive(self, desk: Desk, found: _Read) -> None:
        lay_layers(desk, self.path, found.found, found.sheet, self.place)


def as_group(desk: Desk, path: Path, place: Place) -> None:
    """Brings a file's layers in as a group, a pixel on a pixel of the level seen, with the middle of its image at a
    place; then it can be moved."""
    desk.say(f"Bringing in the layers of {path.name}")
    desk.work(_LayLayers(path, place))


def lay_layers(desk: Desk, path: Path, found: FoundLayers, sheet: ImageSource, place: Place) -> None:
    """Has what a file holds laid down; `sheet`: its pictures side by side."""
    level = picture_level(desk.view.shown_level)
    x, y = place.pixel(level)
    texture, name = free_texture_name(desk, path.stem), free_layer_name(desk, path.stem)
    scene = desk.known.scene
    taken = {name, *(row.name for row in scene.layers)} if scene is not None else {name}
    at = (x - found.size[0] // 2, y - found.size[1] // 2)
    told = Map({"path": str(path.absolute()), "sha": sheet.sha})
    desk.post(Do(DefineTexture(texture, "image", told), lent=sheet))
    desk.post(Do(AddPictures(name, texture, _named(found.root, taken), level, at)))
    if found.notes:
        _tell(desk, path, found.notes)
    desk.say(f"Drag “{name}” where it belongs")
    desk.hand.use("move")


def _named(group: FoundGroup, taken: set[str]) -> tuple[Brought, ...]:
    """Returns layers under names that none has yet, which they join."""

    def one(child: FoundPicture | FoundGroup) -> Brought:
        inside = isinstance(child, FoundGroup)
        name = free_stem(child.name.strip() or ("Group" if inside else "Layer"), taken)
        taken.add(name)
        if isinstance(child, FoundGroup):
            below = _named(child, taken)
            return BroughtGroup(name, below, child.opacity, child.visible, child.blend, child.isolated)
        part = (child.part.x0, child.part.y0, child.part.width, child.part.height)
        return BroughtPicture(name, part, child.at, child.opacity, child.visible, child.blend, child.clip)

    return tuple(map(one, group.children))


def _tell(desk: Desk, path: Path, notes: tuple[str, ...]) -> None:
    """Tells what is not as it is in the file: the one line, or how many there are."""
    more = len(notes) - _NOTES
    lines = (*notes[:_NOTES], *([f"and {more} more like these"] if more > 0 else ()))
    text = f"{path.name}: {lines[0] if len(lines) == 1 else f'{len(notes)} things are not as they were'}"
    desk.notices.add(Notice(text, True, (), "bringing", path, lines if len(lines) > 1 else ()))
