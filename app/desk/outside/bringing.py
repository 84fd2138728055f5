"""Pictures from outside: one that is dropped or chosen becomes a layer, a texture, an example, or is opened."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from immutables import Map

from app.canvas.view import Place
from app.desk.desk import Desk, FileWork
from app.desk.outside.arriving import expect
from app.desk.outside.pictured import free_layer_name, free_texture_name
from app.desk.previews import OF_HEIGHTS, PAINTING, PHOTOSHOP, PICTURES
from engine.checks.roles import REFERENCE
from engine.painting.commands import AddPicture, DefineTexture
from engine.studio.requests import Do

_FAR = -4  # a level at which little is left of a picture that lies on level 0
_LARGEST = 1 << 24  # pixels of a picture that is extrapolated


def is_picture(path: Path) -> bool:
    """Tells whether a file is a picture, or a map of heights alone, by its name."""
    return path.suffix.lower() in (*PICTURES, *OF_HEIGHTS)


def is_map(path: Path) -> bool:
    """Tells whether a file holds heights alone, by its name."""
    return path.suffix.lower() in OF_HEIGHTS


def is_layered(path: Path) -> bool:
    """Tells whether a file holds layers that may come in as a group, by its name."""
    return path.suffix.lower() in (PAINTING, *PHOTOSHOP)


def offer(desk: Desk, path: Path, place: Place | None = None) -> None:
    """Asks what is to become of a picture, or of layers; laid around `place`, else in the middle of the view."""
    desk.asked.bringing = path, desk.view.to_canvas(*desk.middle()) if place is None else place
    desk.asked.show("bring in")


class Arrival(NamedTuple):
    """How a picture is laid: the layer's role; how strong ink goes on below its pixels, 0..1, None for none; whether
    its colours are converted by the profile in its file."""

    role: str = ""
    detail: float | None = None
    profile: bool = False


@dataclass(frozen=True, slots=True)
class _Lay(FileWork):
    path: Path
    place: Place
    role: str = ""
    detail: float | None = None

    def carry_out(self) -> tuple[int, int, bool]:
        from engine.files.images import picture_size, wants_conversion  # here: it takes its time to load

        return (*picture_size(self.path), wants_conversion(self.path))

    def arrive(self, desk: Desk, found: tuple[int, int, bool]) -> None:
        large = found[0] * found[1] > _LARGEST
        told = Arrival(self.role, None if large else self.detail, found[2])
        lay(desk, self.path, self.path.stem, found[:2], self.place, told)
        if large and self.detail is not None:
            desk.say(f"{self.path.name} is laid as it is: it has more pixels than are extrapolated")


def picture_level(seen: int) -> int:
    """Returns the level at which a picture has its own pixels: where the whole frame is seen, that of the frame's."""
    return 0 if _FAR < seen < 0 else seen


def lay(
    desk: Desk,
    path: Path,
    stem: str,
    size: tuple[int, int],
    place: Place,
    laid: Arrival = Arrival(),  # noqa: B008  # it never changes
) -> None:
    """Lays a picture of `size` (width, height) on a layer of its own, with its middle at a place."""
    level = picture_level(desk.view.shown_level)
    x, y = place.pixel(level)
    texture, at = free_texture_name(desk, stem), (x - size[0] // 2, y - size[1] // 2)
    told: dict[str, Any] = {"path": str(path.absolute())}
    if laid.detail is not None:
        told |= {"detail": "learnt", "strength": round(laid.detail, 3)}
    if laid.profile:
        told["profile"] = True
    desk.post(Do(DefineTexture(texture, "image", Map(told))))
    name = free_layer_name(desk, stem)
    desk.post(Do(AddPicture(name, texture, level, at, laid.role)))
    expect(desk, name, f"Drag “{name}” where it belongs")


def as_layer(desk: Desk, path: Path, place: Place, detail: float | None = None) -> None:
    """Lays a picture on a layer of its own, a pixel on a pixel of the level seen, with its middle at a place; then it
    can be moved.  `detail`: as of `lay`."""
    desk.say(f"Bringing in {path.name}")
    desk.work(_Lay(path, place, detail=detail))


def as_reference(desk: Desk, path: Path, place: Place) -> None:
    """Lays a picture likewise, to be looked at and picked from while one paints; it is no part of what is exported."""
    desk.say(f"Bringing in {path.name}")
    desk.work(_Lay(path, place, REFERENCE))
