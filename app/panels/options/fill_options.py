"""The settings of the tools Fill, Gradient and Wand, in the bar above the canvas while one of them is in hand."""

from __future__ import annotations

from collections.abc import Callable

from imgui_bundle import ImVec2, imgui

from app import icons
from app.desk.desk import Desk
from app.desk.filling import gradients
from app.desk.filling.fill_state import WIDEST_SHOWN
from app.desk.filling.gradients import GRADIENT_SHAPES
from app.language import said
from app.panels.controls import widgets as w

_FILLS = (
    ("fill", "Region", "Click a region: the brush fills it  (G)"),
    ("enclose", "Within", "Drag around regions: the brush fills them all  (Alt+G)"),
    ("gradient", "Gradient", "Drag: one colour turns into another  (Shift+G)"),
)
FILL_TOOLS = tuple(row[0] for row in _FILLS)
_LINES = (("lasso", icons.LASSO, "Go round them freely"), ("box", icons.AREA, "Go round them by a rectangle"))
_REGIONS = (("alike", "Alike"), ("empty", "Empty"), ("all", "Everything"), ("line", "The line"))
_WHICH = (
    "Regions of the colour where you begin",
    "Regions where there is no paint",
    "All that does not reach the line: lines within it, too",
    "All that the line goes round, on empty ground, too",
)
_ENDS = (("other", "Other colour", "It ends in the other colour"), ("nothing", "Transparent", "It fades to nothing"))
_MOST_GROWN = 16.0  # px of the screen
_WAYS, _SHAPES, _SLIDER, _NARROW = 12.0, 14.0, 7.0, 5.4  # widths, ems


def draw(desk: Desk) -> None:
    """Fills the present window, one line high."""
    OF_TOOLS[desk.hand.tool](desk)


def ways(desk: Desk) -> None:
    """Draws the kinds of fill, of which one is in hand."""
    tool = w.segments("fills", desk.hand.tool, _FILLS, _WAYS * imgui.get_font_size())
    if tool is not None:
        desk.hand.use(tool)
    spaced()


def spaced() -> None:
    """Goes on in the same line, for something else."""
    imgui.same_line(0, 0.4 * imgui.get_font_size())


def slid(label: str, value: float, most: float, form: str, hint: str, width: float = _SLIDER) -> float:
    """Draws a slider from 0 on, as wide as those of this bar, or so many ems; returns its value."""
    imgui.push_style_var(imgui.StyleVar_.window_padding, ImVec2(0, 0))
    imgui.begin_child(f"{label} cell", ImVec2(width * imgui.get_font_size(), imgui.get_frame_height()))
    imgui.pop_style_var()
    _, value = w.slider(label, value, (0.0, most), hint, form=form)
    imgui.end_child()
    return value


def _region(desk: Desk) -> None:
    ways(desk)
    likeness(desk)
    spaced()
    _growing(desk)
    spaced()
    desk.filling.contiguous = w.tick("One region", desk.filling.contiguous, _ONE)[1]


def _within(desk: Desk) -> None:
    ways(desk)
    state, em = desk.filling, imgui.get_font_size()
    line = w.segments("line", "box" if state.boxed else "lasso", _LINES, 3.6 * em)
    if line is not None:
        state.boxed = line == "box"
    spaced()
    hint = "Which regions within are filled"
    state.regions = w.choice("which", state.regions, _REGIONS, hint, 5.6 * em, _WHICH) or state.regions
    spaced()
    if state.regions == "line":
        said.text_disabled(_WHICH[-1])
        return
    likeness(desk)
    spaced()
    _growing(desk)


def _growing(desk: Desk) -> None:
    """Draws by how much a fill goes beyond its region's rim."""
    state, hint = desk.filling, "Under soft lines, by so much: no pale ring is left at their edges"
    state.fill_grown = round(slid("Grow", state.fill_grown, _MOST_GROWN, "%.0f px", hint, _NARROW))


def _wand(desk: Desk) -> None:
    likeness(desk)
    spaced()
    state, hint = desk.filling, "Under soft lines, by so much: no seam is left when what is selected is filled"
    state.grown = round(slid("Grow", state.grown, _MOST_GROWN, "%.0f px", hint))
    spaced()
    desk.filling.contiguous = w.tick("One region", desk.filling.contiguous, _ONE)[1]


_ONE = "Off: everything in sight that is of that colour"


def likeness(desk: Desk) -> None:
    """Draws what counts as alike, and where that is looked for."""
    state = desk.filling
    hint = "How far colours may differ from the one you click"
    state.tolerance = round(slid("Tolerance", state.tolerance * 100, 100.0, "%.0f%%", hint) / 100, 4)
    spaced()
    hint = "Gaps in lines up to this width count as closed"
    state.gap = round(slid("Gaps", state.gap, WIDEST_SHOWN, "%.0f px", hint))
    spaced()
    state.seen = w.tick("All layers", state.seen, "Look at all that is seen, not at the layer alone")[1]


def _gradient(desk: Desk) -> None:
    ways(desk)
    state, em = desk.filling, imgui.get_font_size()
    state.shape = w.segments("shape", state.shape, GRADIENT_SHAPES, _SHAPES * em) or state.shape
    spaced()
    end = w.segments("end", "nothing" if state.fades else "other", _ENDS, _SHAPES * em)
    if end is not None:
        state.fades = end == "nothing"
    spaced()
    hint = "Keep the last gradient among the textures, under a name of its own"
    if w.text_button("Keep", hint, enabled=gradients.may_keep(desk)):
        gradients.keep_gradient(desk)


OF_TOOLS: dict[str, Callable[[Desk], None]] = {
    "fill": _region,
    "enclose": _within,
    "gradient": _gradient,
    "wand": _wand,
}
