"""What opens below the canvas, between the panels: the texture lab, textures matched to examples, the analysis."""

from __future__ import annotations

from typing import NamedTuple, Protocol

from imgui_bundle import imgui

from app import icons, theme
from app.actions import ACTIONS, Action
from app.desk import Desk
from app.panels import widgets as w
from app.panels.analysis import AnalysisPanel
from app.panels.lab import LabPanel
from app.panels.matching import MatchingPanel
from engine.painting.requests import LabStep


class Panel(Protocol):
    def draw(self, desk: Desk) -> None: ...

    def bar(self, desk: Desk) -> None: ...


class Strip(NamedTuple):
    title: str
    icon: str
    hint: str
    height: float  # points


PART, HIGHEST = 0.4, 560.0  # of the window's height; points
STRIPS = {
    "lab": Strip("Texture lab", icons.FLASK, "Paint its grain: coarse in the middle, fine at the rim", 356.0),
    "match": Strip("Match a texture", icons.MATCH, "Noise becomes like an example, band by band", 356.0),
    "analysis": Strip("Analysis", icons.CHART, "What the picture is made of", 320.0),
}


class StripPanel:
    """Draws the one that is open."""

    def __init__(self) -> None:
        self.lab = LabPanel()
        self._panels: dict[str, Panel] = {"lab": self.lab, "analysis": AnalysisPanel(), "match": MatchingPanel()}

    def height(self, desk: Desk) -> float:
        """What it takes of the screen, framebuffer pixels."""
        if not desk.strip:
            return 0.0
        return max(STRIPS[desk.strip].height * desk.scale, min(PART * desk.view.height, HIGHEST * desk.scale))

    def draw(self, desk: Desk) -> None:
        """Into the present window."""
        row = STRIPS[desk.strip]
        imgui.align_text_to_frame_padding()
        imgui.text_colored(theme.vec((0.78,) * 3), f"{row.icon}  {row.title}")
        imgui.same_line(0, 14 * desk.scale)
        imgui.align_text_to_frame_padding()
        imgui.text_disabled(row.hint)
        self._panels[desk.strip].bar(desk)
        imgui.same_line(imgui.get_window_width() - imgui.get_frame_height() - imgui.get_style().window_padding.x)
        closed = w.icon_button("close", icons.CLOSE, f"Close  ({ACTIONS[desk.strip].keys[0]})")
        self._panels[desk.strip].draw(desk)
        if closed:
            desk.strip = ""

    def paints(self, desk: Desk, x: float, y: float) -> bool:
        """Whether a press there is a stroke in the lab."""
        return desk.strip == "lab" and desk.panels and desk.lab.over(x, y)

    def takes(self, desk: Desk, action: Action) -> bool:
        """Undo and redo over the lab's spectrum are the lab's."""
        steps = {ACTIONS["undo"]: -1, ACTIONS["redo"]: 1}
        if action not in steps or not self.paints(desk, desk.pointer.x, desk.pointer.y):
            return False
        desk.post(LabStep(steps[action]))
        return True
