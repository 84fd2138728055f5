"""What each command makes of a painting.

A painting never changes: `apply` gives the next one, which shares all that is untouched with the one before.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

from engine.canvas import layers
from engine.canvas.layers import Group, Layer, Node
from engine.canvas.node_checks import LayerError
from engine.canvas.placing import loops
from engine.canvas.placing.placement import Placement
from engine.canvas.selecting.placed_mask import laid_again, reposed
from engine.checks.field_error import FieldError
from engine.checks.roles import AS_HEIGHT, COPIED
from engine.makers.makers import define
from engine.painting import commands as c
from engine.painting.guiding.guides import GuideCommand, guides_after
from engine.painting.layering.touch_command import TouchCommand, touches_after
from engine.painting.places import BookmarkCommand, bookmarks_after
from engine.painting.textures import Around
from engine.painting.value import Painting, Refusal, new_layer, with_node
from engine.session.copied_part import lifted, pasted, with_copy, with_cut
from engine.session.landforms.erosion import worn
from engine.session.landforms.laid_map import with_ground
from engine.session.lifting.moved_part import part_moved
from engine.session.masking import made_paint, mask_for, with_mask_applied
from engine.session.merging import cleared, flattened_group, flattened_whole, merged_down
from engine.session.moving import elsewhere
from engine.session.picturing import with_picture, with_pictures
from engine.session.selecting import selected
from engine.session.whole_painting import with_painting
from engine.strokes.example_stroke import kind_of, swapped
from engine.strokes.filling import filled

__all__ = ["STEPS", "Around", "Painting", "Refusal", "apply"]

NOWHERE = Around()
_CAUSES = (LayerError, FieldError)
_BOOKMARKS: tuple[type, ...] = c.COMMANDS["bookmark"].records


def apply(painting: Painting, command: c.Command, around: Around = NOWHERE) -> Painting:
    """Returns the painting after a command.  `undo`, `redo` and `view` change nothing here: they belong to the session.

    Refusal if the command cannot be done; FileError if a file that it names cannot be read.
    """
    change = _CHANGES.get(type(command))
    if change is None:
        return painting
    try:
        return change(painting, command, around)
    except _CAUSES as error:
        raise Refusal(str(error)) from None


def _stroke(painting: Painting, command: c.Stroke, around: Around) -> Painting:
    live = kind_of(command.brush)(
        painting,
        command.level,
        command.origin,
        command.brush,
        around.cache,
        command.layer,
        command.seed,
        command.copies,
        command.onto,
        command.seen,
    )
    live.lay(command.points)
    return live.commit()


def _swap(painting: Painting, command: c.Swap, around: Around) -> Painting:
    return swapped(painting, command)


def _fill(painting: Painting, command: c.Fill, around: Around) -> Painting:
    return filled(painting, command, around.cache)


def _add(painting: Painting, command: c.AddLayer, around: Around) -> Painting:
    plain = command.kind == "layer"
    node = new_layer(painting, command.name) if plain else Group(layers.next_id(painting.root), command.name)
    return with_node(painting, node, command.group, command.to)


def _add_picture(painting: Painting, command: c.AddPicture, around: Around) -> Painting:
    after = with_picture(painting, command)
    return after if command.role != AS_HEIGHT else replace(after, root=_only_heights(after.root, command.name))


def _add_pictures(painting: Painting, command: c.AddPictures, around: Around) -> Painting:
    return with_pictures(painting, command)


def _add_painting(painting: Painting, command: c.AddPainting, around: Around) -> Painting:
    return with_painting(painting, command)


def _add_placement(painting: Painting, command: c.AddPlacement, around: Around) -> Painting:
    made = Placement(layers.next_id(painting.root), command.name)
    node = replace(made, **_placed(painting.root, made, command.placing))
    return _shown(with_node(painting, node, command.group, command.to))


def _bake(painting: Painting, command: c.BakePlacement, around: Around) -> Painting:
    node = layers.find(painting.root, command.name)
    if not isinstance(node, Placement):
        raise LayerError(f"layer {command.name!r}: found no placement, expected one to make paint of")
    if layers.is_locked(painting.root, command.name):
        raise LayerError(f"layer {command.name!r}: found it locked, expected one that is not")
    layer = made_paint(painting, node, command.level)
    return _shown(replace(painting, root=layers.substitute(painting.root, node.name, layer)))


def _flatten(painting: Painting, command: c.FlattenGroup, around: Around) -> Painting:
    return flattened_whole(painting) if command.name is None else flattened_group(painting, command.name)


def _placed(root: Group, node: Placement, placing: c.Placing) -> dict[str, Any]:
    """Returns the fields of a placement that are to change."""
    shown = laid_again(reposed(node, placing.posed(node.pose)))
    out: dict[str, Any] = {"pose": shown.pose, "mask": shown.mask, **placing.fields()}
    if not isinstance(placing.of, c.Same):
        out["of"] = None if placing.of is None else layers.find(root, placing.of).id
    return out


def _shown(painting: Painting) -> Painting:
    """Returns the painting itself, if all its placements can be shown; else LayerError."""
    loops.checked(painting.root)
    return painting


def _select(painting: Painting, command: c.SelectLayer, around: Around) -> Painting:
    return replace(painting, active=layers.find(painting.root, command.name).name)


def _remove(painting: Painting, command: c.RemoveLayer, around: Around) -> Painting:
    showing = loops.showing(painting.root, command.name)
    if showing:
        names = ", ".join(repr(one.name) for one in showing[:3]) + (", ..." if len(showing) > 3 else "")
        raise LayerError(f"layer {command.name!r}: found {names} showing it, expected no placement that does")
    group, position = layers.place(painting.root, command.name)
    root = layers.remove(painting.root, command.name)
    active = painting.active
    if active is not None and not layers.has(root, active):
        active = _neighbour(root, group, position)
    return replace(painting, root=root, active=active)


def _neighbour(root: Group, group: str | None, position: int) -> str | None:
    """The layer to go on with when the one at a position was removed: the one below, above, else the topmost."""
    holder = root if group is None else layers.find(root, group)
    assert isinstance(holder, Group)
    siblings = [*holder.children[position - 1 : position], *holder.children[position : position + 1]]
    near = [node.name for node in siblings if _shown_to_artist(node)]
    return next(iter(near), None) or next(
        (node.name for node in reversed(list(layers.layers(root))) if _shown_to_artist(node)), None
    )


def _shown_to_artist(node: Node) -> bool:
    return isinstance(node, Layer) and node.role != COPIED


def _rename(painting: Painting, command: c.RenameLayer, around: Around) -> Painting:
    root = layers.rename(painting.root, command.name, command.to)
    active = command.to if painting.active == command.name else painting.active
    return replace(painting, root=root, active=active)


def _duplicate(painting: Painting, command: c.DuplicateLayer, around: Around) -> Painting:
    made = _duplicated(painting, command)
    if command.placing is not None:
        return _set(replace(made, active=command.to), c.SetLayer(command.to, placing=command.placing), around)
    return made


def _duplicated(painting: Painting, command: c.DuplicateLayer) -> Painting:
    node = layers.find(painting.root, command.name)
    if command.selected is not None:
        return lifted(painting, command)
    if isinstance(node, Layer) and node.role == COPIED:
        return pasted(painting, node, command.to)
    root = layers.duplicate(painting.root, command.name, command.to)
    paint = isinstance(layers.find(root, command.to), Layer)
    return replace(painting, root=root, active=command.to if paint else painting.active)


def _move(painting: Painting, command: c.MoveLayer, around: Around) -> Painting:
    group = command.group
    if isinstance(group, c.Same):
        group = layers.place(painting.root, command.name)[0]
    return _shown(replace(painting, root=layers.move(painting.root, command.name, group, command.to)))


def _set(painting: Painting, command: c.SetLayer, around: Around) -> Painting:
    changes: Mapping[str, Any] = command.changes
    if "blend" in changes:
        changes = {**changes, "blend": changes["blend"].removeprefix("svg:")}
    if command.mask is not None:
        painting = with_mask_applied(painting, command)
        mask = mask_for(painting, command)
        painting = replace(painting, root=layers.set_fields(painting.root, command.name, mask=mask))
    if command.placing is not None:
        node = layers.find(painting.root, command.name)
        if isinstance(node, Placement) and command.selected is None:
            changes = {**changes, **_placed(painting.root, node, command.placing)}
        else:
            if layers.is_locked(painting.root, command.name):
                raise LayerError(f"layer {command.name!r}: found it locked, expected one that is not")
            painting = _all_or_part_moved(painting, node, command)
    if not changes:
        return _shown(painting)
    root = layers.set_fields(painting.root, command.name, **changes)
    if changes.get("role") == AS_HEIGHT:
        root = _only_heights(root, command.name)
    return _shown(replace(painting, root=root))


def _only_heights(root: Group, name: str) -> Group:
    """Returns the tree in which no other node has the role of heights."""
    for node in list(layers.walk(root)):
        if not isinstance(node, Group) and node.role == AS_HEIGHT and node.name != name:
            root = layers.set_fields(root, node.name, role="")
    return root


def _all_or_part_moved(painting: Painting, node: Node, command: c.SetLayer) -> Painting:
    if command.selected is None and not isinstance(node, Placement):
        assert command.placing is not None
        return elsewhere(painting, node, command.placing)
    return part_moved(painting, node, command)


def _texture(painting: Painting, command: c.DefineTexture, around: Around) -> Painting:
    within = replace(around, arithmetic=painting.arithmetic, touches=painting.touches, textures=painting.textures)
    texture = define(command, painting.root, within)
    return replace(painting, textures=painting.textures.set(command.name, texture))


def _bookmark(painting: Painting, command: BookmarkCommand, around: Around) -> Painting:
    return replace(painting, bookmarks=bookmarks_after(painting.bookmarks, command))


def _choose(painting: Painting, command: c.Select, around: Around) -> Painting:
    return selected(painting, command)


def _touch(painting: Painting, command: TouchCommand, around: Around) -> Painting:
    return replace(painting, touches=touches_after(painting.touches, command))


def _guide(painting: Painting, command: GuideCommand, around: Around) -> Painting:
    return replace(painting, guides=guides_after(painting.guides, command))


_CHANGES: dict[type, Callable[[Painting, Any, Around], Painting]] = {
    c.Stroke: _stroke,
    c.Fill: _fill,
    c.AddLayer: _add,
    c.AddPicture: _add_picture,
    c.AddPictures: _add_pictures,
    c.AddPainting: _add_painting,
    c.AddPlacement: _add_placement,
    c.BakePlacement: _bake,
    c.MergeLayer: lambda painting, command, around: merged_down(painting, command.name),
    c.FlattenGroup: _flatten,
    c.ClearLayer: lambda painting, command, around: cleared(painting, command.name, command.outside),
    c.SetPaper: lambda painting, command, around: painting.on_paper(command.colour),
    c.Erode: worn,
    c.LayGround: with_ground,
    c.SetFrame: lambda painting, command, around: painting.framed(command.rect),
    c.SelectLayer: _select,
    c.RemoveLayer: _remove,
    c.RenameLayer: _rename,
    c.DuplicateLayer: _duplicate,
    c.MoveLayer: _move,
    c.SetLayer: _set,
    c.CopyPaint: lambda painting, command, around: with_copy(painting, command.name),
    c.CutPaint: lambda painting, command, around: with_cut(painting, command.name),
    c.PastePaint: lambda painting, command, around: pasted(painting, painting.copied, command.name),
    c.DefineTexture: _texture,
    c.Swap: _swap,
    c.Select: _choose,
    **dict.fromkeys(_BOOKMARKS, _bookmark),
    **dict.fromkeys(c.COMMANDS["guide"].records, _guide),
    **dict.fromkeys(c.COMMANDS["touch"].records, _touch),
}
# The commands that undo takes back.  Choosing a layer is no step, nor is copying from one; nor is defining a texture:
# strokes keep the one they had.
STEPS = frozenset(_CHANGES) - {c.SelectLayer, c.CopyPaint, c.DefineTexture, *_BOOKMARKS}
