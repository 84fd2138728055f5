"""The few ways in which everything here is modelled: filled with body colour, darkened, lit, sprayed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from scene.easel import Easel, Point
from scene.forms import solid

EVEN: dict[str, Any] = {"dynamics": {}}
THINNING: dict[str, Any] = {"dynamics": {"radius": [[0, 0.1], [1, 1]]}}
_BARE: dict[str, Any] = {"grain": None, "edge": None}
_SOFT: dict[str, Any] = {"ink": None, "hardness": 0, "spacing": 0.15, **EVEN}


def fill(
    easel: Easel, outline: Sequence[Point], radius: float, colours: tuple[str, str], period: float = 110, **more: Any
) -> None:
    """A form in body colour, its edge crisp: the colour and what brush marks in it turn to."""
    body = {"hardness": 0.82, "dynamics": {"radius": [[0, 0], [1, 1]]}, **_BARE, **more}
    rim = body.pop("rim", 1.2)
    marks = {"tints": {"Brush marks": colours[1]}, "periods": {"Brush marks": period}}
    easel.touch("Gouache", solid(outline, radius, rim), 2, radius=radius + 0.2, colour=colours[0], **marks, **body)


def line(
    easel: Easel, path: Sequence[Point], radius: float, colours: tuple[str, str], period: float = 110, **more: Any
) -> None:
    """A line of body colour; its pressure tells its width."""
    marks = {"tints": {"Brush marks": colours[1]}, "periods": {"Brush marks": period}}
    body = {**_BARE, **THINNING, **more}
    easel.touch("Gouache", path, 2, radius=radius, colour=colours[0], **marks, **body)


def shade(
    easel: Easel, path: Sequence[Point], radius: float, colour: str, opacity: float, flow: float, **more: Any
) -> None:
    """Darkens softly by a colour: shadow."""
    _wash(easel, path, radius, colour, opacity=opacity, flow=flow, op="multiply", **more)


def glow(
    easel: Easel, path: Sequence[Point], radius: float, colour: str, opacity: float, flow: float, **more: Any
) -> None:
    """Lightens softly by a colour: light, and what is reflected of it."""
    _wash(easel, path, radius, colour, opacity=opacity, flow=flow, op="screen", **more)


def _wash(easel: Easel, path: Sequence[Point], radius: float, colour: str, fine: int = 1, **more: Any) -> None:
    easel.touch("Soft airbrush", path, fine, radius=radius, colour=colour, mode="raster", **{**_SOFT, **more})


def spray(
    easel: Easel, path: Sequence[Point], radius: float, colour: str, opacity: float, fine: int = 1, **more: Any
) -> None:
    """A soft touch of paint."""
    settings = {"ink": None, **EVEN, **more}
    easel.touch("Soft airbrush", path, fine, radius=radius, colour=colour, opacity=opacity, **settings)
