"""The actions of the Tools menu."""

from __future__ import annotations

from collections.abc import Callable

from app.actions.action import Action as A
from app.actions.action import Check, always, idle, to_now
from app.desk.desk import Desk
from app.desk.filling.fill_state import all_gone_round, unbounded
from app.desk.holding.desk_record import MOST_FAVOURITES
from app.desk.holding.favourites import has_favourite, take_favourite
from app.desk.moving.floating import let_go
from app.desk.sharing.preset_work import undelete
from engine.studio.requests import Do


def _tool(name: str) -> Callable[[Desk], None]:
    def choose(desk: Desk) -> None:
        desk.hand.use(name)

    return choose


def _is(name: str) -> Check:
    return lambda desk: desk.hand.tool == name and not desk.hand.erasing


def _erasing(desk: Desk) -> bool:
    return desk.hand.erasing


def _toggle_eraser(desk: Desk) -> None:
    desk.hand.erase(not desk.hand.erasing)


def _escape(desk: Desk) -> None:
    if desk.known.opening is not None:
        desk.stop_opening()
        return
    if desk.moving.floating is not None:
        let_go(desk)
        return
    desk.match.marking = None
    desk.past.asking = False
    if desk.past.looking is not None:
        to_now(desk)
    desk.examples.swapping = False
    desk.hand.use("brush")


def _leaks(desk: Desk) -> bool:
    return desk.known.ready and desk.filling.last is not None and desk.notices.about("fill")


def _fill_all(desk: Desk) -> None:
    if desk.filling.last is not None:
        desk.notices.settle("fill")
        desk.post(Do(unbounded(desk.filling.last)))


def _fill_line(desk: Desk) -> None:
    if desk.filling.last is not None:
        desk.notices.settle("fill")
        desk.post(Do(all_gone_round(desk.filling.last)))


def _unclosed(desk: Desk) -> bool:
    return _leaks(desk) and desk.notices.offering("fill_line") is not None


def _drawing(tool: str, title: str, key: str, hint: str) -> A:
    return A(title, "Tools", (key,), f"{hint}, drawn by the brush", _tool(tool), always, _is(tool))


def _favourite(digit: int) -> A:
    hint, key = "Paint with this favourite; stars in the list of brushes make them", f"Ctrl+{digit}"
    return A(
        f"Favourite {digit}", "Tools/Favourites", (key,), hint, lambda desk: take_favourite(desk, digit),
        lambda desk: idle(desk) and has_favourite(desk, digit),
    )  # fmt: skip


def _is_deleted(desk: Desk) -> bool:
    return desk.asked.deleted is not None


def _pop_up(desk: Desk) -> None:
    desk.hand_sight.palette_at = desk.pointer.x, desk.pointer.y


_SHAPES = {
    "line": ("Draw a line", "U", "A straight line"),
    "polyline": ("Draw a polyline", "Shift+U", "A line with corners"),
    "curve": ("Draw a curve", "Ctrl+U", "A curve with handles"),
    "rectangle": ("Draw a rectangle", "N", "A rectangle or a square"),
    "ellipse": ("Draw an ellipse", "Shift+N", "An ellipse or a circle"),
}
TOOL_ACTIONS: dict[str, A] = {
    "brush": A("Brush", "Tools", ("B",), "Paint", _tool("brush"), always, _is("brush")),
    "eraser": A("Eraser", "Tools", ("E",), "Erase; again to paint", _toggle_eraser, always, _erasing),
    "pick": A("Pick colour", "Tools", ("I",), "Take a colour from the picture", _tool("pick"), always, _is("pick")),
    "move": A("Move", "Tools", ("V",), "Drag the layer", _tool("move"), always, _is("move")),
    "fill": A("Fill", "Tools", ("G",), "Fill a region with the brush", _tool("fill"), always, _is("fill")),
    "gradient": A(
        "Gradient", "Tools", ("Shift+G",), "Fill with a gradient", _tool("gradient"), always, _is("gradient")
    ),
    "enclose": A(
        "Fill within", "Tools", ("Alt+G",), "Fill all that you go round", _tool("enclose"), always, _is("enclose")
    ),
    "fill_all": A("Fill all the same", "Tools", (), "Fill up to the end of what is looked at", _fill_all, _leaks),
    "fill_line": A(
        "Fill what the line goes round", "Tools", (), "Fill all of it, whatever is there", _fill_line, _unclosed
    ),
    "pan": A("Pan", "Tools", ("H",), "Drag the picture", _tool("pan"), always, _is("pan")),
    "zoom": A("Zoom", "Tools", ("Z",), "Drag to zoom", _tool("zoom"), always, _is("zoom")),
    "turn": A("Turn", "Tools", ("R",), "Drag to turn the view", _tool("turn"), always, _is("turn")),
    **{f"draw_{name}": _drawing(f"draw_{name}", *row) for name, row in _SHAPES.items()},
    "restore_brush": A(
        "Undo the deletion", "Tools", (), "Bring back the brush that was deleted last", undelete, _is_deleted
    ),
    "smaller": A("Smaller brush", "Tools", ("[",), "Make the brush smaller", lambda d: d.hand.resize(1 / 1.15)),
    "larger": A("Larger brush", "Tools", ("]",), "Make the brush larger", lambda d: d.hand.resize(1.15)),
    **{f"favourite_{digit}": _favourite(digit) for digit in range(1, MOST_FAVOURITES + 1)},
    "pop_up": A(
        "Pop-up palette", "Tools", ("K",), "Favourites, colours and zoom under the pointer (right click)", _pop_up, idle
    ),
    "escape": A("Back to the brush", "Tools", ("Escape",), "Stop what is going on; back to the brush", _escape),
}  # fmt: skip
