"""Files of layers from outside: their layers come into the painting as a group, in one step; those of our own files
exactly, with all that they have, those of other programs as pictures."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from immutables import Map

from app.canvas.view import Place
from app.desk.desk import Desk, FileWork
from app.desk.notices import Notice
from app.desk.outside.arriving import expect
from app.desk.outside.bringing import picture_level
from app.desk.outside.pictured import free_layer_name, free_stem, free_texture_name
from app.desk.previews import PAINTING
from engine.checks.roles import MAX_NAME
from engine.files.layered.layer_sheet import FoundGroup, FoundLayers, FoundPicture
from engine.numeric.address import Rect
from engine.numeric.arithmetic import FINE
from engine.painting.commands import AddPainting, AddPictures, DefineTexture
from engine.painting.layering.painting_member import NamedNode
from engine.painting.layering.pictures_member import Brought, BroughtGroup, BroughtPicture
from engine.studio.requests import Do

if TYPE_CHECKING:
    from engine.texture.image import ImageSource

_NOTES = 20  # lines that are told
_ALIGNED = 16  # pixels, by whose multiples a painting is moved: what it shows again smaller lies on whole pixels, too


@dataclass(frozen=True, slots=True)
class _Read:
    found: FoundLayers
    sheet: ImageSource


@dataclass(frozen=True, slots=True)
class _Whole:
    """A painting of ours: the bytes of its file, its layers as they are called there, its frame, and what is to be
    told."""

    held: ImageSource
    children: tuple[NamedNode, ...]
    frame: Rect
    notes: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class _LayLayers(FileWork):
    """`place`: None for where the painting itself has its layers; `grid`: of the painting that they come into."""

    path: Path
    place: Place | None
    grid: int

    def carry_out(self) -> _Read | _Whole:
        if self.path.suffix.lower() != PAINTING:
            return self._pictures()
        found = self._whole()
        return self._pictures(found) if isinstance(found, str) else found

    def _pictures(self, why: str = "") -> _Read:
        from engine.files.layered.reading_layers import read_layers  # here: it takes its time to load
        from engine.painting.capture import read_straight
        from engine.texture.image import ImageSource

        found = read_layers(self.path)
        if why:
            found = replace(found, notes=(f"its layers come in as pictures: {why}", *found.notes))
        return _Read(found, ImageSource.of_raster(self.path.stem, read_straight(str(self.path), None)))

    def _whole(self) -> _Whole | str:
        """Returns the painting, or why it cannot come in as it is: nothing where another program wrote it."""
        from engine.archive.others import carried_painting
        from engine.files.fault import FileError
        from engine.painting.capture import read_bytes
        from engine.texture.image import ImageSource

        try:
            held = ImageSource.of_raster(self.path.name, read_bytes(str(self.path), None))
            if not carried_painting.is_ours(held):
                return ""
            opened = carried_painting.open_carried(held)
        except FileError as error:
            return error.message
        painting, notes = opened.painting, opened.notes
        if not opened.native:
            return (*notes, "another program changed it")[0]
        if painting.grid != self.grid:
            return "its colours are kept in other steps"
        if painting.paper is not None:
            notes = (*notes, "its paper is left out: a group has none")
        return _Whole(held, carried_painting.names_of(painting.root), painting.frame, notes)

    def arrive(self, desk: Desk, found: _Read | _Whole) -> None:
        if isinstance(found, _Whole):
            _lay_whole(desk, self.path, found, self.place)
        else:
            place = desk.view.to_canvas(*desk.middle()) if self.place is None else self.place
            lay_layers(desk, self.path, found.found, found.sheet, place)


def as_group(desk: Desk, path: Path, place: Place | None) -> None:
    """Brings a file's layers in as a group, a pixel on a pixel of the level seen, with the middle of its image at a
    place; a painting without one lies where it does by itself.  Then it can be moved."""
    desk.say(f"Bringing in the layers of {path.name}")
    scene = desk.known.scene
    desk.work(_LayLayers(path, place, FINE if scene is None else scene.grid))


def _lay_whole(desk: Desk, path: Path, found: _Whole, place: Place | None) -> None:
    level, at = 0, (0, 0)
    if place is not None:
        level = picture_level(desk.view.shown_level)
        x, y = place.pixel(level)
        corner = x - found.frame.x0 - found.frame.width // 2, y - found.frame.y0 - found.frame.height // 2
        at = (corner[0] & -_ALIGNED, corner[1] & -_ALIGNED)
    texture, name = free_texture_name(desk, path.stem), free_layer_name(desk, path.stem)
    scene = desk.known.scene
    taken = {name, *(row.name for row in scene.layers)} if scene is not None else {name}
    told = Map({"path": str(path.absolute()), "holds": "file", "sha": found.held.sha})
    desk.post(Do(DefineTexture(texture, "image", told), lent=found.held))
    desk.post(Do(AddPainting(name, texture, _free(found.children, taken), level, at)))
    if found.notes:
        _tell(desk, path, found.notes)
    drag, still = f"Drag “{name}” where it belongs", f"“{name}” lies where it does by itself"
    expect(desk, name, still if place is None else drag)


def _free(nodes: tuple[NamedNode, ...], taken: set[str]) -> tuple[NamedNode, ...]:
    """Returns nodes under names that none has yet, which they join."""
    out = []
    for node in nodes:
        name = free_stem(node.name, taken, MAX_NAME - 12)
        taken.add(name)
        out.append(NamedNode(name, None if node.children is None else _free(node.children, taken)))
    return tuple(out)


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
    expect(desk, name, f"Drag “{name}” where it belongs")


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
