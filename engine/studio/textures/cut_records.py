"""What lies on the ground of an example's picture is asked for, and told as far as it is found.

Light on purpose, as `requests`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from engine.texture.mattes.marks import Mark


@dataclass(frozen=True, slots=True, eq=False)
class FindCut:
    """Finds it in a picture, uint8 RGBA (h, w, 4), read-only, alpha not premultiplied, as marks have it; shows it as
    the picture "cut IDENT": under a veil, or, `bare`, without the ground.  The newest counts; with an empty picture
    none does."""

    ident: str
    pixels: np.ndarray
    marks: tuple[Mark, ...] = ()
    bare: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class CutFound:
    """How far the rim is found, `done` 0..1, of how many things, after so many marks; `whole`: there is no ground.
    `pixels`: what is cut out, as the picture was, read-only; None until it is done."""

    ident: str
    marks: int
    done: float
    whole: bool
    things: int = 0
    pixels: np.ndarray | None = None
