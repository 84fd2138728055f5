"""What opens below the canvas, between the panels: the texture lab, textures matched to examples, places, the analysis.

A panel of this kind is a row in STRIPS, and one in ACTIONS in app.actions under the same name, which opens it.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from imgui_bundle import imgui

from app import icons, theme
from app.actions.action import Action
from app.actions.actions import keyed
from app.desk.desk import Desk, Hear
from app.language import said
from app.panels.arranging.docks import dock_unit
from app.panels.controls import widgets as w
from app.panels.examples.examples_panel import ExamplesPanel
from app.panels.lab.analysis_panel import AnalysisPanel
from app.panels.lab.lab_panel import LabPanel
from app.panels.match.match_panel import MatchingPanel
from app.panels.panel import Painting, Panel
from app.panels.past.history_panel import HistoryPanel
from app.panels.places.places_panel import PlacesPanel
from app.panels.solids.solid_panel import SolidPanel
from app.panels.workshop.workshop_panel import WorkshopPanel

PART, HIGHEST = 0.4, 640.0  # of the window's height; points


class Strip(NamedTuple):
    """`height`: at least, points."""

    title: str
    icon: str
    hint: str
    panel: Callable[[], Panel]
    height: float = 356.0


STRIPS = {
    "lab": Strip("Texture lab", icons.FLASK, "Paint its grain: coarse in the middle, fine at the rim", LabPanel),
    "match": Strip("Match a texture", icons.MATCH, "Noise becomes like an example, band by band", MatchingPanel),
    "workshop": Strip("Workshop", icons.CODE, "Write a texture: each line is seen as you write", WorkshopPanel, 400.0),
    "solid": Strip("Solid", icons.SOLID, "Stone and wood through and through; a slice of it is ink", SolidPanel),
    "examples": Strip("Examples", icons.EXAMPLES, "Textures that grow where you paint, rim and all", ExamplesPanel),
    "history": Strip("History", icons.CLOCK, "Every step, with a small picture", HistoryPanel, 290.0),
    "places": Strip("Places", icons.PLACES, "Bookmarks, and where there is paint", PlacesPanel),
    "analysis": Strip("Analysis", icons.CHART, "What the picture is made of", AnalysisPanel, 320.0),
}


class StripPanel:
    """Draws the one that is open, and passes on what is for it."""

    def __init__(self) -> None:
        self._panels = {name: row.panel() for name, row in STRIPS.items()}
        self._opened = ""

    def hearers(self, kind: type) -> list[Hear]:
        """Returns who hears results of a type."""
        return [panel.hears[kind] for panel in self._panels.values() if kind in panel.hears]

    def height(self, desk: Desk) -> float:
        """Returns what it takes of the screen, framebuffer pixels: the same whatever it shows, or the canvas would
        jump."""
        if not desk.strip:
            return 0.0
        least, chosen = STRIPS[desk.strip].height * desk.scale, desk.arranged.now.strip * dock_unit(desk)
        return max(least, chosen or min(PART * desk.view.height, HIGHEST * desk.scale))

    def draw(self, desk: Desk) -> None:
        """Into the present window."""
        row, panel = STRIPS[desk.strip], self._panels[desk.strip]
        imgui.align_text_to_frame_padding()
        said.text_colored(theme.vec(theme.look.soft), f"{row.icon}  {row.title}")
        imgui.same_line(0, 14 * desk.scale)
        imgui.align_text_to_frame_padding()
        said.text_disabled(panel.hint(desk) or row.hint)
        panel.bar(desk)
        imgui.same_line(imgui.get_window_width() - imgui.get_frame_height() - imgui.get_style().window_padding.x)
        closed = w.icon_button("close", icons.CLOSE, keyed("Close", desk.strip))
        panel.draw(desk)
        if closed:
            desk.strip = ""

    def wants(self, desk: Desk, now: float) -> None:
        """Posts what the open one lacks, and what follows from closing another."""
        before, self._opened = self._opened, desk.strip
        if before and before != self._opened:
            self._panels[before].closed(desk)
        panel = self._open(desk)
        if panel is not None:
            panel.wants(desk, now)

    def stroke(self, desk: Desk, x: float, y: float) -> Painting | None:
        """Returns the stroke that a press there begins: in the lab's spectrum, say, or in an example's region."""
        panel = self._open(desk)
        return None if panel is None else panel.stroke(desk, x, y)

    def takes(self, desk: Desk, action: Action) -> bool:
        """Undo and redo over what is painted in a panel are the panel's; so is the size of its brush."""
        panel = self._open(desk)
        return panel is not None and panel.takes(desk, action)

    def dropped(self, desk: Desk, path: Path, x: float, y: float) -> bool:
        """Gives a file that was dropped to the open one; False if that does not take it."""
        panel = self._open(desk)
        return panel is not None and panel.dropped(desk, path, x, y)

    def _open(self, desk: Desk) -> Panel | None:
        return self._panels[desk.strip] if desk.strip and desk.panels else None
