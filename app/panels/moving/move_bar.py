"""The numbers of what the tool Move holds, in a bar above the canvas: place, scale and angle, to be read and typed."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from imgui_bundle import imgui

from app import icons, theme
from app.actions import actions
from app.desk.desk import Desk
from app.desk.moving import floating, held_box
from app.desk.moving.box import spot
from app.desk.moving.laid_level import LaidLevel
from app.desk.moving.poses import Spin, exact, respun, scale_text, shifted, spin_of, turn_text
from app.desk.moving.setting_down import set_down
from app.language import said
from app.panels.controls import widgets as w
from app.panels.controls.number_field import NumberFields, typed_number
from app.panels.options.options_bar import Options
from engine.canvas.placing.pose import Pose, SourcePart
from engine.studio.results import LayerRow

_BAR_WIDTH = 33.0  # of the bar, ems
_OF_PART = 41.0  # the same where what is selected of a layer is moved: what it becomes is told, too
_MOST = 10**9  # percent
Typed = Callable[[Pose, SourcePart, int, Fraction], Pose]  # what a number makes of a pose, seen at a level


def _to_x(pose: Pose, part: SourcePart, level: int, value: Fraction) -> Pose:
    return shifted(pose, level, int(value) - _corner(pose, part, level)[0], 0)


def _to_y(pose: Pose, part: SourcePart, level: int, value: Fraction) -> Pose:
    return shifted(pose, level, 0, int(value) - _corner(pose, part, level)[1])


def _to_scale(pose: Pose, part: SourcePart, level: int, value: Fraction) -> Pose:
    spin = Spin(0, 1.0, spin_of(pose).degrees).scaled(float(value / 100))
    return respun(pose, spin, spot(part, pose, 0, 0), level)


def _to_angle(pose: Pose, part: SourcePart, level: int, value: Fraction) -> Pose:
    return respun(pose, spin_of(pose).turned(float(value % 360)), spot(part, pose, 0, 0), level)


# By the name of a field: its sign, its width in ems, what a number does, and the hint.
_FIELDS: dict[str, tuple[str, float, Typed, str]] = {
    "x": ("x", 5.5, _to_x, "The left end of it, in pixels of the level that you see.  Return moves it there"),
    "y": ("y", 5.5, _to_y, "The upper end of it, in pixels of the level that you see.  Return moves it there"),
    "scale": ("%", 4.5, _to_scale, "How large it is, in percent of its source: powers of two are exact"),
    "angle": ("°", 4.5, _to_angle, "How far it is turned, in degrees clockwise: quarter turns are exact"),
}


def _corner(pose: Pose, part: SourcePart, level: int) -> tuple[int, int]:
    """Returns the pixel of a level at the upper left of what is seen."""
    rect = pose.similarity.shown(part.rect, part.level, level)
    return rect.x0, rect.y0


class MoveBar:
    """Remembers which number is being typed."""

    def __init__(self) -> None:
        self._fields = NumberFields()

    def options(self, desk: Desk) -> Options | None:
        """Returns what is to be seen; None for nothing."""
        row = desk.known.active
        if not desk.panels or row is None or held_box.seen_box(desk) is None:
            return None
        return Options(_OF_PART if floating.takes_part(desk, row) else _BAR_WIDTH, self.draw)

    def draw(self, desk: Desk) -> None:
        """Fills the present window, one line high."""
        row = desk.known.active
        part = None if row is None else held_box.part(desk, row)
        if row is None or part is None:
            return
        pose, level = desk.moving.pose(desk.known, row), desk.view.shown_level
        spin, (x, y) = spin_of(pose), _corner(pose, part, level)
        values = {"x": str(x), "y": str(y), "scale": scale_text(spin), "angle": turn_text(spin)}
        imgui.begin_disabled(row.locked or desk.moving.label is not None)
        for name, (sign, width, typed, hint) in _FIELDS.items():
            text = self._fields.draw(name, sign if sign in "xy" else "", values[name], width, hint)
            if text is not None:
                _apply(desk, row, (text, typed), (pose, part, level))
            imgui.same_line(0, 0.7 * imgui.get_font_size())
        imgui.end_disabled()
        for name, icon in (("mirror_layer", icons.MIRROR_ACROSS), ("mirror_layer_down", icons.MIRROR_DOWN)):
            action = actions.ACTIONS[name]
            if w.icon_button(name, icon, actions.tip(name), enabled=action.when(desk)):
                actions.perform(desk, action)
            imgui.same_line()
        laid = floating.laying(desk)
        if laid is None:
            _told(exact(pose, level))
            return
        above = actions.ACTIONS["set_above"]
        if w.icon_button("set_above", icons.LAYERS, actions.tip("set_above"), enabled=above.when(desk)):
            actions.perform(desk, above)
        imgui.same_line()
        _told_laid(laid)


def _apply(desk: Desk, row: LayerRow, typed: tuple[str, Typed], where: tuple[Pose, SourcePart, int]) -> None:
    """Does what a number that was typed says, as one step."""
    text, does = typed
    value = typed_number(text)
    if value is None or (does is _to_scale and not 1 / _MOST <= value <= _MOST):
        desk.say(f"“{text}” is no {'scale' if does is _to_scale else 'number'} that can be used here", bad=True)
        return
    pose = does(*where, value)
    if pose.wrong() is not None:
        desk.say("That is too far away", bad=True)
    elif pose != where[0]:
        set_down(desk, row, pose)


def _told(very: bool) -> None:
    """Tells whether the very pixels are shown."""
    imgui.align_text_to_frame_padding()
    said.text_colored(theme.vec(theme.look.accent if very else theme.look.quiet), "Exact" if very else "Sampled")
    w.named("exact" if very else "sampled")
    w.tooltip(
        "It shows the very pixels that were painted"
        if very
        else "Turned, scaled or moved by parts: it is sampled from what was painted, of which nothing is lost"
    )


def _told_laid(laid: LaidLevel) -> None:
    """Tells of which level it becomes pixels in its layer."""
    imgui.align_text_to_frame_padding()
    text = f"Pixels of level {laid.level}"
    said.text_colored(theme.vec(theme.look.warn if laid.loses else theme.look.quiet), text)
    w.named(text)
    w.tooltip(
        "Set down, it becomes paint of its layer: pixels of this level"
        + (", and what is finer in it is lost" if laid.loses else "; its ink does, too")
        + ". Set down above, nothing changes"
    )
