"""What the worker sends goes onto the desk and the screen; what the screen lacks is asked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import moderngl
import numpy as np

from app.canvas.gallery import Gallery
from app.canvas.screen import Screen, ScreenTile, cells, near_first
from app.canvas.view import SUBPIXEL, Place
from app.desk import example_use, palette
from app.desk.desk import Desk
from app.desk.example_state import SAMPLE
from app.desk.files import Files
from app.desk.known import Known, told
from app.desk.lab_state import only_with
from app.desk.region_mask import shown
from app.desk.thumbnails import Shelf
from app.panels.brush.brush_list import ask_picture, ready_at_start
from app.panels.brush.brush_panel import PREVIEW
from app.panels.colour.ink_mixer import DEEPER, SWATCH_HEIGHT
from app.panels.examples.examples_panel import LARGE
from app.trace import trace
from engine.brush.settings import Brush
from engine.studio import requests as q
from engine.studio import results
from engine.studio.worker import Worker

COARSER = 3  # levels: a coarse layer of tiles around the view is kept for when it moves
SETTLE = 0.12  # seconds from one painting of the brush's swatches to the next


class News:
    """The window's side of the post."""

    def __init__(self, desk: Desk, screen: Screen, ctx: moderngl.Context) -> None:
        self.desk, self.screen, self.ctx = desk, screen, ctx
        self.worker: Worker | None = None
        desk.behind = lambda: self.worker is not None and self.worker.behind
        self._asked: tuple[Any, ...] = ()
        self.files: Files | None = None
        self._begun = False
        self.shelf: Shelf | None = None
        self.gallery = Gallery(ctx, desk.pictures)
        self._ink: Any = None
        self._ink_since = self._ink_sent = 0.0
        self._serial: int | None = None
        self._laid_out, self._now = False, 0.0
        self._handlers: dict[type, Callable[[Any, Known], None]] = {
            results.Patch: self._patch,
            results.Same: self._same,
            results.Scene: self._scene,
            results.Note: lambda r, before: self.desk.told(r),
            results.Saved: self._saved,
            results.Picture: self._picture,
            results.Picked: self._picked,
            results.Looked: self._looked,
            results.LabScene: self._lab,
            results.MatchScene: self._matched,
            results.Growing: self._growing,
            results.GotReady: self._got_ready,
        }

    def take(self, now: float) -> bool:
        """Takes in all results; True if there were any."""
        came = self.worker.results() if self.worker else []
        came += self.shelf.take() if self.shelf else []
        for result in came:
            before, self._now = self.desk.known, now
            self.desk.known = told(before, result, now)
            handler = self._handlers.get(type(result))
            if handler is not None:
                handler(result, before)
        done = self.files.take() if self.files else []
        for one in done:
            one.arrive(self.desk)
        self._begin()
        return bool(came or done)

    def first_layout(self) -> bool:
        """True once: after the first frame's panels are laid out, the free area is known."""
        first, self._laid_out = not self._laid_out, True
        return first

    def ask(self, now: float) -> None:
        """Posts which tiles the screen wants, when that has changed, and new swatches."""
        if not self.desk.known.ready or self.worker is None:
            return
        view, level = self.desk.view, self.desk.view.shown_level
        seen = cells(view, level)
        key = (level, seen[0], seen[-1], self._serial, *self.desk.middle())
        if key != self._asked:
            self._asked = key
            at = self.desk.pointer if self.desk.pointer.over_canvas else None
            x, y = (at.x, at.y) if at else self.desk.middle()
            wanted = near_first(view, seen, x, y)
            wanted += [t for t in cells(view, level - COARSER) if t not in wanted]
            wanted += _ring(seen)
            self.worker.post(q.Look(tuple((*t, self.screen.revision(t)) for t in wanted)))
        example_use.prepare(self.desk, now)
        self._ask_swatches(now)
        self._ask_lab(now)
        if self.desk.strip == "match" and self.desk.panels:
            self.desk.match.ask(self.desk.post)
        self._ask_examples(now)

    def _ask_swatches(self, now: float) -> None:
        """The stroke of the brush and the ink mixer's picture follow the brush, no faster than they can be seen."""
        brush = self.desk.examples.at_home(self.desk.hand.dipped())
        if brush != self._ink:
            self._ink, self._ink_since = brush, self._ink_since or max(now, self._ink_sent + SETTLE)
        early = brush.row.grows and self.desk.known.preparing is not None
        if self._ink_since and now >= self._ink_since and self.worker and not early:
            self._ink_since, self._ink_sent = 0.0, now
            scale = self.desk.scale
            lacking = palette.lacking(self.desk)
            size = (int(PREVIEW[0] * scale), int(PREVIEW[1] * scale))
            self.worker.post(q.Swatch("brush", brush, size, textures=lacking, soon=True))
            size = (int(135 * scale), int(SWATCH_HEIGHT * scale))
            plain = Brush(16.0, colour=brush.colour, ink=brush.ink, shaping=brush.shaping)
            self.worker.post(q.Swatch("ink", plain, size, "fill", textures=lacking, soon=True))
            self.worker.post(q.Swatch("ink near", plain, size, "fill", DEEPER, lacking, soon=True))

    def _ask_lab(self, now: float) -> None:
        desk = self.desk
        if desk.strip == "lab" and desk.panels:
            known = {row.name for row in desk.known.tables.kinds if not row.pictured} | set(
                desk.known.scene.textures if desk.known.scene else ()
            )
            brush = only_with(replace(desk.hand.dipped(), ink=()), frozenset(known))
            brush = replace(brush, radius=16.0, opacity=1.0, flow=1.0, mode="paint")
            desk.lab.ask(desk.post, now, brush)

    def _ask_examples(self, now: float) -> None:
        """Thumbnails, the sample stroke, and what was painted in the region, while they are to be seen."""
        desk, state = self.desk, self.desk.examples
        if self.shelf is not None and (desk.hand.brush.row.grows or desk.strip == "examples"):
            self.shelf.ask(state.entries, round(LARGE * desk.scale))
        if desk.strip != "examples" or not desk.panels:
            return
        if desk.known.preparing is None:  # or the engine would wait for it, and strokes for the engine
            state.ask(desk.post, now)
        state.ask_thumbnails(desk.post, round(LARGE * desk.scale))
        mask = state.mask
        if mask is not None and mask.dirty is not None:
            height, width = mask.inside.shape
            self.gallery.touch(f"region {state.chosen}", (width, height), mask.dirty, shown(mask, mask.dirty))
            mask.dirty = None

    def waiting(self) -> bool:
        """Whether a swatch is about to be asked for."""
        return self._ink_since > 0

    def _begin(self) -> None:
        """Brushes lie ready, once the engine is loaded and their files are read."""
        desk = self.desk
        if self._begun or not desk.known.ready or not desk.known.presets:
            return
        self._begun = True
        trace("engine ready")
        if not desk.hand.preset:
            first = next((p for p in desk.known.presets if p.brush.row.lays_ink), desk.known.presets[0])
            desk.hand.take(first.brush, first.name, first.textures)
        for preset in filter(ready_at_start, desk.known.presets):
            ask_picture(desk, preset)

    def _patch(self, r: results.Patch, _before: Known) -> None:
        self.screen.upload(r, self.desk.view, self._now)

    def _same(self, r: results.Same, _before: Known) -> None:
        for tile in r.tiles:
            self.screen.confirm(ScreenTile(*tile), r.revision)

    def _scene(self, scene: results.Scene, before: Known) -> None:
        if before.scene is None or before.scene.definitions != scene.definitions:
            example_use.gather(self.desk)
        if scene.serial != self._serial:
            self.screen.forget()
            if self._serial is not None or scene.path is not None:
                self.desk.fit()
            self._serial = scene.serial
            trace(f"painting {scene.serial} shown")

    def _saved(self, r: results.Saved, _before: Known) -> None:
        self.desk.say(f"Saved {Path(r.path).name}")
        self.desk.asked.saved()

    def _picture(self, r: results.Picture, _before: Known) -> None:
        """A swatch over paper, as a texture for imgui."""
        if r.ident == SAMPLE:
            self.desk.examples.seen = self.desk.examples.sampling
        self.gallery.hang(r.ident, r.pixels)

    def _lab(self, r: results.LabScene, _before: Known) -> None:
        before, self.desk.lab.scene = self.desk.lab.scene, r
        if before is not None and before.version != r.version:
            self._ink = None  # its pictures are of a texture that is another one now

    def _matched(self, r: results.MatchScene, _before: Known) -> None:
        self.desk.match.scene = r

    def _picked(self, r: results.Picked, _before: Known) -> None:
        if r.alpha > 0.01:
            self.desk.hand.colour = r.rgb

    def _looked(self, r: results.Looked, _before: Known) -> None:
        """A recording that plays shows where its artist looked."""
        x, y = (_middle(o, s, r.level % 1) for o, s in zip(r.origin, r.size, strict=True))
        x0, y0, x1, y1 = self.desk.free_area()
        zoom = r.level
        if r.size[0] > 0 and r.size[1] > 0:
            zoom += float(np.log2(min((x1 - x0) / r.size[0], (y1 - y0) / r.size[1])))
        place = Place(x, y, int(r.level // 1) + SUBPIXEL)
        self.desk.look_at(place, zoom, r.seconds)

    def _got_ready(self, _r: results.GotReady, _before: Known) -> None:
        trace("examples ready")

    def _growing(self, _r: results.Growing, before: Known) -> None:
        grows = self.desk.known.growing is not None
        if grows != (before.growing is not None):
            trace("something grows" if grows else "all has grown")


def _middle(origin: float, size: float, fraction: float) -> int:
    """The middle of a span of pixels of a level and a fraction, in 2^-16 pixels of the whole level; exact for integers
    of any size at a whole level."""
    whole = int(origin // 1)
    rest = round((origin - whole + size / 2) * 2.0 ** (SUBPIXEL - fraction))
    scale = round(2.0 ** (64 - fraction))  # pixels of the finer level are smaller
    return ((whole * scale) >> (64 - SUBPIXEL)) + rest


def _ring(seen: list[ScreenTile]) -> list[ScreenTile]:
    """The tiles just outside the visible ones."""
    level = seen[0].level
    x0, y0, x1, y1 = seen[0].x - 1, seen[0].y - 1, seen[-1].x + 1, seen[-1].y + 1
    edge = [(x, y) for x in range(x0, x1 + 1) for y in (y0, y1)] + [(x, y) for y in range(y0 + 1, y1) for x in (x0, x1)]
    return [ScreenTile(level, x, y) for x, y in edge]
