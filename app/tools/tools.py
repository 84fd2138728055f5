"""The table of tools."""

from __future__ import annotations

from app import icons
from app.desk.framing.frame_state import FRAME_TOOL
from app.desk.moving.move_hints import move_hint
from app.tools.asking_gestures import pick
from app.tools.enclosing_gestures import enclose
from app.tools.filling_gestures import fill
from app.tools.framing_gestures import drag_frame
from app.tools.gesture import Tool
from app.tools.gradient_gestures import gradient
from app.tools.guide_gestures import move_guide
from app.tools.moving_gestures import move
from app.tools.painting_gestures import paint
from app.tools.selecting_gestures import ellipse, lasso, polygon, rectangle, wand
from app.tools.shape_gestures import DRAWN
from app.tools.view_gestures import pan, turn, zoom

_JOINING = "; Shift adds, Alt takes away, both leave what both have"
_HELD = "with Alt from its middle, with Shift"
TOOLS: dict[str, Tool] = {
    "brush": Tool("Brush", icons.BRUSH, paint, "Paint with the chosen brush (Alt+drag: its size)", True),
    "move": Tool("Move", icons.MOVE, move, "Drag the layer, or what is selected of it, or a handle", told=move_hint),
    "draw_line": Tool(
        "Line",
        icons.LINE,
        DRAWN["draw_line"],
        "A straight line; with Shift at steps of 15°, with Alt from its middle",
        True,
    ),
    "draw_rectangle": Tool(
        "Rectangle", icons.RECTANGLE, DRAWN["draw_rectangle"], f"A rectangle; {_HELD}, a square", True
    ),
    "draw_ellipse": Tool("Ellipse", icons.ELLIPSE, DRAWN["draw_ellipse"], f"An ellipse; {_HELD}, a circle", True),
    "draw_polyline": Tool(
        "Polyline",
        icons.POLYLINE,
        DRAWN["draw_polyline"],
        "A corner at each click; Enter or a double click ends it",
        True,
    ),
    "draw_curve": Tool(
        "Curve",
        icons.CURVE,
        DRAWN["draw_curve"],
        "Click, and drag to bend; Enter or a double click ends it, Backspace takes the last knot back",
        True,
    ),
    "guides": Tool(
        "Move guides", icons.GUIDES, move_guide, "Drag the points of guides, or the axis of symmetry; by 15° with Shift"
    ),
    FRAME_TOOL: Tool(
        "Frame", icons.AREA, drag_frame, "Drag the handles of the frame, with Shift at its ratio.  No paint is lost"
    ),
    "fill": Tool("Fill", icons.FILL, fill, "Click a region: it is filled with the chosen brush"),
    "enclose": Tool(
        "Fill within", icons.ENCLOSE, enclose, "Drag around what is to be filled: all that is alike where you begin"
    ),
    "gradient": Tool(
        "Gradient",
        icons.GRADIENT,
        gradient,
        "Drag to fill with a gradient; by 15° with Shift, both ways with Alt",
    ),
    "pan": Tool("Pan", icons.HAND, pan, "Drag the picture (Space or the middle button with any tool)"),
    "zoom": Tool("Zoom", icons.ZOOM, zoom, "Drag to zoom, click to go one level deeper (the wheel with any tool)"),
    "turn": Tool("Turn", icons.ROTATE, turn, "Drag to turn the view; the painting itself stays as it is"),
    "pick": Tool(
        "Pick colour", icons.PICK, pick, "Take a colour from the picture (Ctrl, or dragging with the right button)"
    ),
    "rectangle": Tool("Rectangle", icons.SELECT_BOX, rectangle, f"Drag to select a rectangle{_JOINING}"),
    "ellipse": Tool("Ellipse", icons.SELECT_ROUND, ellipse, f"Drag to select an ellipse{_JOINING}"),
    "lasso": Tool("Lasso", icons.LASSO, lasso, f"Drag around what is to be selected{_JOINING}"),
    "polygon": Tool("Polygon", icons.POLYGON, polygon, "Click the corners; Enter or a double click closes it"),
    "wand": Tool("Wand", icons.WAND, wand, f"Click to select what is of that colour{_JOINING}"),
}
