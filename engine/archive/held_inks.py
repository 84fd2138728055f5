"""The inks of all paint that a painting has."""

from __future__ import annotations

from engine.canvas import layers
from engine.canvas.layers import Group
from engine.texture.record import Instance


def held_inks(root: Group) -> set[Instance]:
    """Returns the inks of all layers' records; those that lie on disk are told by their pages, which are not read."""
    pyramids = (layer.pyramid for layer in layers.layers(root))
    stacks = {stack for pyramid in pyramids for level in pyramid.levels for stack in pyramid.stacks(level)}
    return set().union(*stacks)
