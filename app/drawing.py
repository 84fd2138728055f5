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
from app.canvas.screen_colours import ScreenColours
from app.canvas.sheet_pass import SheetPass, SheetPlan
from app.desk.desk import Desk
from app.desk.moving.floating import rim_similarity
from app.land.land_screen import LandScreen
from engine.files.profiles.screen_table import ScreenTable

assert imgui_bundle


class Drawing:
    """All calls from the thread that owns the window's context.  `drawn`: whether the last frame was drawn; `changed`:
    whether anything but the rim of what is selected was another in it, which never rests; `lacks`: how many tiles were
    not there for it, where the view is that of the frame before."""

    def __init__(self, window: Any, screen: Screen, overlay: Overlay, land: LandScreen) -> None:
        self._window, self._screen, self._overlay, self._land = window, screen, overlay, land
        self._flown = False  # whether the land was seen last
        self._plan: ScreenPlan | None = None  # of the canvas, as it was last drawn
        self._line = AntLine(screen.ctx)
        self._ants: AntPlan | None = None
        self._sheets = SheetPass(screen.ctx)
        self._colours = ScreenColours(screen.ctx)
        self._table: ScreenTable | None = None  # by which the window is shown
        self._carried: SheetPlan | None = None
        self.drawn = self.changed = False
        self.lacks = 0

    def begin(self, desk: Desk, now: float) -> None:
        """Has the card begin with the land, which it fills beside what the panels are laid out in."""
        self._land.begin(desk, now)

    def draw(self, desk: Desk, now: float, fresh: Set[int], exposed: bool) -> bool:
        """Draws what imgui shows over the canvas, if anything is to be seen that is not on the screen, or if that was
        `exposed`; True while something fades.  `fresh`: the textures that show something else now."""
        data = imgui.get_draw_data()
        exposed, self._table = exposed or desk.proofing.shown is not self._table, desk.proofing.shown
        if desk.land.on or self._flown:
            return self._land_drawn(desk, now, fresh, exposed)
        sheets = desk.moving.sheets.plan()
        self._sheets.keep(desk.moving.sheets.held)
        plan = self._seen(desk, now, sheets)
        told = self._overlay.look(data, (desk.view.width, desk.view.height), fresh)
        rim = None if desk.selecting.masking else desk.selecting.ants
        by = rim_similarity(desk)
        ants = self._line.plan(rim, now, by)
        self.lacks = plan.lacks if self._plan is not None and self._plan.view == plan.view else 0
        self.changed = told or plan != self._plan or sheets != self._carried or exposed
        self.drawn = self.changed or ants != self._ants
        if self.drawn:
            self._plan, self._carried, self._ants = plan, sheets, ants
            self._overlay.redraw(data)
            self._screen.draw(plan)
            if sheets is not None:
                self._sheets.draw(sheets, desk.view, desk.insets)
            if ants is not None and rim is not None:
                self._line.draw(ants, rim, desk.view, desk.insets, desk.scale)
            self._overlay.draw(data)
            self._send(desk)
        return plan.moving

    def _send(self, desk: Desk) -> None:
        """Puts what was drawn on the screen, in its colours."""
        if self._table is not None:
            self._colours.draw(self._table, self._screen.ctx.screen, (desk.view.width, desk.view.height))
        glfw.swap_buffers(self._window)

    def _land_drawn(self, desk: Desk, now: float, fresh: Set[int], exposed: bool) -> bool:
        """Draws the land in place of the canvas; once more the canvas, when it is closed."""
        data = imgui.get_draw_data()
        told = self._overlay.look(data, (desk.view.width, desk.view.height), fresh)
        if not desk.land.on:
            self._flown = False
            self._land.forget()
            return self.draw(desk, now, fresh, True)
        if told:
            self._overlay.redraw(data)
        changed = self._land.draw(desk, now)
        self.drawn = self.changed = changed or told or exposed or not self._flown
        self._flown, self.lacks = True, 0
        if self.drawn:
            self._land.show(desk)
            self._overlay.draw(data)
            self._send(desk)
        return self._land.moving

    def _seen(self, desk: Desk, now: float, sheets: SheetPlan | None) -> ScreenPlan:
        """Returns what to draw of the tiles: nothing under the sheets of what is dragged."""
        frame = None if desk.known.wrapping else desk.known.frame
        if sheets is not None:
            hidden = self._sheets.hides(sheets, desk.view)
            return self._screen.bare(desk.view, frame, desk.insets, desk.known.paper, hidden)
        return self._screen.plan(desk.view, frame, now, desk.insets, desk.known.paper, desk.light.shown)
