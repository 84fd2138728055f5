"""Brushes that place things along the stroke: one of each generator that comes along."""

from __future__ import annotations

import re

from immutables import Map

from app.desk.holding.dipping import FIXED, INK
from app.desk.presets import Preset
from engine.brush import settings
from engine.painting.commands import DefineTexture
from engine.texture.expression.library.bundled_texts import LibraryText, generator_library

GENERATORS = "Generators"
_OF_INK = re.compile(rf"^{INK} = pick\((#\w+)\)$", re.MULTILINE)  # a text that goes along with the hand's colour


def generator_brushes() -> list[Preset]:
    """Returns the brushes, by name; a definition holds its text, so that a painting keeps its pixels."""
    return [_preset(one) for one in generator_library().values()]


def _preset(one: LibraryText) -> Preset:
    drawn = _OF_INK.search(one.text)  # roofs and leaves have colours of their own
    colour = {FIXED: True} if drawn is None else {"values": {INK: drawn[1]}}
    ink = [{"texture": one.title, "amount": 1, **colour}]
    told = {"mode": "generate", "radius": 48, "spacing": 0.1, "ink": ink, "dynamics": {"radius": [[0, 0.4], [1, 1]]}}
    definition = DefineTexture(one.title, "expression", Map({"text": one.text}))
    return Preset(one.title, settings.from_json(told), None, GENERATORS, (definition,), tags=tuple(one.about.split()))
