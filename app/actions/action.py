"""What an action is, and what several of them have in common."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from app.desk.desk import Desk
from engine.painting import commands as c
from engine.studio.requests import Do

Check = Callable[[Desk], bool]


class Action(NamedTuple):
    """One thing the artist can do.  `menu`: the one it is in, "Layer/Mask" for one within another; `keys`: such as
    `Ctrl+Shift+Z`, the first is shown in menus."""

    title: str
    menu: str
    keys: tuple[str, ...]
    hint: str
    do: Callable[[Desk], None]
    when: Check = lambda desk: True
    checked: Check | None = None


def always(_desk: Desk) -> bool:
    """True: for what can always be done."""
    return True


def ready(desk: Desk) -> bool:
    """Tells whether the engine can be asked, and no stroke is in hand."""
    return desk.known.ready and not desk.painting


def idle(desk: Desk) -> bool:
    """Tells whether no stroke is in hand."""
    return not desk.painting


def chosen(desk: Desk) -> bool:
    """Tells whether a layer is chosen."""
    return ready(desk) and desk.known.scene is not None and desk.known.scene.active is not None


def paint_chosen(desk: Desk) -> bool:
    """Tells whether what is chosen is a layer of paint."""
    row = desk.known.active
    return chosen(desk) and row is not None and not row.group and row.shows is None


def posts(make: Callable[[], c.Command]) -> Callable[[Desk], None]:
    """Returns what posts a command that `make` makes."""
    return lambda desk: desk.post(Do(make()))


def active(desk: Desk) -> str:
    """Returns the name of the layer that is chosen."""
    assert desk.known.scene is not None
    assert desk.known.scene.active is not None
    return desk.known.scene.active


def asks(name: str) -> Callable[[Desk], None]:
    """Returns what shows a dialog."""
    return lambda desk: desk.asked.show(name)


def asks_guarded(name: str) -> Callable[[Desk], None]:
    """Returns what shows a dialog, once what is not saved was asked about."""
    return lambda desk: desk.guard(lambda: desk.asked.show(name))


def to_now(desk: Desk) -> None:
    """Shows the painting as it is, after looking back."""
    desk.past.look(desk.post, None)
