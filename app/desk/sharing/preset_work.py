"""What is done to presets with their files: kept under another name, copied, deleted, shared, taken in."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from app.desk import palette, presets
from app.desk.desk import Desk, FileWork
from app.desk.hand import mixed_now
from app.desk.holding.kept_desk import change_kept
from app.desk.holding.taking import take_preset
from app.desk.presets import Preset
from app.desk.sharing.strangers import STRANGERS, BringStrangers

BRUSH = ".inkbrush"  # the ending of a shared brush
BRUSHES = (BRUSH, *STRANGERS)  # of all that can be brought in
_TO_REGRET = 20.0  # seconds for which undoing a deletion is offered; in the list of actions it stays


def _without(stay: tuple[str, ...]) -> str:
    """Returns what is told of textures that a brush in a file cannot have."""
    return f", without {' and '.join(stay)}, which only this painting has" if stay else ""


@dataclass(frozen=True, slots=True)
class ChangePreset(FileWork):
    """Keeps one of the artist's own as `after`, which may have another name; `stay`: the textures that only this
    painting has, which the file goes without."""

    before: Preset
    after: Preset
    stay: tuple[str, ...] = ()

    def carry_out(self) -> Preset:
        """Writes the file, and takes the one of the old name away."""
        kept = presets.written(self.after, presets.own_folder())
        if kept.path != self.before.path:
            presets.delete(self.before)
        return kept

    def arrive(self, desk: Desk, found: Preset) -> None:
        """Puts it in the place of the one that it was."""
        listed = tuple(found if one.name == self.before.name else one for one in desk.known.presets)
        desk.learn(presets=listed)
        names = (found.name if name == self.before.name else name for name in desk.kept.favourites)
        change_kept(desk, replace(desk.kept, favourites=tuple(names)))
        if desk.hand.preset == self.before.name:
            desk.hand.take(desk.hand.brush, found.name)
        desk.say(f"Kept the brush “{found.name}”{_without(self.stay)}", bad=bool(self.stay))

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells why it stays as it was."""
        desk.say(f"The brush was not changed: {fault}", bad=True)


@dataclass(frozen=True, slots=True)
class AddPreset(FileWork):
    """Keeps another one of the artist's own, and takes it in hand."""

    preset: Preset
    stay: tuple[str, ...] = ()

    def carry_out(self) -> Preset:
        """Writes the file."""
        return presets.written(self.preset, presets.own_folder())

    def arrive(self, desk: Desk, found: Preset) -> None:
        """Lists it with the others."""
        desk.learn(presets=(*(one for one in desk.known.presets if one.name != found.name), found))
        desk.hand.take(desk.hand.brush, found.name)
        desk.say(f"Saved the brush “{found.name}”{_without(self.stay)}", bad=bool(self.stay))

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells why there is none."""
        desk.say(f"The brush was not saved: {fault}", bad=True)


@dataclass(frozen=True, slots=True)
class DeletePreset(FileWork):
    """Takes the file of one of the artist's own away."""

    preset: Preset

    def carry_out(self) -> bytes:
        """Removes it; returns what was in it."""
        told = b"" if self.preset.path is None else self.preset.path.read_bytes()
        presets.delete(self.preset)
        return told

    def arrive(self, desk: Desk, found: bytes) -> None:
        """Lists it no more, and offers to bring it back."""
        place = next((i for i, one in enumerate(desk.known.presets) if one is self.preset), 0)
        desk.learn(presets=tuple(one for one in desk.known.presets if one is not self.preset))
        desk.asked.deleted = partial(desk.work, RestorePreset(self.preset, found, place))
        desk.say(f"Deleted the brush “{self.preset.name}”", offer="restore_brush", seconds=_TO_REGRET)

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells why it is still there."""
        desk.say(f"The brush was not deleted: {fault}", bad=True)


@dataclass(frozen=True, slots=True)
class RestorePreset(FileWork):
    """Brings back one that was deleted: its file `told` this, and it was listed at this `place`."""

    preset: Preset
    told: bytes
    place: int

    def carry_out(self) -> Preset:
        """Writes the file again."""
        names = (one.name for one in presets.load_brushes(presets.own_folder())[0])
        return presets.put_back(self.preset, self.told, names)

    def arrive(self, desk: Desk, found: Preset) -> None:
        """Lists it where it was."""
        listed = desk.known.presets
        desk.learn(presets=(*listed[: self.place], found, *listed[self.place :]))
        desk.asked.deleted = None
        desk.say(f"The brush “{found.name}” is back")

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells why it is not there."""
        desk.say(f"The brush was not brought back: {fault}", bad=True)


def undelete(desk: Desk) -> None:
    """Brings back the brush that was deleted last."""
    if desk.asked.deleted is not None:
        desk.asked.deleted()


@dataclass(frozen=True, slots=True)
class SharePreset(FileWork):
    """Writes a brush with all that it needs as one file."""

    preset: Preset
    path: Path

    def carry_out(self) -> None:
        """Writes it."""
        from app.desk.sharing.bundle import write_bundle  # here, on the thread: it loads what reads pictures

        write_bundle(self.preset, self.path)

    def arrive(self, desk: Desk, found: None) -> None:
        """Tells so."""
        desk.say(f"Shared the brush “{self.preset.name}” as {self.path.name}")

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells why it was not."""
        desk.say(f"The brush was not shared: {fault}", bad=True)


@dataclass(frozen=True, slots=True)
class BringPreset(FileWork):
    """Takes in a brush that somebody shared; `taken`: the names that brushes have."""

    path: Path
    taken: frozenset[str]

    def carry_out(self) -> Preset:
        """Reads and keeps it."""
        from app.desk.sharing.bundle import read_bundle  # here, on the thread: it loads what reads pictures

        return read_bundle(self.path, presets.own_folder(), set(self.taken))

    def arrive(self, desk: Desk, found: Preset) -> None:
        """Lists it, and paints with it from now on."""
        desk.learn(presets=(*desk.known.presets, found))
        take_preset(desk, found)
        desk.say(f"Brought in the brush “{found.name}”")

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells what is wrong with the file."""
        desk.say(f"No brush was brought in: {fault}", bad=True)


def bring_preset(desk: Desk, path: Path) -> None:
    """Has a shared brush taken in, or those of another program's file."""
    taken = frozenset(preset.name for preset in desk.known.presets)
    work = BringStrangers if path.suffix.lower() in STRANGERS else BringPreset
    desk.work(work(path, taken))


def held_preset(desk: Desk) -> Preset | None:
    """Returns the preset that the brush in hand was taken as, if it is still there."""
    return next((preset for preset in desk.known.presets if preset.name == desk.hand.preset), None)


def is_changed(desk: Desk) -> bool:
    """Tells whether the brush in hand is another than was taken; its size, and its example's, which goes by the view,
    do not count."""
    now, was = desk.hand.brush, desk.hand.original
    depth = now.depth if not now.depth and not was.depth else was.depth
    was = replace(was, radius=now.radius, depth=depth)
    was = replace(was, example_detail=now.example_detail, example_level=now.example_level)
    return bool(desk.hand.preset) and now != was


def take_back(desk: Desk) -> None:
    """Makes the brush in hand what it was when it was chosen."""
    preset = held_preset(desk)
    if preset is not None:
        take_preset(desk, replace(preset, coloured=False))


def keep_changes(desk: Desk) -> None:
    """Keeps what was changed of the brush in hand: in the artist's own preset; of a bundled one, in a copy."""
    preset, (textures, stay) = held_preset(desk), palette.belonging(desk)
    if preset is None:
        return
    changed = replace(preset, brush=mixed_now(desk.hand), textures=textures)
    if presets.is_own(preset):
        desk.work(ChangePreset(preset, changed, stay))
    else:
        name = presets.free_among(preset.name, (one.name for one in desk.known.presets))
        desk.work(AddPreset(replace(changed, name=name, path=None, group=presets.OWN), stay))


def duplicate(desk: Desk, preset: Preset) -> None:
    """Keeps a copy of a brush among the artist's own, and paints with that."""
    name = presets.free_among(preset.name, (one.name for one in desk.known.presets))
    take_preset(desk, preset)
    desk.work(AddPreset(replace(preset, name=name, path=None, group=presets.OWN)))
