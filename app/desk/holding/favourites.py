"""Favourite brushes: a star at a preset, a digit to take it by."""

from __future__ import annotations

from dataclasses import replace

from app.desk.desk import Desk
from app.desk.holding.desk_record import MOST_FAVOURITES
from app.desk.holding.kept_desk import change_kept
from app.desk.holding.taking import take_preset
from app.desk.presets import Preset


def favourites(desk: Desk) -> list[tuple[int, Preset]]:
    """Returns those that are there, each with its digit."""
    named = {preset.name: preset for preset in desk.known.presets}
    return [(i, named[name]) for i, name in enumerate(desk.kept.favourites, 1) if name in named]


def digit_of(desk: Desk, preset: Preset) -> int:
    """Returns the digit of a favourite, 0 for any other brush."""
    names = desk.kept.favourites
    return names.index(preset.name) + 1 if preset.name in names else 0


def star(desk: Desk, preset: Preset) -> None:
    """Makes a brush a favourite, the last one, or no favourite any more."""
    names = desk.kept.favourites
    if preset.name in names:
        change_kept(desk, replace(desk.kept, favourites=tuple(name for name in names if name != preset.name)))
        return
    there = {one.name for one in desk.known.presets}
    if len(names) >= MOST_FAVOURITES:  # those of brushes that are gone make room
        names = tuple(name for name in names if name in there)
    if len(names) >= MOST_FAVOURITES:
        desk.say(f"{MOST_FAVOURITES} favourites are all that there are keys for: take a star away first", bad=True)
        return
    change_kept(desk, replace(desk.kept, favourites=(*names, preset.name)))


def take_favourite(desk: Desk, digit: int) -> None:
    """Paints with the favourite of a digit."""
    found = next((preset for number, preset in favourites(desk) if number == digit), None)
    if found is not None:
        take_preset(desk, found)
        desk.say(f"Brush: {found.name}")


def has_favourite(desk: Desk, digit: int) -> bool:
    """Tells whether there is one of this digit."""
    return any(number == digit for number, _ in favourites(desk))
