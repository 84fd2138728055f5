"""A brush's ink, resolved: its base colour, and the amplitude of every texture instance in it (features P3, P5).

A component of amount a mixes the texture's value s, 0..1, of colour X into the brush's colour C: C + a s (X - C).
Curves of the component and of the brush change s first (`engine.texture.shaped`).  With s = (S + 1)/2 for a
procedural texture of nominal S in -1..1 that is linear in S: the constant parts gather in the base colour, and
a (X - C)/2 is the amplitude of S (Perlin & Velho 1995, sections 3.1 and 3.4).  A coloured texture, whose S has three
channels, takes the place of the brush's colour: C + a (s X - C).  Textures of a series may go with the pressure (module
`sway`).
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from engine.brush import sway
from engine.brush.checks import BrushError
from engine.brush.heading import FIRST_WAY, Ways
from engine.brush.parts import Component, Surface, Tip
from engine.brush.settings import Brush
from engine.brush.sway import Swayed
from engine.numeric.address import Rect, TileKey
from engine.texture.expression.written_ink import Expression
from engine.texture.gradient import Gradient
from engine.texture.image import Image, ImageSource
from engine.texture.planes import sort_key
from engine.texture.record import Instance
from engine.texture.shaped import shaped
from engine.texture.table import KINDS, TextureError, instance

_PIXEL = Rect(0, 0, 1, 1)
_MEMO = 96  # tiles of textured colour kept: 18 MB


class Texture(Protocol):
    """A texture that a recording defined under a name.  A plain `ImageSource` may stand in its place."""

    def instance(self, parameters: Mapping[str, Any], level: int, seed: int) -> Instance:
        """Makes the instance of a base level, with the parameters that the ink gives anew."""
        ...


@dataclass(frozen=True, eq=False, slots=True)
class Loaded:
    """One instance of the ink: `amplitude`, float32 (3,), multiplies its S."""

    instance: Instance
    amplitude: np.ndarray


@dataclass(frozen=True, eq=False)
class Ink:
    """`base`: the constant part of the colour, float32 (3,), encoded sRGB; `loaded`: the instances, sorted by key;
    `swayed`: what goes with the pressure, the rim or the stroke's direction, of those of them that do."""

    base: np.ndarray
    loaded: tuple[Loaded, ...] = ()
    swayed: tuple[Swayed, ...] = ()
    _memo: dict[TileKey, np.ndarray] = field(default_factory=dict, repr=False)

    @property
    def inks(self) -> tuple[Instance, ...]:
        """Gives the instances that add planes, in the order of these."""
        return tuple(part.instance for part in self.loaded)

    @cached_property
    def amplitudes(self) -> np.ndarray:
        """Red, green and blue amplitude of every instance in turn: float32 (3n,)."""
        return np.concatenate([part.amplitude for part in self.loaded]) if self.loaded else np.zeros(0, np.float32)

    @cached_property
    def _swaying(self) -> Mapping[Instance, list[Swayed]]:
        out = defaultdict[Instance, list[Swayed]](list)
        for one in self.swayed:
            out[one.instance].append(one)
        return out

    def under(
        self, key: TileKey, pressure: np.ndarray, rim: np.ndarray | None = None, ways: Ways = FIRST_WAY
    ) -> tuple[np.ndarray, np.ndarray, tuple[Instance, ...]]:
        """Under the pressure at each pixel of a tile, so far from the stroke's rim, float32 (128, 128), None for 1, and
        where it runs those `ways` (`heading.nearest_ways`): the ink's colour, float32 (3, 128, 128),
        the amplitudes (3n, 128, 128) of those n instances that have any there, and these."""
        colour = np.broadcast_to(self.base[:, None, None], (3, *pressure.shape)).copy()
        planes, inks = [], []
        for part in self.loaded:
            swaying = [one for one in self._swaying.get(part.instance, ()) if one.lies_in(ways)]
            if not swaying and not part.amplitude.any():
                continue
            amplitude = np.zeros((3, *pressure.shape), np.float32) + part.amplitude[:, None, None]
            for one in swaying:
                amplitude += one.amplitude[:, None, None] * one.part(pressure, rim, ways)
            if amplitude.any():
                colour += amplitude * part.instance.appearance(key.level, key.rect)[:3]
                planes.append(amplitude)
                inks.append(part.instance)
        return colour, np.concatenate(planes) if planes else np.empty((0, *pressure.shape), np.float32), tuple(inks)

    def field(self, key: TileKey) -> np.ndarray:
        """Returns the ink's colour over a tile of its own level: float32 (3, 128, 128), not to be written to."""
        known = self._memo.get(key)
        if known is not None:
            return known
        shape = (3, key.rect.height, key.rect.width)
        out = np.broadcast_to(self.base[:, None, None], shape).copy()
        for part in self.loaded:
            seen = part.instance.appearance(key.level, key.rect)
            out += part.amplitude[:, None, None] * seen[:3]
        while len(self._memo) >= _MEMO:
            self._memo.pop(next(iter(self._memo)), None)
        self._memo[key] = out
        return out


def resolve(
    brush: Brush, textures: Mapping[str, Texture | ImageSource], level: int, seed: int, where: str = "brush"
) -> Ink:
    """Returns the ink of a brush for a stroke at `level`; `textures` are those defined by name, before the built-in
    ones.

    BrushError names the component and the field that is wrong.
    """
    under = np.array(brush.rgb)
    base = under.copy()
    found: defaultdict[Instance, np.ndarray] = defaultdict(lambda: np.zeros(3))
    swayed: list[Swayed] = []
    for i, component in enumerate(brush.ink):
        if component.amount == 0.0:
            continue
        place = f"{where}.ink[{i}]"
        curve = sway.curve_of(component, place)
        own = named(component if curve is None else sway.at_weight(component, 0.0), textures, level, seed, place)
        curve = sway.curve_of_pen(own, component, curve)
        made = shaped(own, component.shaping, brush.shaping)
        amplitude, shift = _mixed(own, component, under)
        if own.key[0] == "white":  # S = 1: plain colour, no planes
            base += amplitude * (made.appearance(level, _PIXEL).item() + 1.0)
            continue
        base += shift
        mixed = list(sway.stages_of(own, component, curve))
        if not mixed:
            found[made] += amplitude
            hidden = _cover(own)
            if hidden is not None:
                found[hidden] -= component.amount * under
        for told, hats in mixed:
            part = named(sway.told_so(component, told), textures, level, seed, place)
            made, hidden = shaped(part, component.shaping, brush.shaping), _cover(part)
            swayed.append(Swayed(made, amplitude.astype(np.float32), *hats))
            if hidden is not None and under.any():
                swayed.append(Swayed(hidden, (-component.amount * under).astype(np.float32), *hats))
    return Ink(base.astype(np.float32), _loaded(found, swayed), tuple(swayed))


def refuse_ways(ink: Ink, expected: str) -> Ink:
    """Returns an ink, unless it goes by the direction of a stroke.  BrushError tells what is expected in its place."""
    if any(one.way is not None for one in ink.swayed):
        raise BrushError("brush.ink", "a texture that goes by the direction of its stroke", expected)
    return ink


def _loaded(found: Mapping[Instance, np.ndarray], swayed: list[Swayed]) -> tuple[Loaded, ...]:
    """Returns the instances that have an amplitude, sorted by key; those that go with the pressure have none of
    their own."""
    every = {part.instance: np.zeros(3) for part in swayed} | dict(found)
    moving = {part.instance for part in swayed}
    return tuple(
        Loaded(made, amplitude.astype(np.float32))
        for made, amplitude in sorted(every.items(), key=lambda item: sort_key(item[0].key))
        if amplitude.any() or made in moving
    )


def _cover(own: Instance) -> Instance | None:
    """Returns what a texture with alpha hides, as a texture."""
    found: Instance | None = getattr(own, "cover", None)
    return found


def _mixed(own: Instance, component: Component, under: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the amplitude of S that a component is, and what it adds to the base colour: float64 (3,) each."""
    rgb = np.array(component.rgb)
    if _cover(own) is not None:  # premultiplied, 0..1: its own alpha hides the brush's colour
        return component.amount * rgb, np.zeros(3)
    if isinstance(own, Image | Gradient) or (isinstance(own, Expression) and own.shows_colours):
        return component.amount * rgb, -component.amount * under
    if getattr(own, "coloured", False):  # its own colours, s X, in place of the brush's
        return component.amount * rgb / 2.0, component.amount * (rgb / 2.0 - under)
    half = component.amount * (rgb - under) / 2.0
    return half, half


def named(
    part: Component | Surface | Tip, textures: Mapping[str, Texture | ImageSource], level: int, seed: int, where: str
) -> Instance:
    """Returns the texture that a part of a brush names, bound to `level`.  BrushError at `where` and the field."""
    made = _made(part, textures, level, seed, where)
    if getattr(made, "ways", 1) > 1 and isinstance(part, Surface | Tip):
        raise BrushError(f"{where}.texture", "one that goes by the direction of its stroke", "another: that is for ink")
    return made


def _made(
    part: Component | Surface | Tip, textures: Mapping[str, Texture | ImageSource], level: int, seed: int, where: str
) -> Instance:
    name = part.texture
    try:
        defined = textures.get(name)
        if isinstance(defined, ImageSource):
            return instance("image", part.parameters, level, seed, defined)
        if defined is not None:
            return defined.instance(part.parameters, level, seed)
        if name in KINDS:
            return instance(name, part.parameters, level, seed)
    except TextureError as error:
        raise BrushError(f"{where}.{error.place}", error.found, error.expected) from None
    known = [*(row.name for row in KINDS.values() if not row.pictured), *sorted(textures)[:20]]
    names = ", ".join(dict.fromkeys(known))
    raise BrushError(f"{where}.texture", ascii(name), f"a texture: {names}")
