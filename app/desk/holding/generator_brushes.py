"""Brushes that place things along the stroke: one of each generator that comes along."""

from __future__ import annotations

from immutables import Map

from app.desk.presets import Preset
from engine.brush import settings
from engine.painting.commands import DefineTexture
from engine.texture.expression.library.bundled_texts import LibraryText, generator_library

GENERATORS = "Generators"


def generator_brushes() -> list[Preset]:
    """Returns the brushes, by name; a definition holds its text, so that a painting keeps its pixels."""
    return [_preset(one) for one in generator_library().values()]


def _preset(one: LibraryText) -> Preset:
    ink = [{"texture": one.title, "amount": 1, "fixed": True}]  # roofs and leaves have colours of their own
    told = {"mode": "generate", "radius": 48, "spacing": 0.1, "ink": ink, "dynamics": {"radius": [[0, 0.4], [1, 1]]}}
    definition = DefineTexture(one.title, "expression", Map({"text": one.text}))
    return Preset(one.title, settings.from_json(told), None, GENERATORS, (definition,), tags=tuple(one.about.split()))
