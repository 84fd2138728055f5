"""A ready-made map of keys is taken, or one's own again."""

from __future__ import annotations

from app.actions.binding import change_keys
from app.actions.key_maps import KEY_MAPS
from app.desk.desk import Desk
from app.desk.keys.key_state import brush_of

OWN_KEYS = "own"  # what the artist bound, beside the ready-made maps


def take_map(desk: Desk, chosen: str, current: str) -> str:
    """Lays the keys of a map, or the artist's own again; what is to be told of that.  Keys of brushes stay."""
    before = {row: keys for row, keys in desk.keys.bound.items() if not brush_of(row)}
    brushes = {row: keys for row, keys in desk.keys.bound.items() if brush_of(row)}
    if current == OWN_KEYS:
        desk.keys.own = before
    change_keys(desk, {**(desk.keys.own if chosen == OWN_KEYS else KEY_MAPS[chosen].bound), **brushes})
    if chosen == OWN_KEYS:
        return "Your own keys are back"
    return f"{KEY_MAPS[chosen].hint}.  “Your own” has yours again" if current == OWN_KEYS else KEY_MAPS[chosen].hint
