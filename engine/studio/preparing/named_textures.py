"""What makes a brush ready that names textures of the painting: they go along, as the process does not know these.

Without them its exercise would end where the brush is refused, and count as done: the engine's thread would compile.
"""

from __future__ import annotations

from dataclasses import replace

from engine.brush.settings import textures_of
from engine.makers.definitions import portable
from engine.painting.value import Painting
from engine.studio.preparing.job_queue import Job, job_of
from engine.studio.requests import Swatch


def job_within(painting: Painting, swatch: Swatch) -> Job:
    """Returns what compiles all that a swatch's brush needs, with those textures of a painting that it names."""
    brought = {definition.name for definition in swatch.textures}
    lent = []
    for name in textures_of(swatch.brush):
        texture = None if name in brought else painting.textures.get(name)
        found = None if texture is None else portable(name, texture.kind, texture.parameters)
        if found is not None:
            lent.append(found)
    return job_of(replace(swatch, textures=(*swatch.textures, *lent)) if lent else swatch)
