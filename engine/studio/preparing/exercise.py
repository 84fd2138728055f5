"""Everything that a brush does, done once on a painting that nobody sees: so its kernels are compiled and kept.

Nothing here lists kernels: what painting, committing, looking and undoing call is what is compiled.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from engine.archive.imports import open_image
from engine.archive.opening import open_painting
from engine.brush.checks import BrushError
from engine.brush.copies import NO_COPIES, Copy
from engine.brush.settings import Brush
from engine.brush.settings import from_json as brush_from_json
from engine.brush.stamp import Edit, Stamp
from engine.canvas.commit import commit
from engine.canvas.placing.pose import SourcePart
from engine.canvas.store import Pyramid
from engine.makers import definitions, learning, with_structure
from engine.numeric.address import TILE, Rect, TileKey
from engine.painting import commands as c
from engine.painting.value import Painting, Refusal
from engine.studio import requests as q
from engine.studio import warming
from engine.studio.filing import documents
from engine.studio.past.past_records import AskHere
from engine.studio.studio import Studio
from engine.studio.textures.swatches import painted
from engine.texture import table
from engine.texture.planes import Planes

_LEVELS = (0, -1, 1, -3, 2)  # that are looked at: the stroke's first
_WIDEST, _SMALL = 24.0, 2.0  # px: radius of the brush
_PAINTED = Rect(8, 8, 60, 60)
_MIRRORED = (Copy(1.0, 0.0, 0.0, 0.0, True),)
_STEP = 14.0  # px from one point of the pen to the next


def run(told: dict[str, Any]) -> None:
    """Does what a line of JSON tells: {"kind": "commit"} or another of _PLAIN, or a brush with its textures and the
    size of its picture."""
    if told["kind"] in _PLAIN:
        _PLAIN[told["kind"]]()
        return
    brush = brush_from_json(told["brush"])
    textures = definitions.read(told["textures"], "textures")
    width, height = told["size"]
    with suppress(Refusal, BrushError):  # it may name what only the artist's painting has
        if brush.row.grows:
            warming.paint_once()
        else:
            draw_once(brush, textures)
        painted(q.Swatch("", brush, (width, height), told["kind"], textures=textures), Painting())


def draw_once(brush: Brush, textures: Sequence[c.DefineTexture] = ()) -> None:
    """Paints a stroke over paint as the pen draws it, seen at several levels while it grows and after, and taken
    back."""
    studio = Studio(lambda result: None, lambda request: None)
    try:
        for definition in textures:
            studio.do(q.Do(definition))
        tiles = tuple((level, x, y, -1) for level in _LEVELS for x in (-1, 0) for y in (-1, 0))
        own, tipped = replace(brush, radius=min(brush.radius, _WIDEST)), brush.tip is not None
        strokes = [(own, NO_COPIES), *([(own, _MIRRORED)] if tipped else []), (Brush(radius=_WIDEST / 2), NO_COPIES)]
        for one, copies in strokes:  # tips that are mirrored are laid by a kernel of their own
            studio.look(q.Look(tiles))
            studio.do(q.Begin(0, (0, 0), one, copies=copies))
            for k in range(6):
                points = np.zeros((2, 6))
                points[:, 0], points[:, 1], points[:, 2] = (k * _STEP, (k + 0.5) * _STEP), 30.0 + k, 0.8
                studio.do(q.Points(points))
                while studio.easel.viewer.fresh:
                    studio.step()
            studio.do(q.Finish())
            _work(studio)
        studio.do(q.Do(c.Undo()))
        _work(studio)
    finally:
        studio.close()


def _work(studio: Studio) -> None:
    while studio.step():
        pass


def stamped() -> None:
    """Plain paint committed twice, without a brush: other kernels than the way from the pen to the first dab."""
    edit: Edit = _Square()
    commit(commit(Pyramid(), edit), edit)


def filed() -> None:
    """Saves a painting saved, opened and exported, in a folder beside the kernels that goes again."""
    with tempfile.TemporaryDirectory(dir=os.environ["NUMBA_CACHE_DIR"], prefix="files-") as folder:
        ora, png = Path(folder) / "painting.ora", Path(folder) / "picture.png"
        studio = Studio(lambda result: None, lambda request: None)
        try:
            for radius in (_WIDEST, _SMALL):  # of what the small one goes over only that is kept for undo
                studio.do(q.Begin(0, (0, 0), Brush(radius=radius)))
                studio.do(q.Points(np.array([[0.0, 0.0, 1.0, 0.0, 0.0, 0.0], [90.0, 70.0, 1.0, 0.0, 0.0, 0.1]])))
                studio.do(q.Finish())
            studio.do(q.Do(c.Undo()))
            for wrap in (None, SourcePart(0, Rect(0, 0, 64, 64))):
                studio.do(q.Do(c.SetLayer(studio.easel.session.painting.active or "", wrap=wrap)))
                for gap in (0, 2):
                    like = c.Like((10, 10), 0, _PAINTED, gap=gap, of=None)
                    studio.do(q.Do(c.Fill(Brush(), like, open=True)))
            studio.do(q.Do(c.Undo(3)))
            session = studio.easel.session
            documents.save(ora, session.painting, session.recording())  # as no save of the artist's: it bounds nothing
            studio.do(q.Export(png))
            studio.do(AskHere(0, 0, 0))
        finally:
            studio.close()
        open_painting(ora)
        open_image(png)


def draw_written() -> None:
    """Draws a written texture: one kernel is there for all of them."""
    made = table.instance(table.EXPRESSION, {"text": "noise(x, y)"}, 0, 0)
    made.appearance(0, Rect(0, 0, 1, 1))
    made.bandpass(1, Rect(0, 0, 2, 2))


_PLAIN = {
    "commit": stamped,
    "files": filed,
    "structure": with_structure.make_once,
    "learnt": learning.make_once,
    "seen": learning.look_once,
    "written": draw_written,
}  # jobs without a brush


@dataclass(frozen=True, slots=True)
class _Square:
    """An edit of one tile."""

    level: int = 0
    tiles: tuple[TileKey, ...] = (TileKey(0, 0, 0),)
    rect: Rect = _PAINTED
    spares_alpha: bool = False

    def stamp(self, key: TileKey, old: Planes) -> Stamp | None:
        keep, add = np.ones((TILE, TILE), np.float32), np.zeros((4, TILE, TILE), np.float32)
        keep[8:60, 8:60] = 0.5
        add[:, 8:60, 8:60] = 0.5
        return Stamp(keep, add, (), True)
