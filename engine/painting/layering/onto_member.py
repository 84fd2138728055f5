"""The member `onto` of strokes and fills: whether they go to a layer's paint or to its mask."""

from __future__ import annotations

from engine.files.strict_json import Fields

ONTO_PAINT, ONTO_MASK = "", "mask"


def read_onto(members: Fields) -> str:
    """Returns what a stroke or fill goes to; FieldError if it is neither paint nor mask."""
    if members.take("onto", None) is None:
        return ONTO_PAINT
    if members.take("onto") != ONTO_MASK:
        raise members.fault("onto", '"mask", or nothing for paint')
    return ONTO_MASK
