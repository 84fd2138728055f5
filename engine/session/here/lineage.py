"""How layers came to their paint: each has a chain of what was done to it, the newest first.  No pixel is in it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from immutables import Map

from engine.canvas import layers
from engine.canvas.heaps.heaps import NO_HEAPS
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.merging.cleared import Outside, framing
from engine.canvas.placing.placement import Placement
from engine.canvas.placing.pose import UNMOVED, Pose, SourcePart
from engine.canvas.selecting.selection import Selection
from engine.canvas.store import Pyramid
from engine.numeric.address import Rect
from engine.numeric.similarity import Similarity
from engine.painting import commands as c
from engine.painting.layer_commands import CUT
from engine.painting.layering.mask_member import MASK_APPLY, MaskOp
from engine.painting.value import Painting
from engine.session.here.chosen import NO_DEFINITIONS, ByCommand, Definitions
from engine.session.merging import PLAIN_BLEND
from engine.session.picturing import picture_of


@dataclass(frozen=True, eq=False, slots=True)
class LoggedStep:
    """`index`: the place of its command in the `log`, from 0; `number`: how many steps were done with it, from 1;
    `textures`: those defined when it was done; `locked`: whether the alpha of a stroke's layer was."""

    index: int
    number: int
    log: Sequence[c.Command]
    textures: Definitions
    locked: bool = False

    @property
    def command(self) -> c.Command:
        """Gives its command, which the log may have on disk."""
        return self.log[self.index]


@dataclass(frozen=True, eq=False, slots=True)
class Laid:
    """A stroke or a fill, limited by what was selected, on a layer that wrapped around so, when the painting had such a
    frame; `before`: what was there."""

    step: LoggedStep
    before: Past
    limit: Selection | None
    wrap: SourcePart | None
    frame: Rect


@dataclass(frozen=True, eq=False, slots=True)
class Left:
    """What was left of the paint before: what lay in a selection, or (`outside`) all but that."""

    part: Selection | Outside
    outside: bool
    before: Past


@dataclass(frozen=True, eq=False, slots=True)
class Moved:
    """The paint before is shown elsewhere, through a similarity of quarter turns."""

    by: Similarity
    before: Past


@dataclass(frozen=True, eq=False, slots=True)
class Joined:
    """What some nodes of a tree showed together, bottom first, with what each of its layers came to."""

    nodes: tuple[Node, ...]
    root: Group
    pasts: Pasts


@dataclass(frozen=True, eq=False, slots=True)
class Given:
    """Paint that no stroke laid, or none that is done: the layer as the painting began with it, the command that
    brought a picture, or the step that pasted it."""

    layer: Layer | None = None
    picture: c.AddPicture | None = None
    textures: Definitions = NO_DEFINITIONS
    pasted: LoggedStep | None = None


Past = Laid | Left | Moved | Joined | Given | None
Pasts = Map[int, Past]  # by the layer's id


@dataclass(frozen=True, eq=False, slots=True)
class CopiedPast:
    """What the paint came to that was copied last, after so many steps, of which `step` was the last."""

    past: Past
    count: int
    step: LoggedStep | None


class Change(NamedTuple):
    """A step that paints nothing: the paintings without paint around it, what was, and the step."""

    before: Painting
    after: Painting
    pasts: Pasts
    step: LoggedStep
    pasted: Past = None


def given(root: Group) -> Pasts:
    """Returns what the layers of a tree begin with."""
    painted = (layer for layer in layers.layers(root) if layer.pyramid.levels or layer.growth)
    return Map({layer.id: Given(layer) for layer in painted})


def pasts_after(change: Change) -> Pasts:
    """Returns what the layers came to by a step that paints nothing."""
    row = _ROWS.get(type(change.step.command))
    if row is None or change.before is change.after:
        return change.pasts
    pasts: Pasts = row(change, change.step.command)
    held = {node.id for node in layers.walk(change.after.root)}
    gone = [number for number in pasts if number not in held]
    for number in gone:  # a later layer may get the number of one that is gone
        pasts = pasts.delete(number)
    return pasts


def _duplicated(change: Change, command: c.DuplicateLayer) -> Pasts:
    pasts, original = change.pasts, layers.find(change.before.root, command.name)
    copies = _copies(change.after.root, original, command.to)
    for one, copy in zip(_within(original), copies, strict=True):
        pasts = pasts.set(copy.id, pasts.get(one.id))
    selection = change.before.selection
    if command.selected is not None and isinstance(original, Layer):
        if selection is not None:
            pasts = pasts.set(copies[0].id, _left(selection, False, pasts.get(copies[0].id)))
        if command.selected == CUT:
            pasts = _emptied(change, pasts, original, selection)
    if command.placing is not None and layers.find(change.after.root, command.to).id == copies[0].id:
        pasts = _placed(pasts, copies[0], command.placing)
    return pasts


def past_copied(painting: Painting, pasts: Pasts, name: str) -> Past:
    """Returns what the paint comes to that is copied from a layer."""
    past = pasts.get(layers.find(painting.root, name).id)
    return past if painting.selection is None else _left(painting.selection, False, past)


def _copies(root: Group, original: Node, to: str) -> list[Node]:
    """Returns the nodes of a copy in the order of the original's; the copy itself may lie beside what shows it."""
    made = layers.find(root, to)
    if type(made) is not type(original):  # moved by any turn: it is shown from beside
        source = getattr(made, "of", None)
        made = next(node for node in layers.walk(root) if node.id == source)
    return _within(made)


def _set(change: Change, command: c.SetLayer) -> Pasts:
    node, pasts = layers.find(change.before.root, command.name), change.pasts
    if command.mask == MaskOp(MASK_APPLY) and isinstance(node, Layer) and node.mask is not None:
        pasts = pasts.set(node.id, _left(node.mask, False, pasts.get(node.id)))
    if command.placing is None:
        return pasts
    if command.selected is not None and isinstance(node, Layer):
        return _part_moved(change, pasts, node, command)
    stays = isinstance(layers.find(change.after.root, command.name), Layer | Group)
    return _placed(pasts, node, command.placing) if stays else pasts


def _part_moved(change: Change, pasts: Pasts, node: Layer, command: c.SetLayer) -> Pasts:
    """Returns what the layers came to when a part of one was moved: in it, or on a new one above it."""
    past, chosen = pasts.get(node.id), change.before.selection
    if past is None or chosen is None or command.placing is None:
        return pasts
    part = _left(chosen, False, past)
    rest = _left(chosen, True, past) if command.selected == CUT else past
    pose = command.placing.posed(UNMOVED)
    by = pose.similarity
    if by.quarter is None and command.baked is not None:
        return pasts.set(node.id, _sampled_over(rest, part, pose))
    if by.quarter is None:
        held = {one.id for one in layers.walk(change.before.root)}
        new = next(one for one in layers.layers(change.after.root) if one.id not in held)
        return pasts.set(node.id, rest).set(new.id, part)
    nodes = Layer(1, "rest"), Layer(2, "part")
    both: Pasts = Map({1: rest, 2: Moved(by, part)})
    return pasts.set(node.id, Joined(nodes, Group(0, "root", children=nodes), both))


def _sampled_over(rest: Past, part: Past, pose: Pose) -> Past:
    """Returns what a layer comes to with a part of it sampled elsewhere in it."""
    below, shown = Layer(1, "rest"), Placement(3, "shown", of=2, pose=pose)
    root = Group(0, "root", children=(below, Layer(2, "part", visible=False), shown))
    both: Pasts = Map({1: rest, 2: part})
    return Joined((below, shown), root, both)


def _placed(pasts: Pasts, node: Node, placing: c.Placing) -> Pasts:
    by = placing.posed(UNMOVED).similarity
    if by.quarter is None:
        return pasts
    for one in _within(node):
        if isinstance(one, Layer) and pasts.get(one.id) is not None:
            pasts = pasts.set(one.id, Moved(by, pasts[one.id]))
    return pasts


def _merged(change: Change, command: c.MergeLayer) -> Pasts:
    root = change.before.root
    group, position = layers.place(root, command.name)
    holder = root if group is None else layers.find(root, group)
    assert isinstance(holder, Group)
    lower, upper = holder.children[position - 1], holder.children[position]
    onto = upper.clip and not lower.clip
    below = replace(lower, blend=PLAIN_BLEND, clip=False, opacity=1.0 if onto else lower.opacity)
    above = upper if onto else replace(upper, clip=False)
    return change.pasts.set(lower.id, Joined((below, above), root, change.pasts))


def _flattened(change: Change, command: c.FlattenGroup) -> Pasts:
    root = layers.pictured(change.before.root)
    if command.name is not None:
        group = layers.find(root, command.name)
        assert isinstance(group, Group)
        return change.pasts.set(group.id, Joined(group.children, root, change.pasts))
    seen = tuple(node for node in root.children if node.visible)
    return change.pasts.set(seen[0].id, Joined(seen, root, change.pasts))


def _baked(change: Change, command: c.BakePlacement) -> Pasts:
    node = replace(layers.find(change.before.root, command.name), opacity=1.0, visible=True, clip=False)
    return change.pasts.set(node.id, Joined((replace(node, blend=PLAIN_BLEND),), change.before.root, change.pasts))


def _cleared(change: Change, command: c.ClearLayer) -> Pasts:
    before, pasts = change.before, change.pasts
    part = framing(before.frame) if command.outside else before.selection
    if command.name is None:
        free = [one for one in layers.layers(before.root) if not layers.is_locked(before.root, one.name)]
    else:
        free = [one for one in layers.layers(before.root) if one.name == command.name]
    for layer in free:
        pasts = _emptied(change, pasts, layer, part)
    return pasts


def _emptied(change: Change, pasts: Pasts, layer: Layer, part: Selection | Outside | None) -> Pasts:
    past = None if part is None else _left(part, True, pasts.get(layer.id))
    return pasts.set(layer.id, past)


def _left(part: Selection | Outside, outside: bool, before: Past) -> Past:
    return None if before is None else Left(part, outside, before)


def _cut(change: Change, command: c.CutPaint) -> Pasts:
    layer = layers.find(change.before.root, command.name)
    assert isinstance(layer, Layer)
    return _emptied(change, change.pasts, layer, change.before.selection)


def _pasted(change: Change, command: c.PastePaint) -> Pasts:
    return change.pasts.set(layers.find(change.after.root, command.name).id, change.pasted)


def _with_picture(change: Change, command: c.AddPicture) -> Pasts:
    number = layers.find(change.after.root, command.name).id
    return change.pasts.set(number, Given(None, command, change.step.textures))


def _with_pictures(change: Change, command: c.AddPictures) -> Pasts:
    pasts, held = change.pasts, {node.name: node.id for node in layers.walk(change.after.root)}
    for one in command.pictures():
        pasts = pasts.set(held[one.name], Given(None, picture_of(command, one), change.step.textures))
    return pasts


_ROWS: dict[type, Callable[..., Pasts]] = {
    c.DuplicateLayer: _duplicated,
    c.SetLayer: _set,
    c.MergeLayer: _merged,
    c.FlattenGroup: _flattened,
    c.BakePlacement: _baked,
    c.ClearLayer: _cleared,
    c.AddPicture: _with_picture,
    c.AddPictures: _with_pictures,
    c.CutPaint: _cut,
    c.PastePaint: _pasted,
    c.RemoveLayer: lambda change, command: change.pasts,
}


def moved_along(change: Change) -> Painting:
    """Returns the painting after a step, in which the masks of what was moved, or the selection that was moved with a
    part of a layer, are known as moved."""
    command, after = change.step.command, change.after
    if not isinstance(command, c.SetLayer | c.DuplicateLayer) or command.placing is None:
        return after
    by = command.placing.posed(UNMOVED).similarity
    if isinstance(command, c.SetLayer) and command.selected is not None:
        chosen = change.before.selection
        return replace(after, selection=chosen.moved(by)) if isinstance(chosen, ByCommand) else after
    name = command.name if isinstance(command, c.SetLayer) else command.to
    before, node = layers.find(change.before.root, command.name), layers.find(after.root, name)
    if by.quarter is None or type(before) is not type(node):
        return after
    root = after.root
    for one, moved in zip(_within(before), _within(node), strict=True):
        mask = None if isinstance(one, Placement) else one.mask
        if isinstance(mask, ByCommand):
            root = layers.set_fields(root, moved.name, mask=mask.moved(by))
    return replace(after, root=root)


def mask_painted(painting: Painting, layer: Layer, step: LoggedStep) -> Painting:
    """Returns the painting after a stroke or fill on a layer's mask, which is known by that from then on."""
    if layer.mask is None:
        return painting
    mask = ByCommand(Pyramid(), off=layer.mask.off, number=step.number, masks=layer.name)
    return replace(painting, root=layers.set_fields(painting.root, layer.name, mask=mask))


def _within(node: Node) -> list[Node]:
    return [node, *layers.walk(node)] if isinstance(node, Group) else [node]


def bare(group: Group) -> Group:
    """Returns the same layers without any paint."""
    return replace(group, children=tuple(_without_paint(child) for child in group.children))


def _without_paint(node: Node) -> Node:
    if isinstance(node, Group):
        return bare(node)
    return unpainted(node) if isinstance(node, Layer) else node


def unpainted(layer: Layer) -> Layer:
    """Returns the same layer without any paint."""
    return replace(layer, pyramid=Pyramid(), growth=(), heaps=NO_HEAPS)
