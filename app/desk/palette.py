"""Taking a brush from the palette: the textures that it needs come along into the painting."""

from __future__ import annotations

from dataclasses import replace

from app.desk.desk import Desk
from app.desk.lab_state import lightened
from app.desk.presets import Preset
from engine.brush.settings import Brush
from engine.makers.definitions import fitted, portable, refers, renamed, used
from engine.painting.commands import DefineTexture
from engine.studio.requests import Do


def take(desk: Desk, preset: Preset) -> None:
    """Paints with a preset from now on; the painting gets those of its textures that it lacks with the first stroke: a
    brush that is only looked at leaves nothing behind."""
    brush, needs = _on_paper(desk, preset) if desk.hand.paper_stays else (preset.brush, preset.textures)
    desk.hand.take(brush, preset.name, needs)
    _fit(desk)


def _on_paper(desk: Desk, preset: Preset) -> tuple[Brush, tuple[DefineTexture, ...]]:
    """Returns the preset's brush on the paper of the present one, and what it needs."""
    brush, grain = preset.brush, desk.hand.brush.grain
    along = used(Brush(grain=grain), desk.hand.needs)
    others = {command.name: command for command in preset.textures}
    if grain is None or any(others.get(command.name, command) != command for command in along):
        return brush, preset.textures
    laid = replace(brush, grain=grain)
    laid = laid if brush.grain is not None else lightened(laid, desk.pointer.pen)
    return laid, (*preset.textures, *(command for command in along if command.name not in others))


def lacking(desk: Desk) -> tuple[DefineTexture, ...]:
    """Textures that the brush came with and the painting does not have yet."""
    defined = () if desk.known.scene is None else desk.known.scene.textures
    return tuple(command for command in desk.hand.needs if command.name not in defined)


def belonging(desk: Desk) -> tuple[tuple[DefineTexture, ...], tuple[str, ...]]:
    """Returns the definitions of the textures that the brush refers to, and the names of those that only this
    painting has."""
    found = {command.name: command for command in desk.hand.needs}
    defined = () if desk.known.scene is None else desk.known.scene.definitions
    told = {name: portable(name, kind, given) for name, kind, given in defined}
    found |= {name: command for name, command in told.items() if command is not None}
    stay = (name for name, command in told.items() if command is None and name not in found)
    return used(desk.hand.brush, found.values()), tuple(name for name in stay if refers(desk.hand.brush, name))


def provide(desk: Desk) -> None:
    """Defines the textures that the brush came with and the painting lacks, which may be another by now."""
    for command in _fit(desk):
        posted = (0 if desk.known.scene is None else desk.known.scene.serial, command)
        if posted not in desk.hand.provided:  # the painting is told of what was posted with its next scene
            desk.hand.provided.add(posted)
            desk.post(Do(command))


def _fit(desk: Desk) -> tuple[DefineTexture, ...]:
    """Returns what the painting lacks.  Where it has another texture of that name, the brush takes a free one."""
    needs = used(desk.hand.brush, desk.hand.needs)
    if not needs:
        return ()
    scene = desk.known.scene
    known = {} if scene is None else {name: (kind, given) for name, kind, given in scene.definitions}
    taken = {row.name for row in desk.known.tables.kinds}
    brush, fitting, missing = fitted(desk.hand.brush, needs, known, taken)
    names = {old.name: new.name for old, new in zip(needs, fitting, strict=True)}
    desk.hand.original = renamed(desk.hand.original, names)
    desk.hand.take(brush, needs=fitting)
    return missing
