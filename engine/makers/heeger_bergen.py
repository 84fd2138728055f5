"""Textures matched to examples, as texture commands describe them (Heeger & Bergen 1995).

`match` makes noise, or a start picture, like one example; `mix` makes it like two; a mix of several `stages` is a
series of textures between the two, of the same noise, one below the other in one picture.  Alpha is matched with the
colours, as one band more.  Where a definition names a structure, it is `with_structure` that makes them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from immutables import Map

from engine.brush import parts
from engine.checks.field_error import FieldError
from engine.files.fault import FileError
from engine.files.strict_json import Fields
from engine.makers import with_structure
from engine.makers.lewis import SAMPLE_CAP, Pictures, Sample, flattened
from engine.numeric.colour_axes import axes_of
from engine.numeric.grid import snapped
from engine.numeric.memo import remembered
from engine.numeric.pyramid import reduce
from engine.numeric.resample import resampled
from engine.painting.commands import SEED_LIMIT
from engine.texture.adjusting import GAIN_CAP, Band, adjusted
from engine.texture.continuation import octave_of
from engine.texture.image import ImageSource
from engine.texture.matched import stage, weights
from engine.texture.matching import (
    ITERATIONS,
    LEVELS,
    ORIENTATIONS,
    PYRAMIDS,
    Pattern,
    Shape,
    analysed,
    matched_colours,
    matching,
    noise,
    started,
)
from engine.texture.mixing import MIXES, Mix

SHRUNK = 1024  # pixels: a longer example is halved until it is no longer than that,
EXAMPLE_SIDE = 512  # and then its middle is looked at
SIDE_CAP = 2048
STAGES_CAP = 9
_BANDS_CAP = 300
_AXES_CAP = 4
_QUICK = 128  # pixels along the sides of a texture with colours that is soon made
_SHORT = 16  # digits of an example's sha


@dataclass(frozen=True, slots=True)
class Example:
    """A picture: `planes` float32 (1, 3 or 4, h, w) of 0..1, grey, RGB or premultiplied RGBA; `sha`: of its pixels, by
    which it is known again."""

    sha: str
    planes: np.ndarray = field(compare=False, repr=False)


@dataclass(frozen=True, eq=False, slots=True)
class Plan:
    """What is asked for.

    `examples`: one, or two to be mixed `how`; `size`: height and width; `stages`: how many textures, 1 unless it is a
    series; `start`: a picture to begin with, float32 (1, 3 or 4, *size); `structure`: one of `with_structure.ALL`.
    """

    examples: tuple[Example, ...]
    shape: Shape
    size: tuple[int, int]
    iterations: int = ITERATIONS
    seed: int = 0
    start: np.ndarray | None = None
    how: str = "palette"
    mix: Mix = field(default_factory=Mix)
    stages: int = 1
    bands: tuple[Band, ...] = ()
    axes: tuple[float, ...] = ()
    structure: str = with_structure.NO_STRUCTURE


@dataclass(frozen=True, eq=False, slots=True)
class Made:
    """How far the work is, 0..1; `colours`: now and then the texture as it is, float32 (1, 3 or 4, stages h, w)."""

    done: float
    colours: np.ndarray | None = None


def read(maker: str, members: Fields, place: Pictures) -> Plan:
    """Returns what a command `match` or `mix` asks for, its pictures read.  FieldError names the member."""
    shas = _known(members)
    given = [_example(members, "path", place, shas[0])]
    stages, how, mix = 1, "palette", Mix()
    if maker == "mix":
        given.append(_example(_other(members, "pattern"), "pattern", place, shas[1]))
        how = members.take("how", "palette")
        if how not in MIXES:
            raise members.fault("how", f"one of {', '.join(MIXES)}")
        mix = Mix(members.number("weight", 0.5, lo=0.0, hi=1.0), members.integer("split", 2, lo=0, hi=16))
        stages = members.integer("stages", 1, lo=1, hi=STAGES_CAP)
        if stages > 1 and how != "average":
            raise FieldError(members.at("how"), f'"{how}"', 'average: only of it there are several "stages"')
    structure = with_structure.structure_of(members, how if maker == "mix" else "average")
    start = _example(_other(members, "start"), "start", place).planes if "start" in members else None
    size = _size(members, (start if start is not None else given[-1].planes).shape[1:], stages)
    if start is not None:
        start = resampled(start, size, np.arange(size[0]), np.arange(size[1]))
    numbers = (
        replace(_shape(members), arithmetic=place.arithmetic),
        size,
        members.integer("iterations", ITERATIONS, lo=1, hi=1000),
    )
    seed = members.integer("seed", 0, lo=-SEED_LIMIT, hi=SEED_LIMIT)
    return Plan(tuple(given), *numbers, seed, start, how, mix, stages, _bands(members), _axes(members), structure)


def steps(plan: Plan) -> Iterator[Made]:
    """Yields the work, piece by piece; the last has the finished texture."""
    done: list[np.ndarray] = []
    for k in range(plan.stages):
        yield Made(k / plan.stages)
        for part, made in _of_stage(plan, k):
            colours = None
            if made is not None:
                colours = np.concatenate([*done, *[_valid(made)] * (plan.stages - k)], axis=1)
            yield Made((k + part) / plan.stages, colours)
        assert colours is not None
        done.append(colours[:, k * plan.size[0] : (k + 1) * plan.size[0]])


def quick(plan: Plan) -> Plan:
    """Returns what is soon made and looks a little like it: by histograms alone, and small if it has colours."""
    most = max(len(example.planes) for example in plan.examples)
    size = plan.size if most == 1 else (min(plan.size[0], _QUICK), min(plan.size[1], _QUICK))
    return replace(plan, structure=with_structure.NO_STRUCTURE, stages=1, size=size)


def _of_stage(plan: Plan, stage: int) -> Iterator[tuple[float, np.ndarray | None]]:
    """Yields how far one texture is, 0..1, and now and then its colours, last the finished ones."""
    if plan.structure == with_structure.NO_STRUCTURE:
        pattern = pattern_of(plan, stage)
        for step in matching(pattern, _beginning(plan, pattern), plan.iterations):
            yield step.done, None if step.planes is None else matched_colours(pattern, step.planes)
        return
    weight = plan.mix.weight if plan.stages == 1 else weights(plan.stages)[stage]
    examples = [example.planes for example in plan.examples]
    for part, colours in with_structure.texture_steps(examples, plan.structure, weight, plan.size, plan.seed):
        yield part, None if colours is None else snapped(colours)


def pattern_of(plan: Plan, stage: int = 0) -> Pattern:
    """Returns what the texture, or one of the stages, is matched to."""
    mix = plan.mix if plan.stages == 1 else Mix(weights(plan.stages)[stage], plan.mix.split)
    found = _pattern(plan.examples, plan.shape.within(plan.size), plan.how, mix)
    return adjusted(found, plan.bands, plan.axes)


@remembered
def _pattern(examples: tuple[Example, ...], shape: Shape, how: str, mix: Mix) -> Pattern:
    if len(examples) == 1:
        return analysed(examples[0].planes, shape)
    return MIXES[how](examples[0].planes, examples[1].planes, shape, mix)


def rgba(colours: np.ndarray) -> np.ndarray:
    """Returns a picture (4, h, w) on the grid, opaque unless the colours (1, 3 or 4, h, w) are premultiplied RGBA."""
    out = np.ones((4, *colours.shape[1:]), np.float32)
    out[: max(len(colours), 3)] = np.clip(colours, 0.0, 1.0)
    return snapped(out)


def sample(plan: Plan, colours: np.ndarray) -> Sample:
    """Returns the texture as a sample, with the roughness that its subbands have."""
    made = rgba(colours)
    own = ImageSource.of("", made)
    middle = own if plan.stages == 1 else stage(own, plan.stages, weights(plan.stages)[plan.stages // 2])
    shas = tuple(example.sha for example in plan.examples)
    return Sample(made, Map({"roughness": octave_of(middle, plan.shape.arithmetic).slope, "examples": shas}))


def of_examples(maker: str, members: Fields, place: Pictures) -> Sample:
    """Returns the whole work at once.  FileError if an example is not the one that it was when the command was
    recorded."""
    plan = read(maker, members, place)
    known = members.take("examples", None)
    if isinstance(known, list) and known != [example.sha for example in plan.examples]:
        raise FileError(
            members.text("path", "rect", cap=4096), "its pixels, or the other example's, are not those recorded"
        )
    colours = None
    for made in steps(plan):
        colours = made.colours
    assert colours is not None
    return sample(plan, colours)


def _other(members: Fields, name: str) -> Fields:
    """Returns a second picture: its path, or an object {"path" or "rect": ...}."""
    value = members.take(name, expected='a path, or {"path": ...} or {"rect": ...}')
    if isinstance(value, str):
        return Fields({"path": members.text(name, cap=4096)}, name)
    if not isinstance(value, Mapping):
        raise members.fault(name, 'a path, or {"path": ...} or {"rect": ...}')
    return Fields(value, members.at(name))


def _known(members: Fields) -> list[Any]:
    """Returns the shas of both examples when the command was recorded; None where it was not."""
    known = members.all().get("examples")
    return [*(known if isinstance(known, list) else ()), None, None][:2]


def _example(members: Fields, name: str, place: Pictures, known: Any = None) -> Example:
    """Returns a picture.  One that is `known` by the sha that it had without its alpha is the one without: it was
    recorded before alpha counted."""
    if "path" not in members and "rect" not in members:
        raise FieldError(members.at("path"), "nothing", 'a picture, or "rect" for a piece of the canvas')
    given = place.picture(members)
    opaque = flattened(given, place.arithmetic)
    found = _looked_at(opaque if (given[3] == 1.0).all() else given)
    if len(found.planes) == 4 and known is not None and known != found.sha:
        without = _looked_at(opaque)
        return without if known == without.sha else found
    if len(found.planes) == 4 and not found.planes[3].any():
        raise FieldError(members.at("rect" if "rect" in members else "path"), "nothing but transparency", "a picture")
    return found


def _looked_at(planes: np.ndarray) -> Example:
    planes = part_looked_at(planes)
    return Example(ImageSource.of("", rgba(planes)).sha[:_SHORT], planes)


def part_looked_at(planes: np.ndarray) -> np.ndarray:
    """Returns a picture (C, h, w) halved until it is short enough; of a large one the middle."""
    while max(planes.shape[1:]) > SHRUNK and min(planes.shape[1:]) > 1:
        even = planes[:, : planes.shape[1] // 2 * 2, : planes.shape[2] // 2 * 2]
        planes = reduce(np.ascontiguousarray(even))
    top, left = (max(0, (n - EXAMPLE_SIDE) // 2) for n in planes.shape[1:])
    return np.ascontiguousarray(planes[:, top : top + EXAMPLE_SIDE, left : left + EXAMPLE_SIDE])


def _size(members: Fields, usual: tuple[int, ...], stages: int) -> tuple[int, int]:
    """Returns height and width."""
    width, height = members.integers("size", 2, (usual[1], usual[0]), limit=SIDE_CAP)
    if width < 1 or height < 1 or stages * width * height > SAMPLE_CAP:
        raise members.fault("size", f"[width, height], each 1 to {SIDE_CAP}, {SAMPLE_CAP} pixels in all")
    return height, width


def _shape(members: Fields) -> Shape:
    pyramid = members.take("pyramid", PYRAMIDS[0])
    if pyramid not in PYRAMIDS:
        raise members.fault("pyramid", f"one of {', '.join(PYRAMIDS)}")
    levels = members.integer("levels", LEVELS, lo=0, hi=16)
    return Shape(pyramid, levels, members.integer("orientations", ORIENTATIONS, lo=1, hi=16))


def _bands(members: Fields) -> tuple[Band, ...]:
    value = members.take("bands", [])
    if not isinstance(value, list) or len(value) > _BANDS_CAP:
        raise members.fault("bands", f'a list of at most {_BANDS_CAP} {{"level": ..., "gain": ...}}')
    return tuple(_band(Fields(part, f"{members.at('bands')}[{i}]")) for i, part in enumerate(value))


def _band(members: Fields) -> Band:
    shaping = parts.shaping(members.take("shaping", None), members.at("shaping"))
    level = members.integer("level", lo=-1, hi=16)
    orientation = members.integer("orientation", None, lo=0, hi=15)
    return Band(level, orientation, members.number("gain", 1.0, lo=0.0, hi=GAIN_CAP), shaping)


def _axes(members: Fields) -> tuple[float, ...]:
    value: Any = members.take("axes", [])
    good = isinstance(value, list) and len(value) <= _AXES_CAP
    if not good or not all(isinstance(v, int | float) and not isinstance(v, bool) and 0.0 <= v <= 4.0 for v in value):
        raise members.fault("axes", f"a list of at most {_AXES_CAP} factors from 0 to 4")
    return tuple(float(v) for v in value)


def _beginning(plan: Plan, pattern: Pattern) -> np.ndarray:
    """Returns noise, the same for all stages, or the start picture along its own axes of colour."""
    if plan.start is None:
        return noise(pattern.colours.count, plan.size, plan.seed)
    return started(pattern, axes_of(plan.start, plan.shape.arithmetic).planes(plan.start), plan.seed)


def _valid(colours: np.ndarray) -> np.ndarray:
    """Colours no brighter than their alpha."""
    if len(colours) == 4:
        np.clip(colours[:3], 0.0, np.clip(colours[3], 0.0, 1.0), out=colours[:3])
    return colours
