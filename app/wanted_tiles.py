"""The tiles of the canvas on the screen: what it lacks is asked for, what comes is laid there."""

from __future__ import annotations

from typing import Any

from app.canvas.screen import Screen, ScreenTile, cells, near_first
from app.desk.desk import Desk, Hear
from app.desk.remembering.kept_views import show_as_before
from app.trace import TRACED, trace
from engine.studio import results
from engine.studio.requests import Look

COARSER = 3  # levels: a coarse layer of tiles around the view is kept for when it moves


class Tiles:
    """All calls from the thread that owns the screen's context."""

    def __init__(self, screen: Screen) -> None:
        self._screen = screen
        self._asked: tuple[Any, ...] = ()
        self._serial: int | None = None  # of the painting that is shown
        self.stays = False  # whether the view does, though another painting comes: it is the same, had back
        self._bare = TRACED  # no paint has been shown so far, and somebody wants to know
        self.hears: dict[type, Hear] = {
            results.Patch: self._patch,
            results.Same: self._same,
            results.Scene: self._scene,
        }

    def wants(self, desk: Desk) -> None:
        """Posts which tiles the screen wants, near ones first, when that has changed."""
        view, level = desk.view, desk.view.shown_level
        seen = cells(view, level)
        desk.light.keep_to(desk.known.scene)
        heights = desk.light.light.height if desk.light.on else None
        key = (level, seen[0], seen[-1], self._serial, heights, *desk.middle())
        if key == self._asked:
            return
        self._asked = key
        x, y = (desk.pointer.x, desk.pointer.y) if desk.pointer.over_canvas else desk.middle()
        wanted = near_first(view, seen, x, y)
        wanted += [t for t in cells(view, level - COARSER) if t not in wanted]
        wanted += _ring(seen)
        desk.post(Look(tuple((*t, self._screen.revision(t)) for t in wanted), heights))

    def _patch(self, desk: Desk, patch: results.Patch, now: float) -> None:
        self._screen.upload(patch, desk.view, now)
        if self._bare and patch.pixels.any():
            self._bare = False
            trace("first paint")

    def _same(self, _desk: Desk, same: results.Same, _now: float) -> None:
        for tile in same.tiles:
            self._screen.confirm(ScreenTile(*tile), same.revision)

    def _scene(self, desk: Desk, scene: results.Scene, _now: float) -> None:
        """Another painting is shown whole, on an empty screen."""
        if scene.serial == self._serial:
            return
        self._screen.forget()
        if self._serial is not None:
            desk.start.leave()
        if (self._serial is not None or scene.path is not None) and not self.stays:
            show_as_before(desk, scene.path)
        self.stays = self.stays and scene.serial == 0
        self._serial = scene.serial
        trace(f"painting {scene.serial} shown")


def _ring(seen: list[ScreenTile]) -> list[ScreenTile]:
    """Returns the tiles just outside the visible ones."""
    level = seen[0].level
    x0, y0, x1, y1 = seen[0].x - 1, seen[0].y - 1, seen[-1].x + 1, seen[-1].y + 1
    edge = [(x, y) for x in range(x0, x1 + 1) for y in (y0, y1)] + [(x, y) for y in range(y0 + 1, y1) for x in (x0, x1)]
    return [ScreenTile(level, x, y) for x, y in edge]
