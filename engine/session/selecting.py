"""What a select command makes of a painting: no pixel of it changes, only what later strokes are limited to."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from engine.brush import copies, prints, relief
from engine.brush.dabs import Stroker, stroke_key
from engine.brush.mask import Coverage, StrokeMask
from engine.canvas import layers
from engine.canvas.attenuate import fold
from engine.canvas.flatten import flattened
from engine.canvas.layers import Layer
from engine.canvas.selecting import outlines
from engine.canvas.selecting.joining import alpha_of, joined_with, joined_with_another, with_more
from engine.canvas.selecting.occupied import alpha_at
from engine.canvas.selecting.placed_mask import mask_here
from engine.canvas.selecting.rims import rim_moved
from engine.canvas.selecting.selection import EVERYTHING, Selection
from engine.canvas.store import Pyramid
from engine.painting.fill_command import Like
from engine.painting.select_commands import Box, Line, MaskOf, Named, Select, Source, Whole
from engine.painting.value import Painting, Refusal
from engine.strokes.likeness import alike


def selected(painting: Painting, command: Select) -> Painting:
    """Returns a painting with something else selected.  Refusal if that would be nothing at all, or the source is not
    there; FieldError if it is too large."""
    found = _found(painting, command)
    saved = painting.selections
    if command.keep is not None:
        name = command.keep
        saved = saved.set(name, found) if found is not None else saved.delete(name) if name in saved else saved
    return replace(painting, selection=found, selections=saved)


def _found(painting: Painting, command: Select) -> Selection | None:
    source, old = command.source, painting.selection
    if isinstance(source, Whole) and source.what == "none":
        return None
    if isinstance(source, Whole):
        whole = EVERYTHING if source.what == "all" else (EVERYTHING if old is None else old).inverted()
        return _something(_changed(painting, whole, command))
    if source is None:
        return _something(_changed(painting, _present(old), command))
    if isinstance(source, Named | MaskOf):
        other = _changed(painting, _named(painting, source), command)
        if old is None or command.op == "replace":
            return _something(joined_with_another(old, other, Coverage(0, {}, outlines.EMPTY_RECT), command.op))
        return _something(joined_with_another(old, other, alpha_at(other.pyramid, command.level, "select"), command.op))
    coverage = COVERAGES[type(source)](painting, source)
    coverage = rim_moved(coverage, command.grow, command.feather, painting.grid, "select")
    return _something(joined_with(old, coverage, command.op, painting.grid))


def _present(old: Selection | None) -> Selection:
    if old is None:
        raise Refusal("select: found nothing selected, expected a selection to change or to keep")
    return old


def _something(selection: Selection) -> Selection:
    """Returns a selection itself; Refusal if nothing is in it."""
    folded = replace(selection, pyramid=fold(selection.pyramid))
    if folded.pyramid.coarsest is None and not folded.inverse:
        raise Refusal('select: found that nothing would be selected, expected some pixels; "none" takes it away')
    return folded


def _changed(painting: Painting, selection: Selection, command: Select) -> Selection:
    """Returns a selection grown and feathered at the command's level, by which it has no finer rim any more."""
    if not (command.grow or command.feather) or selection.everything:
        return selection
    here = alpha_at(selection.pyramid, command.level, "select")
    by = -command.grow if selection.inverse else command.grow
    there = rim_moved(here, by, command.feather, painting.grid, "select")
    return Selection(with_more(Pyramid(grid=painting.grid), there), selection.inverse)


def _named(painting: Painting, source: Named | MaskOf) -> Selection:
    if isinstance(source, MaskOf):
        mask = mask_here(layers.find(painting.root, source.name))
        if mask is None:
            raise Refusal(f"select: found no mask of {source.name!r}, expected a layer or group that has one")
        return Selection(mask.pyramid.branched(), mask.inverse)
    if source.saved:
        found = painting.selections.get(source.name)
        if found is None:
            known = ", ".join(map(ascii, sorted(painting.selections))) or "none was kept"
            raise Refusal(f"select: found no selection {source.name!a}, expected one of those kept: {known}")
        return found
    node = layers.find(painting.root, source.name)
    if not isinstance(node, Layer):
        raise Refusal(f"select: found {node.name!r}, which is a {type(node).__name__.lower()}, expected a layer")
    return Selection(alpha_of((flattened(node) if node.growth else node).pyramid))


def _boxed(painting: Painting, box: Box) -> Coverage:
    make = outlines.rounded_off if box.round else outlines.boxed
    return make(box.level, box.rect, "select.ellipse" if box.round else "select.rect")


def _lined(painting: Painting, line: Line) -> Coverage:
    """Returns what a line goes round, or what the stroke along it covers."""
    level, brush = line.level, line.brush
    if brush is None:
        return outlines.outlined(level, line.origin, line.points[:, :2], "select.outline")
    textures = painting.known_textures
    pattern = prints.for_copies(prints.resolve(brush, textures, level, painting.seed), line.copies)
    stroker = Stroker(brush, stroke_key(painting.seed, level, line.origin))
    mask = StrokeMask(level, line.origin, tip=pattern, each=copies.each(line.copies))
    for dabs in copies.copied(stroker.whole(line.points), line.copies):
        mask.paint(dabs)
    thinning = relief.resolve(brush, textures, level, (painting.seed, painting.seed), "select.stroke.brush")
    return thinning.over(mask.coverage())


def _alike(painting: Painting, like: Like) -> Coverage:
    """Returns the region of a pixel, as far as it is looked for."""
    return alike(painting, like, True, None, "select")


# Of each source that covers a part of the canvas by itself: what that is, at its own level.
COVERAGES: dict[type[Source], Callable[..., Coverage]] = {Box: _boxed, Line: _lined, Like: _alike}
