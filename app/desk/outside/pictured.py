"""Pictures as ink: a file, or what is in view, becomes a texture of the painting (feature P8)."""

from __future__ import annotations

from collections.abc import Container
from pathlib import Path

from immutables import Map

from app.desk.desk import Desk
from engine.numeric.address import Rect
from engine.painting.commands import DefineTexture
from engine.studio.requests import Do

DETAIL = 2  # finer levels that a piece of the canvas keeps
NAME_LENGTH = 24


def from_file(desk: Desk, path: Path) -> None:
    """Asks for a texture made of a picture file; it joins the ink as soon as it is there."""
    _define(desk, texture_of(desk, path))


def texture_of(desk: Desk, path: Path) -> DefineTexture:
    """Returns what makes a texture of a picture file, under a name that none has yet."""
    told = Map({"path": str(path.absolute()), "detail": "learnt", "profile": True})
    return DefineTexture(free_texture_name(desk, path.stem), "image", told)


def from_view(desk: Desk) -> None:
    """Asks for a texture made of what the window shows of the canvas, at the level shown."""
    rect = seen(desk)
    arguments = {"rect": (desk.view.shown_level, rect.x0, rect.y0, rect.width, rect.height), "detail": DETAIL}
    _define(desk, DefineTexture(free_texture_name(desk, "View"), "canvas", Map(arguments)))


def kept_view(desk: Desk) -> str:
    """Defines a texture of what the window shows of the canvas, which does not join the ink; its name."""
    rect, name = seen(desk), free_texture_name(desk, "View")
    arguments = {"rect": (desk.view.shown_level, rect.x0, rect.y0, rect.width, rect.height)}
    desk.post(Do(DefineTexture(name, "canvas", Map(arguments))))
    return name


def seen(desk: Desk) -> Rect:
    """Returns the pixels of the level shown that no panel covers."""
    x0, y0, x1, y1 = desk.free_area()
    level = desk.view.shown_level
    corners = [desk.view.to_canvas(x, y).pixel(level) for x in (x0, x1) for y in (y0, y1)]
    xs, ys = [x for x, _ in corners], [y for _, y in corners]
    return Rect(min(xs), min(ys), max(max(xs), min(xs) + 1), max(max(ys), min(ys) + 1))


def _define(desk: Desk, command: DefineTexture) -> None:
    desk.asked.texture = command.name
    desk.post(Do(command))


def free_texture_name(desk: Desk, stem: str) -> str:
    """Returns a name that no texture has yet."""
    scene = desk.known.scene
    return free_stem(stem, {row.name for row in desk.known.tables.kinds} | set(scene.textures if scene else ()))


def free_layer_name(desk: Desk, stem: str) -> str:
    """Returns a name that no layer has yet."""
    scene = desk.known.scene
    return free_stem(stem, {row.name for row in scene.layers} if scene else set())


def free_stem(stem: str, taken: Container[str], most: int = NAME_LENGTH) -> str:
    """Returns a file's name, or what of it is short enough, with a number behind it where that is taken."""
    stem = "".join(letter for letter in stem if letter.isprintable())[:most].strip() or "Picture"
    name, number = stem, 1
    while name in taken or name.lower() in taken:
        number += 1
        name = f"{stem} {number}"
    return name
