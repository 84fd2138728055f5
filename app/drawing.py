"""The picture in the window: the canvas, and the panels over it; drawn when it is another one than on the screen."""

from __future__ import annotations

from collections.abc import Set
from typing import Any

import imgui_bundle  # before glfw, so that both use one libglfw

import glfw  # isort: skip
from imgui_bundle import imgui

from app.canvas.ant_line import AntLine, AntPlan
from app.canvas.overlay import Overlay
from app.canvas.screen import Screen, ScreenPlan
from app.desk.desk import Desk
from app.desk.moving.floating import rim_similarity

assert imgui_bundle


class Drawing:
    """All calls from the thread that owns the window's context.  `drawn`: whether the last frame was drawn."""

    def __init__(self, window: Any, screen: Screen, overlay: Overlay) -> None:
        self._window, self._screen, self._overlay = window, screen, overlay
        self._plan: ScreenPlan | None = None  # of the canvas, as it was last drawn
        self._line = AntLine(screen.ctx)
        self._ants: AntPlan | None = None
        self.drawn = False

    def draw(self, desk: Desk, now: float, fresh: Set[int], exposed: bool) -> bool:
        """Draws what imgui shows over the canvas, if anything is to be seen that is not on the screen, or if that was
        `exposed`; True while something fades.  `fresh`: the textures that show something else now."""
        data = imgui.get_draw_data()
        frame = None if desk.known.wrapping else desk.known.frame
        plan = self._screen.plan(desk.view, frame, now, desk.insets, desk.known.paper, desk.light.shown)
        told = self._overlay.look(data, (desk.view.width, desk.view.height), fresh)
        rim = None if desk.selecting.masking else desk.selecting.ants
        by = rim_similarity(desk)
        ants = self._line.plan(rim, now, by)
        self.drawn = told or plan != self._plan or ants != self._ants or exposed
        if self.drawn:
            self._plan, self._ants = plan, ants
            self._overlay.redraw(data)
            self._screen.draw(plan)
            if ants is not None and rim is not None:
                self._line.draw(ants, rim, desk.view, desk.insets, desk.scale)
            self._overlay.draw(data)
            glfw.swap_buffers(self._window)
        return plan.moving
