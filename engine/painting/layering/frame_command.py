"""The command that gives a painting another frame; no paint changes, in it or outside."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from immutables import Map

from engine.brush.checks import thawed
from engine.files.strict_json import Fields
from engine.numeric.address import Rect
from engine.painting.places import PLACE_LIMIT

LONGEST_SIDE = 1 << 40  # pixels of level 0


@dataclass(frozen=True, slots=True)
class SetFrame:
    """Another frame, in pixels of level 0."""

    rect: Rect
    extra: Map[str, Any] = Map()  # noqa: RUF009  # it never changes


def read_frame(members: Fields) -> SetFrame:
    """Reads the command; `write_frame` is the inverse."""
    x, y, width, height = members.integers("rect", 4, limit=PLACE_LIMIT)
    if not (1 <= width <= LONGEST_SIDE and 1 <= height <= LONGEST_SIDE):
        raise members.fault("rect", "[X, Y, W, H], W and H from 1 to 2^40")
    return SetFrame(Rect.at(x, y, width, height), members.rest())


def write_frame(command: SetFrame) -> dict[str, Any]:
    """Tells its members."""
    rect = command.rect
    return {"rect": [rect.x0, rect.y0, rect.width, rect.height], **thawed(command.extra)}
