"""The ways in which a texture can be made of an example, each as the maker and the members that a definition names."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from immutables import Map

from engine.files.strict_json import Fields
from engine.makers import lewis
from engine.makers.definitions import kind_of
from engine.makers.with_structure import NO_STRUCTURE, texture_steps
from engine.numeric.address import Rect
from engine.numeric.arithmetic import EVERYWHERE
from engine.numeric.colour import to_rgba8
from engine.painting.commands import DefineTexture
from engine.painting.textures import Texture
from engine.texture import matching
from engine.texture.example import show
from engine.texture.example.exemplar import analysed
from engine.texture.example.region import empty, painted, refining
from engine.texture.image import ImageSource

_Size = tuple[int, int]
_Make = Callable[[np.ndarray, _Size, int], Iterator[np.ndarray | None]]


@dataclass(frozen=True, slots=True)
class MakerTried:
    """`title`: as it is told; `maker` and `members`: of a definition; `make`: yields None after each piece of work, and
    last the texture (C, *size) of an example (C, h, w), for a seed."""

    title: str
    maker: str
    members: MappingProxyType[str, str]
    make: _Make


def rgba_of(picture: np.ndarray) -> np.ndarray:
    """Returns a picture (1, 3 or 4, h, w) with all four planes."""
    out = np.ones((4, *picture.shape[1:]), np.float32)
    out[: max(len(picture), 3)] = picture
    return out


def _histograms(example: np.ndarray, size: _Size, seed: int) -> Iterator[np.ndarray | None]:
    pattern = matching.analysed(example, matching.Shape(arithmetic=EVERYWHERE).within(size))
    yield None
    planes = None
    for step in matching.matching(pattern, matching.noise(pattern.colours.count, size, seed), matching.ITERATIONS):
        planes = planes if step.planes is None else step.planes
        yield None
    assert planes is not None
    yield matching.matched_colours(pattern, planes)


def _structured(structure: str) -> _Make:
    def make(example: np.ndarray, size: _Size, seed: int) -> Iterator[np.ndarray | None]:
        made = None
        for _, colours in texture_steps([example], structure, 0.0, size, seed):
            made = made if colours is None else colours
            yield None
        yield made

    return make


@dataclass(frozen=True, slots=True, eq=False)
class _Held:
    """A picture that is at hand."""

    rgba: np.ndarray
    arithmetic: int = EVERYWHERE

    def picture(self, members: Fields) -> np.ndarray:
        return self.rgba


def _scattered(example: np.ndarray, size: _Size, seed: int) -> Iterator[np.ndarray | None]:
    sample = lewis.of_photograph(Fields({"seed": seed}, ""), _Held(rgba_of(example)))
    yield None
    kind = kind_of(DefineTexture("impulse", "impulse", Map()))
    texture = Texture(kind, sample.found, ImageSource.of("", sample.rgba), arithmetic=EVERYWHERE)
    found = texture.instance({}, 0, seed).appearance(0, Rect.at(0, 0, size[1], size[0]))
    yield np.clip(np.float32(0.5) + np.float32(0.5) * found, 0.0, 1.0)


def _grown(example: np.ndarray, size: _Size, seed: int) -> Iterator[np.ndarray | None]:
    region = empty(analysed(to_rgba8(rgba_of(example)), arithmetic=EVERYWHERE), seed)
    whole = Rect.at(0, 0, size[1], size[0])
    yield None
    region = painted(region, whole, np.ones(size, bool))
    for step in refining(region):
        region = step.region
        yield None
    yield show.picture(region, whole)[: len(example)]


def _of_structure(structure: str, make: _Make) -> MakerTried:
    titles = {NO_STRUCTURE: "Histograms", "full": "Full layout"}
    return MakerTried(
        titles.get(structure, structure.capitalize()), "match", MappingProxyType({"structure": structure}), make
    )


_NOTHING: MappingProxyType[str, str] = MappingProxyType({})
# From those that copy nothing to those that copy most.
TRIED = {
    "scattered": MakerTried("Scattered", "impulse", _NOTHING, _scattered),
    "histograms": _of_structure(NO_STRUCTURE, _histograms),
    "statistics": _of_structure("statistics", _structured("statistics")),
    "objects": _of_structure("objects", _structured("objects")),
    "full": _of_structure("full", _structured("full")),
    "pieces": _of_structure("pieces", _structured("pieces")),
    "grown": MakerTried("Grown example", "example", _NOTHING, _grown),
}
