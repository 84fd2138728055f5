"""The actions of the Select menu."""

from __future__ import annotations

from collections.abc import Callable

from app.actions.action import Action as A
from app.actions.action import active, asks, chosen, ready
from app.actions.mask_actions import is_masked
from app.desk.desk import Desk
from app.desk.filling.pouring import fill_selection
from engine.painting import commands as c
from engine.painting.select_commands import MaskOf, Named, Whole
from engine.studio.requests import Do


def _now(desk: Desk) -> bool:
    return ready(desk) and desk.past.looking is None


def _some(desk: Desk) -> bool:
    return _now(desk) and desk.selecting.selected


def _on_layer(desk: Desk) -> bool:
    row = desk.known.active
    return chosen(desk) and _now(desk) and row is not None and row.shows is None


def _kept(desk: Desk) -> bool:
    return _now(desk) and bool(desk.selecting.saved)


def _bounded(desk: Desk) -> bool:
    return _some(desk) and desk.selecting.ants is not None and desk.selecting.ants.bounds is not None


def _crop(desk: Desk) -> None:
    ants = desk.selecting.ants
    if ants is not None and ants.bounds is not None:
        desk.post(Do(c.SetFrame(ants.bounds)))


def _whole(what: str) -> Callable[[Desk], None]:
    return lambda desk: desk.selecting.choose(desk.post, c.Select(Whole(what)))


def _from_layer(desk: Desk) -> None:
    desk.selecting.choose(desk.post, c.Select(Named(active(desk)), level=desk.view.shown_level))


def _from_mask(desk: Desk) -> None:
    desk.selecting.choose(desk.post, c.Select(MaskOf(active(desk)), level=desk.view.shown_level))


def _quick_mask(desk: Desk) -> None:
    desk.selecting.masking = not desk.selecting.masking


def _masking(desk: Desk) -> bool:
    return desk.selecting.masking


def _tool(name: str) -> Callable[[Desk], None]:
    return lambda desk: desk.hand.use(name)


def _is(name: str) -> Callable[[Desk], bool]:
    return lambda desk: desk.hand.tool == name


SELECT_ACTIONS: dict[str, A] = {
    "select_all": A("All", "Select", ("Ctrl+A",), "Select everything", _whole("all"), _now),
    "select_none": A("None", "Select", ("Ctrl+Shift+A",), "Select nothing, to paint anywhere", _whole("none"), _some),
    "select_invert": A("Invert", "Select", ("Ctrl+I",), "Select what is not selected", _whole("invert"), _some),
    "select_layer": A("From the layer", "Select", (), "Select what the layer covers", _from_layer, _on_layer),
    "select_mask": A(
        "From the mask", "Select", (), "Select what the layer's mask shows", _from_mask, is_masked
    ),
    "fill_selection": A(
        "Fill", "Select", ("Shift+F5", "Alt+Backspace"), "Fill the selection with the brush", fill_selection, _some
    ),
    "quick_mask": A(
        "Quick mask", "Select", ("Q",), "Paint what is selected; again to see its rim", _quick_mask, _now, _masking
    ),
    "select_change": A("Grow, shrink, feather…", "Select", (), "Move or soften its rim", asks("select_change"), _some),
    "crop": A("Crop to the selection", "Select", (), "End the picture there; no paint is lost", _crop, _bounded),
    "select_keep": A("Keep as…", "Select", (), "Keep the selection under a name", asks("select_keep"), _some),
    "select_kept": A("Kept selections…", "Select", (), "Select again what was kept", asks("select_kept"), _kept),
    "rectangle": A("Rectangle", "Select", ("S",), "Select a rectangle", _tool("rectangle"), checked=_is("rectangle")),
    "ellipse": A("Ellipse", "Select", ("Shift+S",), "Select an ellipse", _tool("ellipse"), checked=_is("ellipse")),
    "lasso": A("Lasso", "Select", ("O",), "Select what you go round", _tool("lasso"), checked=_is("lasso")),
    "polygon": A("Polygon", "Select", ("Shift+O",), "Select by corners", _tool("polygon"), checked=_is("polygon")),
    "wand": A("Wand", "Select", ("Shift+W",), "Select what is of one colour", _tool("wand"), checked=_is("wand")),
}  # fmt: skip
