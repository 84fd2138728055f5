"""What lies on the ground of an example's picture: found by itself, corrected by strokes, taken.

Strokes come from `tools.mark_region`.
"""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.actions.action import Action
from app.actions.actions import ACTIONS
from app.desk.desk import Desk
from app.desk.examples import cutting_work
from app.desk.examples.finding_state import FindingState
from app.language import said
from app.panels.controls import widgets as w
from app.panels.controls.widgets import Col
from app.panels.examples.region_picture import draw_picture

_SIDE = 232.0  # width of the tools, points
_GROWN = 1.15  # of the brush, by a key
_FEW = 2  # things that are taken without being asked about
_WAYS = (
    ("keep", "Keep", "A stroke over what belongs to it"),
    ("drop", "Drop", "A stroke over what is ground"),
)


class FindingPanel:
    """Draws the strip's inside."""

    def __init__(self) -> None:
        self._asked = 0  # of how many things it asks whether each is to become an example

    def draw(self, desk: Desk, finding: FindingState) -> None:
        """Draws it into the present window."""
        room, gap = imgui.get_content_region_avail(), imgui.get_style().item_spacing.x
        imgui.begin_child("found picture", ImVec2(room.x - _SIDE * desk.scale - gap, 0))
        draw_picture(desk, (f"cut {finding.ident}", f"region {finding.ident}"), finding.size, finding.radius)
        imgui.end_child()
        imgui.same_line()
        imgui.begin_child("finding tools", ImVec2(0, 0))
        imgui.begin_child("finding ways", ImVec2(0, -imgui.get_frame_height_with_spacing()))
        said.text_disabled(_told(finding))
        self._tools(desk, finding)
        imgui.end_child()
        self._ends(desk, finding)
        imgui.end_child()

    def takes(self, desk: Desk, action: Action) -> bool:
        """Takes marks back, or lays them again, or makes the brush larger or smaller; False for other actions."""
        finding = cutting_work.finding_of(desk)
        if finding is None:
            return False
        if action in (ACTIONS["undo"], ACTIONS["redo"]):
            finding.step_back(desk.post, action is ACTIONS["undo"])
        elif action in (ACTIONS["smaller"], ACTIONS["larger"]):
            finding.scale_radius(_GROWN if action is ACTIONS["larger"] else 1 / _GROWN)
        else:
            return False
        return True

    def _tools(self, desk: Desk, finding: FindingState) -> None:
        finding.way = w.segments("marking", finding.way, _WAYS) or finding.way
        hint = "Radius of the stroke, in pixels of the picture  ([ and ])"
        changed, radius = w.slider("Size", finding.radius, (1.0, 128.0), hint, form="%.1f px", curved=True)
        if changed:
            finding.radius = round(radius, 1)
        changed, bare = w.tick("Without the ground", finding.bare, "Shows it cut out, as it will be")
        if changed:
            finding.see(desk.post, bare)
        gap, side = 2 * desk.scale, imgui.get_frame_height()
        hint = "Take the last stroke back  (Ctrl+Z over the picture)"
        if w.icon_button("undo", icons.UNDO, hint, enabled=bool(finding.marks), size=side):
            finding.step_back(desk.post, True)
        imgui.same_line(0, gap)
        hint = "Lay it again  (Ctrl+Shift+Z over the picture)"
        if w.icon_button("redo", icons.REDO, hint, enabled=bool(finding.undone), size=side):
            finding.step_back(desk.post, False)

    def _ends(self, desk: Desk, finding: FindingState) -> None:
        """Takes what is found, or leaves it."""
        wide = (imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x) / 2
        found = finding.found
        things = found.things if found is not None else 0
        if things > _FEW and things == self._asked:
            self._sure(desk, things, wide)
            return
        self._asked = 0
        text = f"Take {things}" if things > 1 else "Take"
        hint = "Each becomes an example of its own" if things > 1 else "Cut it out: it is the example from now on"
        if _accented(f"{text}###take", hint, found is not None, wide):
            if things > _FEW:
                self._asked = things
            else:
                cutting_work.take_cut(desk)
        imgui.same_line()
        if w.text_button("By hand", "Keep the whole picture and paint its region by hand", width=wide):
            cutting_work.leave(desk)

    def _sure(self, desk: Desk, things: int, wide: float) -> None:
        """Asks whether so many are to come into the palette: the answer lies beside what was pressed, so that a
        double click is none."""
        if w.text_button("Not so many", "Take none yet: mark what to drop, or paint the region by hand", width=wide):
            self._asked = 0
        imgui.same_line()
        if _accented(f"Add {things}###take all", "Each becomes an example of its own", True, wide):
            self._asked = 0
            cutting_work.take_cut(desk)


def _accented(label: str, hint: str, enabled: bool, wide: float) -> bool:
    """Draws the button that goes on."""
    imgui.push_style_color(Col.button, theme.vec(theme.look.accent_soft))
    pressed = w.text_button(label, hint, enabled=enabled, width=wide)
    imgui.pop_style_color()
    return pressed


def _told(finding: FindingState) -> str:
    """Says how far it is."""
    found = finding.found
    if found is None:
        return "Finding it…"
    if finding.taking:
        return f"Taking it: its rim, {found.done:.0%}"
    if found.whole:
        return "No ground found: mark what to drop"
    if found.done < 1.0:
        return f"Its rim: {found.done:.0%}"
    return "Found" if found.things == 1 else f"Found {found.things} things"
