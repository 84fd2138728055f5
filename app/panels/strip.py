"""What opens below the canvas, between the panels: the texture lab, textures matched to examples, the analysis."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, Protocol

from imgui_bundle import imgui

from app import icons, theme
from app.actions import ACTIONS, Action
from app.desk.desk import Desk
from app.input.events import PenEvent
from app.panels.controls import widgets as w
from app.panels.examples.examples_panel import ExamplesPanel
from app.panels.lab.analysis_panel import AnalysisPanel
from app.panels.lab.lab_panel import LabPanel
from app.panels.match.match_panel import MatchingPanel
from app.tools import Gesture, paint_lab, paint_region
from engine.studio.requests import LabStep

Painting = Callable[[Desk, PenEvent], Gesture]


class Panel(Protocol):
    def draw(self, desk: Desk) -> None: ...

    def bar(self, desk: Desk) -> None: ...


class Strip(NamedTuple):
    title: str
    icon: str
    hint: str
    height: float  # points


GROW = 1.15  # of a brush, by a key
PART, HIGHEST = 0.4, 640.0  # of the window's height; points
STRIPS = {
    "lab": Strip("Texture lab", icons.FLASK, "Paint its grain: coarse in the middle, fine at the rim", 356.0),
    "match": Strip("Match a texture", icons.MATCH, "Noise becomes like an example, band by band", 356.0),
    "examples": Strip("Examples", icons.EXAMPLES, "Textures that grow where you paint, rim and all", 356.0),
    "analysis": Strip("Analysis", icons.CHART, "What the picture is made of", 320.0),
}


class StripPanel:
    """Draws the one that is open."""

    def __init__(self) -> None:
        self.lab = LabPanel()
        self._panels: dict[str, Panel] = {"lab": self.lab, "analysis": AnalysisPanel(), "match": MatchingPanel()}
        self._panels["examples"] = ExamplesPanel()

    def height(self, desk: Desk) -> float:
        """What it takes of the screen, framebuffer pixels: the same whatever it shows, or the canvas would jump."""
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
        imgui.text_disabled(self.lab.hint(desk) if desk.strip == "lab" else row.hint)
        self._panels[desk.strip].bar(desk)
        imgui.same_line(imgui.get_window_width() - imgui.get_frame_height() - imgui.get_style().window_padding.x)
        closed = w.icon_button("close", icons.CLOSE, f"Close  ({ACTIONS[desk.strip].keys[0]})")
        self._panels[desk.strip].draw(desk)
        if closed:
            desk.strip = ""

    def stroke(self, desk: Desk, x: float, y: float) -> Painting | None:
        """The stroke that a press there begins: in the lab's spectrum, or in an example's region."""
        if not desk.panels:
            return None
        if desk.strip == "lab" and desk.lab.over(x, y):
            return paint_lab
        return paint_region if desk.strip == "examples" and desk.examples.over(x, y) else None

    def takes(self, desk: Desk, action: Action) -> bool:
        """Undo and redo over what is painted in a panel are the panel's; so is the size of its brush."""
        steps = {ACTIONS["undo"]: -1, ACTIONS["redo"]: 1}
        sizes = {ACTIONS["smaller"]: 1 / GROW, ACTIONS["larger"]: GROW}
        painted = self.stroke(desk, desk.pointer.x, desk.pointer.y)
        if painted is paint_lab and action in steps:
            desk.post(LabStep(steps[action]))
            return True
        mask = desk.examples.mask
        if painted is not paint_region or mask is None or action not in {**steps, **sizes}:
            return False
        if action in steps:
            mask.step(steps[action])
        else:
            mask.resize(sizes[action])
        return True
