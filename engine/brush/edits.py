"""What a stroke does where it covers: the edit of its brush's mode, of the form v' = snap(A v) + B."""

from __future__ import annotations

from functools import lru_cache
from importlib import import_module

from engine.brush.checks import BrushError
from engine.brush.covered import Covered, Read, Scene
from engine.brush.ink import Ink
from engine.brush.mask import Coverage, StrokeMask
from engine.brush.modes import MODES
from engine.brush.settings import Brush
from engine.brush.stamp import Edit
from engine.brush.thinning import Thinning


def check(brush: Brush, where: str = "brush") -> None:
    """BrushError, naming the field, if the brush lacks what its mode needs."""
    if MODES[brush.mode].grows and brush.example is None:
        raise BrushError(f"{where}.example", "none", "the name of a texture of the maker example")


def class_of(mode: str) -> type[Covered]:
    """Returns the class of a mode's edits.  BrushError if it makes none."""
    named = MODES[mode].edit
    if not named:
        raise BrushError("brush.mode", f'"{mode}"', "a mode that edits what is there")
    return _loaded(named)


@lru_cache
def _loaded(named: str) -> type[Covered]:
    """Returns the class that "module:class" names; its module is imported when a stroke first needs it."""
    module, _, name = named.partition(":")
    found: type[Covered] = getattr(import_module(module), name)
    return found


def edit(
    brush: Brush,
    mask: StrokeMask | Coverage,
    ink: Ink | None,
    alpha_locked: bool = False,
    read: Read | None = None,
    relief: Thinning | None = None,
    scene: Scene | None = None,
) -> Edit:
    """Returns the edit that a stroke makes: `mask` as it is now, whatever is painted later.

    `ink` is what the mode's class made of the brush (`Covered.ink_of`), `scene` what it asked to see
    (`Covered.looks`); `read` gives the old values of any rectangle of the stroke's level; `relief` (`relief.resolve`)
    thins the coverage, and a selection may after it.  BrushError if the brush's mode makes no edits.
    """
    coverage = mask.coverage() if isinstance(mask, StrokeMask) else mask
    if relief is not None:
        coverage = relief.over(coverage)
    return class_of(brush.mode)(coverage, brush, ink, alpha_locked, read, scene or Scene())
