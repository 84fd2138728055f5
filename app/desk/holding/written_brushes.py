"""Brushes of the written textures that come along: all over with one each, or, of lines alone, thinned by it."""

from __future__ import annotations

from immutables import Map

from app.desk.presets import Preset
from engine.brush import settings
from engine.brush.settings import Brush
from engine.painting.commands import DefineTexture
from engine.texture.expression.library.bundled_texts import LibraryText, written_library

GROUP = "Written"
_SHAPE = {"radius": 48, "hardness": 0.95, "spacing": 0.12, "dynamics": {"radius": [[0, 0.6], [1, 1]]}}


def written_brushes() -> list[Preset]:
    """Returns the brushes, by name; a definition holds its text, so that a painting keeps its pixels."""
    return [
        Preset(one.title, _brush(one), None, GROUP, (_definition(one.title, one.text),), tags=_tags(one.about))
        for _, one in sorted(written_library().items())
    ]


def _definition(title: str, text: str) -> DefineTexture:
    return DefineTexture(title, "expression", Map({"text": text}))


def _brush(one: LibraryText) -> Brush:
    part = {"texture": one.title, "amount": 1}
    if one.in_lines:  # of the hand's colour, the paper free between them
        return settings.from_json({**_SHAPE, "density": part})
    return settings.from_json({**_SHAPE, "ink": [{**part, "fixed": True}]})  # it has colours of its own


def _tags(about: str) -> tuple[str, ...]:
    return tuple(about.split())
