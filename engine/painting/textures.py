"""Textures that a painting has under names: what the makers make of a definition."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

from immutables import Map

from engine.canvas.tile_cache import TileCache
from engine.numeric.arithmetic import LIBRARY
from engine.painting.commands import DefineTexture
from engine.painting.layering.touch_command import NO_TOUCHES, Touches
from engine.texture.expression.defined import anew
from engine.texture.image import ImageSource
from engine.texture.record import Instance
from engine.texture.table import EXPRESSION, KINDS, instance, of_keys

LEARNT_SHA = "maps_sha"  # the member of a definition by which what was learnt is known again


@dataclass(frozen=True, eq=False, slots=True)
class Texture:
    """`kind`: a row of KINDS; `parameters`: those that the definition gives, a brush may give others on top;
    `source`: the picture of an image; `mask`: of an example, white where the region is that is grown, None where that
    goes by alpha; `arithmetic`: that of its painting; `maps`: what was learnt of the picture, kept as one; `control`:
    the planes of an example's control channels, one below the other; `named`: those of textures that a text names."""

    kind: str
    parameters: Map[str, Any]
    source: ImageSource | None = None
    mask: ImageSource | None = None
    arithmetic: int = LIBRARY
    maps: ImageSource | None = None
    control: ImageSource | None = None
    named: tuple[ImageSource, ...] = ()

    @property
    def pictures(self) -> tuple[ImageSource, ...]:
        """Gives all pictures that it needs."""
        return (*(() if self.source is None else (self.source,)), *self.beside.values(), *self.named)

    @property
    def beside(self) -> dict[str, ImageSource]:
        """Gives all but its own picture, by the names that they have in a file."""
        held = {"mask": self.mask, "maps": self.maps, "control": self.control}
        return {name: one for name, one in held.items() if one is not None}

    def lent(self, pictures: Mapping[str, ImageSource]) -> Texture:
        """Returns it with those of some pictures, by their sha, that belong to textures which its text names."""
        named, found = self.parameters.get("named", {}), dict[str, ImageSource]()
        open_ = list(named.values()) if isinstance(named, Mapping) else []
        while open_:
            part = open_.pop()
            if isinstance(part, str) and part in pictures:
                found[part] = pictures[part]
            elif isinstance(part, tuple):
                open_.extend(part)
        return replace(self, named=tuple(found.values())) if found else self

    def instance(self, parameters: Mapping[str, Any], level: int, seed: int) -> Instance:
        """Makes the instance that a brush's ink names, with the parameters that it gives anew, a base level and a
        seed.  TextureError names what is wrong."""
        given = {**self.parameters, **parameters}
        if self.kind == EXPRESSION:
            given = anew(self.parameters, parameters, level)
            given["named"] = of_keys(self.parameters.get("named", {}), {one.sha: one for one in self.named})
        return instance(self.kind, given, level, seed, self.source, self.arithmetic, self.maps)


@cache
def built_in(arithmetic: int) -> Map[str, Texture]:
    """Returns the textures that need no definition, by name; none in the arithmetic in which whoever asks for a kind by
    its name gets it anyhow."""
    named = () if arithmetic == LIBRARY else (row.name for row in KINDS.values() if not row.pictured)
    return Map({name: Texture(name, Map(), arithmetic=arithmetic) for name in named})


@dataclass(frozen=True, slots=True)
class Around:
    """What carrying out a command may use besides the painting: a cache of tiles, the folder that paths start from, and
    pictures that are known already, by their sha; `arithmetic`: the painting's; `touches`: its paint on solids;
    `textures`: those of the painting."""

    cache: TileCache | None = None
    folder: Path | None = None
    pictures: Mapping[str, ImageSource] = Map()
    arithmetic: int = LIBRARY
    touches: Touches = NO_TOUCHES
    textures: Mapping[str, Texture] = Map()


def recorded(command: DefineTexture, texture: Texture) -> DefineTexture:
    """Returns the command with what the maker found out about its picture, and the sha by which that is known again; of
    a written texture, with its text, and what that names."""
    if texture.source is None:
        told = {name: texture.parameters[name] for name in ("text", "named") if name in texture.parameters}
        return replace(command, arguments=command.arguments.update(told)) if "text" in told else command
    found = {name: value for name, value in texture.parameters.items() if name not in command.arguments}
    if texture.mask is not None:
        found["mask_sha"] = texture.mask.sha
    if texture.maps is not None:
        found[LEARNT_SHA] = texture.maps.sha
    if texture.control is not None:
        found["control_sha"] = texture.control.sha
    return replace(command, arguments=command.arguments.update(found, sha=texture.source.sha))
