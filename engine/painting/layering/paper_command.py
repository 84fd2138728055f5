"""The command that gives a painting another paper, or takes it away; no paint changes."""

from __future__ import annotations

import re
from dataclasses import dataclass

from engine.brush.checks import thawed
from engine.files.strict_json import Fields
from engine.painting.layer_commands import NO_EXTRA, Extra
from engine.painting.layering.placing_members import Members

_COLOUR = re.compile("#[0-9a-fA-F]{6}")


@dataclass(frozen=True, slots=True)
class SetPaper:
    """Another ground under all layers, of one colour "#rrggbb"; None: there is none."""

    colour: str | None
    extra: Extra = NO_EXTRA


def read_colour(members: Fields, name: str) -> str | None:
    """Returns a member that is a paper's colour, in small letters, or null."""
    colour = members.take(name, None)
    if not (colour is None or (isinstance(colour, str) and _COLOUR.fullmatch(colour))):
        raise members.fault(name, 'a colour "#rrggbb" or null')
    return None if colour is None else colour.lower()


def read_set_paper(members: Fields) -> SetPaper:
    """Reads the command; `write_set_paper` is the inverse."""
    if "colour" not in members:
        raise members.fault("colour", 'a colour "#rrggbb" or null')
    return SetPaper(read_colour(members, "colour"), members.rest())


def write_set_paper(command: SetPaper) -> Members:
    """Tells its members."""
    return {"colour": command.colour, **thawed(command.extra)}
