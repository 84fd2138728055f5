"""What was painted with examples, in a painting's file: plots as the pixels that they take, and the examples.

Nothing that is grown is stored: the final sources follow from pixels, example and seed (engine/texture/example/region).
Each example is stored once, as pictures of the file and its parameters.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
from immutables import Map
from isal import isal_zlib

from engine.archive import maskpacks
from engine.brush.checks import frozen
from engine.brush.settings import DEEPEST
from engine.canvas import layers
from engine.canvas.growth import Growth, Plot
from engine.canvas.layers import Group
from engine.checks.field_error import FieldError
from engine.files.fault import FileError, shown
from engine.files.strict_json import Fields
from engine.numeric.halving import halved_region
from engine.painting.commands import LEVEL_LIMIT, SEED_LIMIT
from engine.painting.textures import Texture
from engine.painting.value import Painting
from engine.strokes.example_maps import channels_from_json
from engine.strokes.example_stroke import FURTHEST
from engine.strokes.example_textures import KIND, Origin, exemplar_of, key_of, parameters_of
from engine.texture.example import region as regions
from engine.texture.example.control import Channels
from engine.texture.example.exemplar import EXAMPLE_SIDE, Exemplar
from engine.texture.example.parameters import FIELDS, SEAMLESS, Parameters, with_values
from engine.texture.example.region import Region
from engine.texture.example.tiles import NONE, TILE_SIDE, Tiles, sealed
from engine.texture.example.told import coarser as coarser_told
from engine.texture.image import ImageSource
from engine.texture.learnt.refinement import OCTAVES
from engine.texture.record import LEARNT

GROWN = 1 << 17  # bytes in memory of a tile that is grown, with all its levels, about
ANALYSED = 1 << 7  # and of a pixel of an example
TURNED = 48  # times as much of one that is learnt from turned all round, at most
EXAMPLES_CAP = 1000
DETAIL_CAP = 4
OTHERWISE = "some of what was painted with examples is not quite what it was when it was saved: it was grown again"


@dataclass(frozen=True)
class ExampleEntry:
    """What an example is made of: `picture`, and if it has them `mask`, `control` and `maps`, by their sha; `channels`:
    those of `control`; `strength`, `octaves`: how it is refined by `maps`."""

    picture: str
    mask: str | None
    parameters: Parameters
    detail: int
    control: str | None = None
    channels: Channels = ()
    maps: str | None = None
    strength: float = 1.0
    octaves: int = OCTAVES

    @property
    def pictures(self) -> tuple[str, ...]:
        """Gives the pictures that it needs, by their sha."""
        return tuple(sha for sha in (self.picture, self.mask, self.control, self.maps) if sha is not None)


@dataclass(frozen=True)
class PlotEntry:
    """A plot in a file: `example`, by its name there; `masks`: members with their numbers of tiles; `crc`: of its
    pixels as they were grown; `told`: members with what its control channels tell, likewise."""

    depth: float
    level: int
    name: str
    seed: int
    example: str
    masks: tuple[tuple[str, int], ...]
    crc: int
    told: tuple[tuple[str, int], ...] = ()


# ---- writing ----


def origin(plot: Plot) -> Origin:
    """Returns what a plot's example was read from."""
    found = plot.region.exemplar.origin
    if not isinstance(found, Origin):
        raise ValueError(f"plot {plot.name!r}: its example is of no texture")
    return found


def example_entry(plot: Plot) -> ExampleEntry:
    """Tells what the example of a plot is made of."""
    found = origin(plot)
    mask = None if found.mask is None else found.mask.sha
    control = None if found.control is None else found.control.sha
    about = plot.region.exemplar.parameters, found.detail
    learning = found.learning
    learnt = () if learning is None else (learning.maps.sha, learning.strength, learning.octaves)
    return ExampleEntry(found.source.sha, mask, *about, control, found.channels, *learnt)


def stored(plot: Plot, stem: str) -> tuple[PlotEntry, dict[str, Callable[[], bytes]]]:
    """Tells how the manifest tells a plot, which is settled, and the members that hold it, with what makes their
    bytes; their names begin with `stem`."""
    masks, members = plot.region.masks[0], []
    makes: dict[str, Callable[[], bytes]] = {}
    for number, keys in enumerate(maskpacks.grouped(masks)):
        members.append((f"{stem}-{number}.masks", len(keys)))
        makes[members[-1][0]] = partial(maskpacks.pack, masks, keys)
    told = []
    for number, keys in enumerate(
        maskpacks.grouped(plot.region.told[0], maskpacks.TOLD_TILES) if plot.region.told else ()
    ):
        told.append((f"{stem}-{number}.told", len(keys)))
        makes[told[-1][0]] = partial(maskpacks.pack_told, plot.region.told[0], keys)
    about = plot.depth, plot.level, plot.name, plot.region.seed, plot.key
    return PlotEntry(*about, tuple(members), crc(plot), tuple(told)), makes


def crc(plot: Plot) -> int:
    """CRC-32 of the plot's pixels at its own level, row by row of tiles: little-endian, as they are shown."""
    found = 0
    for _, tile in sorted(plot.shown[0].items()) if plot.shown else ():
        found = isal_zlib.crc32(np.ascontiguousarray(tile.data, "<f4").data.cast("B"), found)
    return found


def entries(root: Group) -> dict[str, ExampleEntry]:
    """Returns the examples of all plots, each once, by their keys in order."""
    found = {plot.key: plot for layer in layers.layers(root) for plot in layer.growth}
    return {key: example_entry(plot) for key, plot in sorted(found.items())}


def controlled(painting: Painting) -> bool:
    """Tells whether anything has control channels, has learnt, or is grown without seams."""
    grown = (plot.region.exemplar for layer in layers.layers(painting.root) for plot in layer.growth)
    textures = painting.textures.values()
    found = any(one.maps or one.control or one.parameters.get("method") == SEAMLESS for one in textures)
    return found or any(one.control or one.learning or one.parameters.method == SEAMLESS for one in grown)


def plot_json(entry: PlotEntry) -> dict[str, object]:
    """Tells a plot as the manifest does; `parse_plot` is the inverse."""
    own = {field.name: getattr(entry, field.name) for field in fields(entry) if field.name not in ("masks", "told")}
    told = {"told": [list(member) for member in entry.told]} if entry.told else {}
    return {**own, "masks": [list(member) for member in entry.masks], **told}


def examples_json(examples: Mapping[str, ExampleEntry]) -> dict[str, object]:
    """Tells all examples as the manifest does; `parse_examples` is the inverse."""
    return {key: _example_json(entry) for key, entry in examples.items()}


def _example_json(entry: ExampleEntry) -> dict[str, object]:
    own = entry.parameters
    told = {name: getattr(own, name) for name in FIELDS}
    mask = {} if entry.mask is None else {"mask": entry.mask}
    control = {} if entry.control is None else {"control": entry.control, "controls": list(map(list, entry.channels))}
    maps = {"maps": entry.maps, "strength": entry.strength, "octaves": entry.octaves} if entry.maps else {}
    return {"picture": entry.picture, **mask, **control, **maps, "detail": entry.detail, "parameters": told}


# ---- reading ----


def parse_plot(value: object, where: str) -> PlotEntry:
    """FieldError names the member that is wrong."""
    members = Fields(value, where)
    masks, told = _members(members, "masks"), _members(members, "told") if "told" in members else ()
    if not masks:
        raise members.fault("masks", "[member, tiles] each, one at least")
    furthest = LEVEL_LIMIT + FURTHEST
    return PlotEntry(
        members.number("depth", lo=-DEEPEST, hi=DEEPEST),
        members.integer("level", lo=-furthest, hi=furthest),
        members.text("name"),
        members.integer("seed", lo=-SEED_LIMIT, hi=SEED_LIMIT),
        members.text("example"),
        masks,
        members.integer("crc", lo=0, hi=(1 << 32) - 1),
        told,
    )


def _members(members: Fields, name: str) -> tuple[tuple[str, int], ...]:
    """Returns members of the archive with their numbers of tiles."""
    found = members.take(name, expected="a list")
    sound = isinstance(found, list) and all(isinstance(m, list) and len(m) == 2 for m in found)
    if not (sound and all(isinstance(own, str) and type(count) is int and count > 0 for own, count in found)):
        raise members.fault(name, "[member, tiles] each, one at least")
    return tuple((own, count) for own, count in found)


def parse_example(value: object, where: str) -> ExampleEntry:
    """FieldError names the member that is wrong."""
    members = Fields(value, where)
    told = members.take("parameters", expected="an object")
    if not isinstance(told, dict):
        raise members.fault("parameters", "an object")
    parameters = with_values(Parameters(), told, f"{where}.parameters.")
    detail = members.integer("detail", lo=0, hi=DETAIL_CAP)
    held = members.text("picture"), members.text("mask", None), parameters, detail
    learnt: dict[str, Any] = {}
    if "maps" in members:
        strength, octaves = members.number("strength", lo=0.0, hi=1.0), members.integer("octaves", lo=1, hi=OCTAVES)
        learnt = {"maps": members.text("maps"), "strength": strength, "octaves": octaves}
    if "control" not in members:
        return ExampleEntry(*held, **learnt)
    try:
        channels = channels_from_json(frozen(members.take("controls", expected="a list")))
    except FieldError as error:
        raise FieldError(f"{where}.controls", error.found, error.expected) from None
    return ExampleEntry(*held, members.text("control"), channels, **learnt)


def _called(name: str) -> str:
    """Returns the beginning of an example's name in a file, as a place in messages."""
    return ascii(name[:12])[1:-1]


def parse_examples(told: Mapping[str, object]) -> dict[str, ExampleEntry]:
    """Reads the examples of a manifest by their keys.  FieldError names what is wrong, or that there are too many."""
    if len(told) > EXAMPLES_CAP:
        raise FieldError("manifest.examples", f"{len(told)}", f"at most {EXAMPLES_CAP}")
    return {name: parse_example(value, f"examples.{_called(name)}") for name, value in told.items()}


def _check_sizes(where: str, size: tuple[int, int], masked: tuple[int, int] | None) -> None:
    """FieldError unless an example of that (width, height), and its mask if it has one, can be painted with."""
    if max(size) > EXAMPLE_SIDE:
        raise FieldError(f"{where}.picture", "{} x {} pixels".format(*size), f"at most {EXAMPLE_SIDE} x {EXAMPLE_SIDE}")
    if masked is not None and masked != size:
        raise FieldError(f"{where}.mask", "{} x {} pixels".format(*masked), "{} x {} as the picture".format(*size))


def check_texture(where: str, texture: Texture) -> None:
    """FieldError unless a texture that may be an example is one that can be painted with."""
    if texture.kind != KIND:
        return
    if texture.source is None:
        raise FieldError(where, "no picture", "one of those in the file")
    mask = None if texture.mask is None else (texture.mask.width, texture.mask.height)
    _check_sizes(where, (texture.source.width, texture.source.height), mask)
    try:
        parameters_of(texture)
    except FieldError as error:
        raise FieldError(f"{where}.parameters.{error.place}", error.found, error.expected) from None


def cost(examples: Mapping[str, ExampleEntry], plots: Iterable[PlotEntry], sizes: Mapping[str, tuple[int, int]]) -> int:
    """Returns bytes of memory that the plots of a file take when they are grown, about; `sizes`: of its pictures."""
    whole = GROWN * sum(count for plot in plots for _, count in plot.masks)
    for name, entry in examples.items():
        for sha in entry.pictures:
            if sha not in sizes:
                raise FieldError(f"examples.{_called(name)}", f"picture {shown(sha, 12)}", "one of those in the file")
        masked = None if entry.mask is None else sizes[entry.mask]
        _check_sizes(f"examples.{_called(name)}", sizes[entry.picture], masked)
        width, height = sizes[entry.picture]
        whole += ANALYSED * (TURNED if entry.channels and entry.channels[0].turns > 1 else 1) * width * height
    return whole


@dataclass(frozen=True)
class Nursery:
    """The examples of a file, by their names there, ready to grow in plots: each with its key."""

    examples: Mapping[str, tuple[str, Exemplar]]

    @classmethod
    def of(
        cls,
        entries: Mapping[str, ExampleEntry],
        plots: Iterable[PlotEntry],
        pictures: Mapping[str, ImageSource],
        arithmetic: int,
    ) -> Nursery:
        """Returns those that plots are of, in the painting's arithmetic; FieldError if there is nothing to learn from
        one."""
        found: dict[str, tuple[str, Exemplar]] = {}
        for plot in plots:
            if plot.example in found:
                continue
            if plot.example not in entries:
                raise FieldError(f"plot {shown(plot.name)}.example", shown(plot.example), "one of those in the file")
            entry = entries[plot.example]
            texture = replace(_texture(entry, plot.name, pictures), arithmetic=arithmetic)
            try:
                found[plot.example] = key_of(texture, entry.detail), exemplar_of(texture, entry.detail)
            except FieldError as error:
                raise FieldError(f"examples.{_called(plot.example)}", error.found, error.expected) from None
        return cls(found)

    def plots(
        self, entries: Sequence[PlotEntry], masks: Callable[[str, int], Tiles], where: str
    ) -> tuple[Growth, list[Mark]]:
        """Returns the plots of a layer, nothing of them grown yet, and the marks by which to tell later whether they
        grew as before; `masks` reads so many tiles of a member.  FileError if two take the same place."""
        plots, marks = [], []
        for entry in entries:
            key, exemplar = self.examples[entry.example]
            tiles = maskpacks.joined([masks(*member) for member in entry.masks], where)
            told = maskpacks.joined([masks(*member) for member in entry.told], where)
            region = region_of(exemplar, entry.seed, tiles, _checked(exemplar, tiles, told, where))
            plots.append(Plot(entry.depth, entry.level, entry.name, key, region))
            marks.append(Mark(tiles, entry.crc))
        plots.sort(key=lambda plot: plot.order)
        for one, other in pairwise(plots):
            if one.order == other.order:
                raise FileError(
                    where, f"plot {shown(one.name)}: found two of an example, level and depth, expected one"
                )
        _check_apart(plots, where)
        return tuple(plots), marks


@dataclass(frozen=True, slots=True, eq=False)
class Mark:
    """The CRC that the pixels of a plot had when it was saved; `masks`: its own, as they were opened."""

    masks: Tiles
    crc: int


def otherwise(marks: Sequence[Mark], root: Group) -> bool:
    """Tells whether a plot that was grown again, and not painted on since, looks otherwise than when it was saved."""
    plots = [plot for layer in layers.layers(root) for plot in layer.growth if plot.settled]
    return any(mark.masks is plot.region.masks[0] and mark.crc != crc(plot) for mark in marks for plot in plots)


def _texture(entry: ExampleEntry, name: str, pictures: Mapping[str, ImageSource]) -> Texture:
    """Returns the example as a texture that was painted with under some name."""
    mask = None if entry.mask is None else replace(pictures[entry.mask], name=name)
    told = Map({field: getattr(entry.parameters, field) for field in FIELDS})
    texture = Texture(KIND, told, replace(pictures[entry.picture], name=name), mask)
    if entry.maps is not None:
        told = told.update(detail=LEARNT, strength=entry.strength, octaves=entry.octaves)
        texture = replace(texture, parameters=told, maps=replace(pictures[entry.maps], name=name))
    if entry.control is None:
        return texture
    told = told.set("controls", tuple(map(tuple, entry.channels)))
    return replace(texture, parameters=told, control=replace(pictures[entry.control], name=name))


def _checked(exemplar: Exemplar, masks: Tiles, told: Tiles, where: str) -> Tiles:
    """Returns what control channels tell of a plot; FileError unless it is of its channels, and of its pixels alone."""
    count = 0 if exemplar.control is None else exemplar.control.stored
    for key, tile in told.items():
        own = masks.get(key)
        if tile.data.shape[0] != count or own is None or (tile.data[:, own.data[0] == 0]).any():
            raise FileError(where, f"what control channels tell: found another number than {count}, or other pixels")
    return told


def _check_apart(plots: Sequence[Plot], where: str) -> None:
    """Of a depth and level, no two plots have a pixel in common."""
    taken: dict[tuple[float, int], dict[tuple[int, int], np.ndarray]] = {}
    for plot in plots:
        held = taken.setdefault((plot.depth, plot.level), {})
        for key, tile in plot.region.masks[0].items():
            before, mask = held.get(key), tile.data
            if before is not None and (before & mask).any():
                raise FileError(where, f"plot {shown(plot.name)}: found pixels of another plot of its depth in it")
            held[key] = mask if before is None else before | mask


def region_of(exemplar: Exemplar, seed: int, masks: Tiles, told: Tiles = NONE) -> Region:
    """Returns the region of some pixels, as if they had been painted; nothing is refined.  `told`: what stored control
    channels tell of them."""
    found, channels = [masks], [told]
    for _ in exemplar.levels[1:]:
        channels.append(coarser_told(channels[-1], found[-1]))
        found.append(_coarser(found[-1]))
    bare = regions.empty(exemplar, seed)
    return replace(bare, masks=tuple(found), told=tuple(channels) if bare.told else ())


def _coarser(fine: Tiles) -> Tiles:
    """A pixel is taken if any of its four finer ones is."""
    found = NONE.mutate()
    wide = np.empty((2 * TILE_SIDE, 2 * TILE_SIDE), np.uint8)
    for row, column in sorted({(y >> 1, x >> 1) for y, x in fine}):
        wide[:] = 0
        for y, x in ((0, 0), (0, 1), (1, 0), (1, 1)):
            part = fine.get((2 * row + y, 2 * column + x))
            if part is not None:
                wide[y * TILE_SIDE : (y + 1) * TILE_SIDE, x * TILE_SIDE : (x + 1) * TILE_SIDE] = part.data[0]
        found[row, column] = sealed(halved_region(wide)[None])
    return found.finish()
