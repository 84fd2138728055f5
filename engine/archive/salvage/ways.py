"""What is had of a damaged painting from its packs and pictures: all of it, or each layer as far as it is whole, or
what other programs see of it.

Each way may raise FileError: it leads nowhere.  The recording, which gives every pixel where it is whole, is for
`engine/session/damaged.py`.  The file itself is only read.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property

from immutables import Map

from engine.archive import grounds, maskpacks
from engine.archive.imports import Opened, read_raster
from engine.archive.manifest import MANIFEST, RECORDING, Manifest
from engine.archive.opening import open_native
from engine.archive.others.stack_entries import bases_of
from engine.archive.plot_files import Mark, Nursery
from engine.archive.salvage.damaged_layer import rebuilt
from engine.archive.salvage.damaged_selections import found_selections
from engine.archive.salvage.remains import Remains
from engine.archive.salvage.seen import Shown
from engine.archive.saving import MERGED, shown_level
from engine.archive.selected.selection_files import with_masks
from engine.canvas import layers
from engine.canvas.growth import Growth
from engine.canvas.layers import Group, Layer
from engine.canvas.node_checks import LayerError
from engine.canvas.selecting.selection import Selection
from engine.canvas.store import Pyramid
from engine.checks.field_error import FieldError
from engine.files.fault import FileError, TooMuch, shown
from engine.files.limits import memory_cap
from engine.files.stack_xml import LayerEntry
from engine.numeric.address import Rect
from engine.numeric.arithmetic import FINE
from engine.painting.rendering import check_cancelled
from engine.painting.textures import Texture
from engine.painting.value import Painting
from engine.texture.example.tiles import Tiles

ALL_THERE = "the file is damaged: all of its paint could be had, and this is a copy of it"
IN_PART = "the file is damaged: this is a copy of what is whole of it"
NO_STEPS = "its recording is damaged: the paint is there, the steps that led to it are not"
NO_TEXTURE = "texture {name} is missing"
MISSING = "layer {name}: {what}; {instead}"
INSTEAD, NOTHING = "its picture stands in for that", "nothing stands in for that"
AS_SEEN = "layer {name}: hidden, the picture of all layers together as it was"
ONLY_SEEN = "its layers are missing: there is the picture of all of them together"
SEEN = "As it was"  # what the layer of that picture is called


def all_paint(remains: Remains) -> Opened:
    """Returns the painting, all members of which must be whole."""
    manifest = _manifest(remains)
    found = open_native(remains.archive, manifest, remains.limits, cancelled=remains.cancelled)
    return replace(found, notes=(ALL_THERE, *steps_missing(remains), *found.notes), native=False)


def steps_missing(remains: Remains) -> tuple[str, ...]:
    """Says that there was a recording, if it is not whole."""
    manifest = remains.manifest
    return (NO_STEPS,) if manifest is not None and RECORDING in manifest.members and remains.recording[1] else ()


def parts(remains: Remains) -> Opened:
    """Returns each layer as far as it is whole; its picture stands in for what is not."""
    try:
        return _Parts(remains, _manifest(remains)).run()
    except (FieldError, LayerError) as error:
        raise FileError(remains.archive.name, f"{MANIFEST}: {error}") from error


def as_seen(remains: Remains) -> Opened:
    """Returns what other programs see: the pictures of the layers, or that of all layers together."""
    try:
        found = read_raster(remains.archive, remains.limits, cancelled=remains.cancelled)
    except TooMuch:
        raise
    except FileError:
        return _all_together(remains)
    lost = remains.stack is None or any(entry.src not in remains.archive for entry in remains.stack.root.layers())
    root, told = _with_seen(remains, found.painting) if lost else (found.painting.root, ())
    changed = (remains.overtaken,) if remains.overtaken else ()
    return replace(found, painting=replace(found.painting, root=root), notes=(IN_PART, *changed, *found.notes, *told))


def _manifest(remains: Remains) -> Manifest:
    """Returns the manifest, if there is one, and what it tells is what was seen last."""
    if remains.manifest is None:
        raise FileError(remains.archive.name, f"{MANIFEST} is missing")
    if remains.overtaken:
        raise FileError(remains.archive.name, remains.overtaken)
    return remains.manifest


def _all_together(remains: Remains) -> Opened:
    pixels = remains.png(MERGED)
    if pixels is None:
        raise FileError(remains.archive.name, "no picture of it is whole")
    frame = Rect(0, 0, pixels.shape[1], pixels.shape[0])
    root = layers.insert(layers.EMPTY, Layer(1, SEEN, pyramid=Shown(pixels, frame).laid(FINE)))
    return Opened(Painting(frame, 0, root, SEEN), (IN_PART, ONLY_SEEN))


def _with_seen(remains: Remains, painting: Painting) -> tuple[Group, tuple[str, ...]]:
    """Returns the layers, and on top, hidden, the picture of all of them together, if it is whole; and what to say."""
    pixels, root = remains.png(MERGED), painting.root
    if pixels is None:
        return root, ()
    level = shown_level(painting.frame)
    at = painting.frame.zoomed(level)
    place = Rect.at(at.x0, at.y0, pixels.shape[1], pixels.shape[0])
    name = layers.unique_name(root, SEEN)
    layer = Layer(layers.next_id(root), name, visible=False, pyramid=Shown(pixels, place, level).laid(painting.grid))
    return layers.insert(root, layer), (AS_SEEN.format(name=shown(name)),)


class _Parts:
    """One painting being put together from what is whole of it."""

    def __init__(self, remains: Remains, manifest: Manifest) -> None:
        self._remains = remains
        self._manifest = manifest
        self._notes: list[str] = []
        self._had = 0  # tiles, pictures and plots
        self._unseen = False  # whether anything is missing that nothing stands in for
        self._marks: list[Mark] = []

    def run(self) -> Opened:
        remains, manifest = self._remains, self._manifest
        packs = [*manifest.packs.values(), *(entry.packs for entry in manifest.selections)]
        most = sum(pack.plain for some in packs for pack in some) + manifest.grown_bytes()
        if most > memory_cap():
            raise TooMuch(remains.archive.name, f"its paint takes {most >> 20} MB, more than this machine has")
        root = manifest.root
        for layer in list(layers.layers(root)):
            check_cancelled(remains.cancelled)
            pyramid, growth = self._layer(layer)
            root = layers.with_growth(layers.with_pyramid(root, layer.name, pyramid), layer.name, growth)
        if not self._had:
            raise FileError(remains.archive.name, "no layer of it is whole")
        told: tuple[str, ...] = ()
        selections = found_selections(manifest.selections, remains, root, manifest.grid)
        painting = manifest.painting(root, self._textures(), selections.chosen)
        if self._unseen:
            root, told = _with_seen(remains, painting)
            painting = replace(painting, root=root)
        told = (*told, *manifest.notes, *selections.notes)
        notes = (IN_PART, *self._notes, *told, *steps_missing(remains))
        return Opened(painting, notes, False, None, remains.pictures, tuple(self._marks))

    def _layer(self, layer: Layer) -> tuple[Pyramid, Growth]:
        rest = self._remains.tiles(self._manifest.packs[layer.id])
        ground, ground_there = self._ground(layer)
        growth, growth_there = self._growth(layer)
        if not rest.missing and ground_there and growth_there:
            self._had += 1
            return rebuilt(ground, rest), growth
        shown_of = self._shown(layer)
        self._had += len(rest.tiles) + len(growth) + (shown_of is not None) + (ground.ground is not None)
        self._unseen |= shown_of is None
        count = len(rest.tiles) + rest.missing
        lost = [f"{rest.missing} of {count} tiles are missing"] if rest.missing else []
        lost += [] if ground_there else ["the picture that it began with is missing"]
        lost += [] if growth_there else ["what was painted with examples is missing"]
        instead = NOTHING if shown_of is None else INSTEAD
        self._notes.append(MISSING.format(name=shown(layer.name, 30), what=", ".join(lost), instead=instead))
        if not (ground_there and growth_there):
            rest = replace(rest, first=None)
        return rebuilt(ground, rest, growth, shown_of), growth

    def _ground(self, layer: Layer) -> tuple[Pyramid, bool]:
        found = self._manifest.grounds.get(layer.id)
        if found is None:
            return layer.pyramid, True
        try:
            png = self._remains.bytes_of(found.member)
            return grounds.restored(found, png, self._remains.where(found.member), self._remains.limits), True
        except FileError:
            return layer.pyramid, False

    def _growth(self, layer: Layer) -> tuple[Growth, bool]:
        """Returns what was painted with examples, which is still to be grown."""
        plots = self._manifest.plots.get(layer.id, ())
        known = self._remains.pictures.keys()
        examples = [self._manifest.examples.get(plot.example) for plot in plots]
        if any(one is None or not set(known) >= set(one.pictures) for one in examples):
            return (), False
        try:
            nursery = Nursery.of(self._manifest.examples, plots, self._remains.pictures, self._manifest.arithmetic)
            where = f"{self._remains.archive.name}: layer {shown(layer.name)}"
            growth, marks = nursery.plots(plots, self._masks, where)
        except (FileError, FieldError):
            return (), False
        self._marks += marks
        return growth, True

    def _masks(self, member: str, count: int) -> Tiles:
        return maskpacks.unpack(self._remains.bytes_of(member), self._remains.where(member), count)

    @cached_property
    def _entries(self) -> Mapping[str, LayerEntry]:
        stack = self._remains.stack
        return {} if stack is None else {entry.src: entry for entry in stack.root.layers()}

    @cached_property
    def _limited(self) -> frozenset[int]:
        """Gives the layers of whose paint their pictures show a part alone: within masks and bases, or a cell over and
        over."""
        root = self._manifest.root
        masks = {one.masks: Selection(Pyramid()) for one in self._manifest.selections if one.masks is not None}
        wrapped = (layer.id for layer in layers.layers(root) if layer.wrap is not None)
        return frozenset((*bases_of(with_masks(root, masks)), *wrapped))

    def _shown(self, layer: Layer) -> Shown | None:
        """Returns the picture of a layer's paint and its place, if that is whole."""
        name = f"data/L{layer.id}.png"
        if layer.id in self._limited:
            return None
        entry = self._entries.get(name)
        pixels = None if entry is None else self._remains.png(name)
        if entry is None or pixels is None:
            return None
        level = shown_level(self._manifest.frame)
        at = self._manifest.frame.zoomed(level)
        return Shown(pixels, Rect.at(at.x0 + entry.x, at.y0 + entry.y, pixels.shape[1], pixels.shape[0]), level, at)

    def _textures(self) -> Map[str, Texture]:
        found: Map[str, Texture] = Map()
        for name, texture in self._manifest.textures.items():
            try:
                one = replace(self._manifest, textures={name: texture})
                found = found.update(one.textures_with(self._remains.pictures))
            except FieldError:
                self._notes.append(NO_TEXTURE.format(name=shown(name)))
        return found
