"""The actions of the View and the Go menu."""

from __future__ import annotations

import math
from collections.abc import Callable

from app.actions.action import Action as A
from app.actions.action import Check, always, ready
from app.desk.desk import Desk
from app.desk.naming import free_name
from app.desk.places import going
from engine.studio.requests import Do

_FLOWN = 4.0  # notches of the wheel that a level is, in the land


def _back(desk: Desk) -> bool:
    return desk.places.trail.can_go_back and not desk.painting


def _forward(desk: Desk) -> bool:
    return desk.places.trail.can_go_forward and not desk.painting


def _lost(desk: Desk) -> bool:
    return desk.places.lost and not desk.painting


def _zooms(levels: float) -> Callable[[Desk], None]:
    def do(desk: Desk) -> None:
        if desk.land.on:
            desk.land.fly(*desk.middle(), levels * _FLOWN)
        else:
            desk.glide.zoom(desk.view, levels, *desk.middle())

    return do


def _fit(desk: Desk) -> None:
    desk.fit()
    desk.land.stand(None)


def _one_to_one(desk: Desk) -> None:
    desk.glide.to(desk.view, 0, 0.0, *desk.middle())


def _turns(degrees: float) -> Callable[[Desk], None]:
    def do(desk: Desk) -> None:
        desk.view = desk.view.turned(desk.view.angle + math.radians(degrees), *desk.middle())
        desk.glide.stop()

    return do


def _upright(desk: Desk) -> None:
    desk.view = desk.view.turned(0.0, *desk.middle())
    desk.glide.stop()


def _mirror(desk: Desk) -> None:
    place = desk.view.to_canvas(*desk.middle())
    desk.view = desk.view.flipped().held(place, *desk.middle())
    desk.glide.stop()


def _panels(desk: Desk) -> None:
    desk.panels = not desk.panels


def _light(desk: Desk) -> None:
    desk.light.on = not desk.light.on


def _soft_proof(desk: Desk) -> None:
    if desk.proofing.proof is None:
        desk.say("Choose whose profile is imitated: Preferences, Display")
        desk.asked.show("preferences")
    desk.proofing.on = desk.proofing.proof is not None and not desk.proofing.on


def _land(desk: Desk) -> None:
    desk.glide.land()
    desk.land.on = not desk.land.on


def _strip(name: str) -> Callable[[Desk], None]:
    def toggle(desk: Desk) -> None:
        desk.strip = "" if desk.strip == name else name
        desk.panels = desk.panels or bool(desk.strip)

    return toggle


def _open(name: str) -> Check:
    return lambda desk: desk.strip == name


def _steps(by: int) -> Callable[[Desk], None]:
    return lambda desk: going.step(desk, by)


def _bookmark(desk: Desk) -> None:
    taken = {mark.name for mark in desk.known.scene.bookmarks} if desk.known.scene else set()
    bookmark = going.bookmark_here(desk, free_name("Place", taken))
    if bookmark is not None:
        desk.post(Do(bookmark))
        desk.say(f"Bookmarked as “{bookmark.name}”", offer="" if desk.strip == "places" else "places")


def _type_place(desk: Desk) -> None:
    desk.places.typed, desk.places.fault = going.typed_text(desk), ""


VIEW_ACTIONS: dict[str, A] = {
    "fit": A("Fit the frame", "View", ("F", "2"), "Show the whole frame", _fit),
    "one": A("One to one", "View", ("1",), "One pixel of level 0 on one of the screen", _one_to_one),
    "in": A("Zoom in", "View", ("+", "=", "PageUp"), "One level deeper", _zooms(1.0)),
    "out": A("Zoom out", "View", ("-", "PageDown"), "One level back", _zooms(-1.0)),
    "turn_left": A("Turn left", "View", ("4",), "Turn the view by 15° to the left", _turns(-15)),
    "turn_right": A("Turn right", "View", ("6",), "Turn the view by 15° to the right", _turns(15)),
    "upright": A("Upright", "View", ("5",), "Turn the view upright", _upright),
    "mirror": A("Mirror", "View", ("M",), "Mirror the view", _mirror, always, lambda d: d.view.mirrored),
    "panels": A("Panels", "View", ("Tab",), "Show or hide the panels", _panels, always, lambda d: d.panels),
    "light": A(
        "Light",
        "View",
        ("Shift+L",),
        "See the painting lit by its own relief; nothing is painted",
        _light,
        always,
        lambda desk: desk.light.on,
    ),
    "soft_proof": A(
        "Soft proof", "View", ("Shift+J",), "See it as another screen or printer would show it; nothing is painted",
        _soft_proof, always, lambda desk: desk.proofing.on,
    ),
    "land": A(
        "Terrain", "View", ("Ctrl+T",), "Fly over the painting as land, and paint on it", _land, ready,
        lambda desk: desk.land.on,
    ),
    "lab": A("Texture lab", "View", ("L",), "Paint a texture by its spectrum", _strip("lab"), ready, _open("lab")),
    "analysis": A(
        "Analysis", "View", ("A",), "What the painting is made of", _strip("analysis"), ready, _open("analysis")
    ),
    "match": A(
        "Match a texture", "View", ("T",), "Make a texture like an example", _strip("match"), ready, _open("match")
    ),
    "solid": A(
        "Solid", "View", ("Shift+T",), "Stone and wood on an object", _strip("solid"), ready, _open("solid")
    ),
    "workshop": A(
        "Workshop", "View", ("Shift+E",), "Write a texture of your own", _strip("workshop"), ready, _open("workshop")
    ),
    "examples": A(
        "Examples", "View", ("P",), "Paint with textures that have a rim", _strip("examples"), ready, _open("examples")
    ),
    "history": A(
        "History", "View", ("Ctrl+H",), "Every step, to go back to", _strip("history"), ready, _open("history")
    ),
    "back": A("Back", "Go", ("Alt+Left", "Back button"), "To where you were before", _steps(-1), _back),
    "forward": A("Forward", "Go", ("Alt+Right", "Forward button"), "To where you came back from", _steps(1), _forward),
    "nearest": A("Nearest paint", "Go", ("Home",), "Go to the nearest paint", going.go_to_nearest, _lost),
    "type_place": A("Go to place", "Go", ("Ctrl+L",), "Type or copy level and place", _type_place),
    "bookmark": A("Bookmark this view", "Go", ("Ctrl+B",), "Keep this view under a name", _bookmark, ready),
    "places": A("Places", "Go", ("J",), "Bookmarks, and a map of the paint", _strip("places"), ready, _open("places")),
}  # fmt: skip
