"""What a step is called where the artist reads it: a few words."""

from __future__ import annotations

from engine.checks.roles import AS_HEIGHT, REFERENCE
from engine.painting import commands as c
from engine.painting.fill_command import place_of
from engine.painting.layering.mask_member import (
    MASK_APPLY,
    MASK_EMPTY,
    MASK_FULL,
    MASK_INVERT,
    MASK_LAY,
    MASK_OFF,
    MASK_ON,
    MaskOp,
)
from engine.painting.select_commands import Box, Line, MaskOf, Named, Whole
from engine.painting.times import time_of
from engine.session.steps import LoggedStep
from engine.studio.past.past_records import PastStep


def told(step: LoggedStep, serial: int) -> PastStep:
    """Returns what the window is told of a step of the painting of that number."""
    command, picture = step.command, f"step {serial}.{step.index}"
    when = time_of(command)
    if isinstance(command, c.Stroke):
        title = f"{command.brush.row.label} on the mask" if command.onto else command.brush.row.label
        return PastStep(step.index, step.number, title, picture, command.brush, command.level, when)
    if isinstance(command, c.Fill):
        title = "Adjust" if command.whole else "Fill the mask" if command.onto else "Fill"
        return PastStep(step.index, step.number, title, picture, command.brush, place_of(command)[0], when, sign="fill")
    title = _title(command)
    return PastStep(step.index, step.number, title, picture, time=when, kind=_kind(command, title), sign=_sign(command))


_SIGNS: dict[type, str] = {
    c.Select: "selection",
    c.MergeLayer: "merge",
    c.FlattenGroup: "merge",
    c.DuplicateLayer: "copy",
    c.CutPaint: "copy",
    c.PastePaint: "copy",
    c.RemoveLayer: "delete",
    c.ClearLayer: "delete",
    c.AddPicture: "picture",
    c.AddPictures: "picture",
    c.AddPainting: "picture",
    c.AddPlacement: "placement",
    c.BakePlacement: "placement",
    c.SetFrame: "frame",
    c.Guide: "guide",
    c.RemoveGuide: "guide",
    c.Touch: "solid",
    c.CleanSolid: "solid",
}


def _sign(command: c.Command) -> str:
    """Returns what a step deals with, for which it has a picture of its own."""
    if isinstance(command, c.SetLayer):
        return "mask" if command.mask is not None else "layer" if command.placing is None else "move"
    return _SIGNS.get(type(command), "layer")


def _kind(command: c.Command, title: str) -> str:
    """Returns what steps in a row are shown together as: changes of the selection, and one layer being moved."""
    if isinstance(command, c.Select):
        return "Selection"
    moved = isinstance(command, c.SetLayer) and command.placing is not None and command.selected is None
    return title if moved else ""


def _title(command: c.Command) -> str:
    match command:
        case c.AddLayer(name=name, kind=kind):
            return f"New {kind} “{name}”"
        case c.AddPlacement(name=name):
            return f"Show again: “{name}”"
        case c.AddPicture(name=name) | c.AddPictures(name=name) | c.AddPainting(name=name):
            return f"Bring in “{name}”"
        case c.BakePlacement(name=name) | c.MergeLayer(name=name):
            return f"Make paint of “{name}”" if isinstance(command, c.BakePlacement) else f"Merge “{name}” down"
        case c.FlattenGroup(name=name):
            return "Merge visible" if name is None else f"Merge group “{name}”"
        case c.ClearLayer(name=name, outside=outside):
            return "Delete outside the frame" if outside else f"Clear “{name}”"
        case c.Erode() | c.LayGround():
            return "Erode" if isinstance(command, c.Erode) else "Ground"
        case c.SetFrame() | c.SetPaper():
            return "Frame" if isinstance(command, c.SetFrame) else "Paper"
        case c.RemoveLayer(name=name):
            return f"Delete “{name}”"
        case c.RenameLayer(name=name, to=to):
            return f"“{name}” is now “{to}”"
        case c.DuplicateLayer(name=name, selected=selected, aside=aside):
            words = {"copy": "Copy", "cut": "Cut"} if aside else {"copy": "Copy from", "cut": "Cut from"}
            return f"{words.get(selected or '', 'Duplicate')} “{name}”"
        case c.CutPaint(name=name) | c.PastePaint(name=name):
            return f"{'Cut' if isinstance(command, c.CutPaint) else 'Paste'} “{name}”"
        case c.MoveLayer(name=name):
            return f"Order of “{name}”"
        case c.SetLayer():
            return _setting(command)
        case c.Select():
            return _selecting(command)
        case c.Guide(name=name) | c.RemoveGuide(name=name):
            return f"Guide “{name}”" if isinstance(command, c.Guide) else f"No guide “{name}”"
        case c.Touch(solid=solid) | c.CleanSolid(solid=solid):
            return f"Paint on “{solid}”" if isinstance(command, c.Touch) else f"Clean “{solid}”"
        case c.Swap(example=example):
            return f"Swap for {example}"
    return type(command).__name__


_JOINING = {"replace": "Select", "add": "Select more", "subtract": "Select less", "intersect": "Select in both"}
_WHOLE = {"all": "Select all", "none": "Select nothing", "invert": "Invert selection"}
_MASK_OPS = {
    MASK_FULL: "Mask of {} shows all",
    MASK_EMPTY: "Mask of {} hides all",
    MASK_INVERT: "Invert mask of {}",
    MASK_APPLY: "Apply mask of {}",
    MASK_OFF: "Mask of {} off",
    MASK_ON: "Mask of {} on",
    MASK_LAY: "Lay mask of {} anew",
}


def _selecting(command: c.Select) -> str:
    match command.source:
        case Whole(what=what):
            return _WHOLE[what]
        case None:
            changes = {"Grow": command.grow > 0, "Shrink": command.grow < 0, "Feather": command.feather > 0}
            first = next((name for name, given in changes.items() if given), None)
            return f"Keep selection “{command.keep}”" if first is None else f"{first} selection"
        case Named(name=name):
            return f"{_JOINING[command.op]}: “{name}”"
        case MaskOf(name=name):
            return f"{_JOINING[command.op]}: mask of “{name}”"
        case Box(round=round_one):
            what = "ellipse" if round_one else "rectangle"
        case Line(brush=brush):
            what = "outline" if brush is None else "by brush"
        case _:
            what = "like colour"
    return f"{_JOINING[command.op]}: {what}"


def _placing(name: str, placing: c.Placing) -> str:
    """Returns how a layer was moved."""
    quarter = placing.turn not in (0, c.Same.SAME)
    turned, scaled = quarter or placing.turned is not c.Same.SAME, placing.levels not in (0, c.Same.SAME)
    mirrored = placing.mirror is True
    if turned + scaled + mirrored > 1:
        return f"Transform “{name}”"
    return f"{'Turn' if turned else 'Scale' if scaled else 'Mirror' if mirrored else 'Move'} “{name}”"


_ROLES = {REFERENCE: "a reference", AS_HEIGHT: "the height of the land"}


def _setting(command: c.SetLayer) -> str:
    """Returns what of a layer was set, of several things the first."""
    name, changes = command.name, command.changes
    if command.selected is not None:
        return f"{'Copy' if command.selected == 'copy' else 'Move'} a part of “{name}”"
    if command.placing is not None:
        return _placing(name, command.placing)
    if "role" in changes:
        return f"“{name}” is {_ROLES.get(changes['role'], 'part of the picture')}"
    if "clip" in changes:
        return f"Clip “{name}”" if changes["clip"] else f"Unclip “{name}”"
    if "visible" in changes:
        return f"{'Show' if changes['visible'] else 'Hide'} “{name}”"
    if "opacity" in changes:
        return f"Opacity of “{name}”: {changes['opacity']:.0%}"
    if isinstance(command.mask, MaskOp):
        return _MASK_OPS[command.mask.op].format(f"“{name}”")
    if command.mask is not None:
        return f"{'Mask' if command.mask else 'No mask'} of “{name}”"
    if command.clip is not None:
        return f"{'Clip' if command.clip else 'Unclip'} “{name}”"
    if "blend" in changes:
        return f"Blending of “{name}”"
    if "wrap" in changes:
        return f"“{name}” wraps around" if changes["wrap"] is not None else f"“{name}” no longer wraps around"
    if "isolated" in changes:
        return f"“{name}” {'by itself' if changes['isolated'] else 'not by itself'}"
    if "locked" in changes:
        return f"{'Lock' if changes['locked'] else 'Unlock'} “{name}”"
    return f"{'Lock' if changes.get('alpha_locked') else 'Unlock'} the alpha of “{name}”"
