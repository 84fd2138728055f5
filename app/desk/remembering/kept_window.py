"""What a window remembers, as `window.json` in the configuration folder: laid on the desk at the start, and written
whenever something else of it has been so for a while."""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from pathlib import Path
from typing import NamedTuple

from app.desk.colours import from_hex, to_hex
from app.desk.desk import Desk, FileWork
from app.desk.exporting.export_areas import AREAS
from app.desk.exporting.export_state import EXPORT_CHOICES, FRAME_AREA
from app.desk.presets import Preset
from app.desk.remembering.kept_json import read_kept_object, write_kept_object
from app.desk.remembering.window_record import KeptHand, KeptWindow, window_json, window_of
from app.desk.solids.kept_solid import KeptSolid
from app.input.window_box import WindowBox, kept_window_file

Where = Callable[[], WindowBox | None]  # tells where the window lies, None where that is not known
_PAUSE = 1.0  # seconds from one look to the next


def read_window(path: Path) -> tuple[KeptWindow, str]:
    """Returns what a window remembered, and why that is not what the file should tell, one line."""
    return read_kept_object(path, window_of, KeptWindow())


@dataclass(frozen=True, slots=True)
class KeepWindow(FileWork):
    """Writes it; a file that cannot be read is put aside before."""

    kept: KeptWindow

    def carry_out(self) -> None:
        """Writes the file."""
        path = kept_window_file()
        write_kept_object(path, window_json(self.kept), bool(read_window(path)[1]))

    def arrive(self, desk: Desk, found: None) -> None:
        """Tells nothing: nobody asked for it."""

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells nothing: what could not be written now is tried with the next change."""


class FoundAgain(NamedTuple):
    """What only the files' thread may look at: the brush in the hand, and folders that are still there."""

    hand: KeptHand
    folders: tuple[tuple[str, Path], ...]


def found_again(kept: KeptWindow) -> FoundAgain:
    """Looks at what is in folders."""
    return FoundAgain(kept.hand, tuple((name, Path(folder)) for name, folder in kept.folders if Path(folder).is_dir()))


def restore_window(desk: Desk, kept: KeptWindow) -> None:
    """Lays on the desk what needs no file; before the first frame."""
    desk.remembered.kept, desk.start.welcomed = kept, kept.welcomed
    desk.remembered.strip, desk.remembered.folded = kept.strip, dict(kept.folded)
    desk.arranged.now, desk.arranged.workspaces = kept.panels, kept.workspaces
    kept.solid.lay(desk.solid)
    for name in EXPORT_CHOICES:
        setattr(desk.export, name, getattr(kept.export, name))
    if desk.export.area not in AREAS:
        desk.export.area = FRAME_AREA
    if kept.hand.colours is not None:
        desk.hand.colour, desk.hand.other_colour = (from_hex(colour) for colour in kept.hand.colours)
    if kept.hand.stabiliser is not None:
        desk.hand.stabiliser = kept.hand.stabiliser
    desk.hand.steadying = kept.hand.steadying or desk.hand.steadying


def restore_found(desk: Desk, found: FoundAgain) -> None:
    """Lays on the desk what was found in folders, with the brush that was in the hand."""
    desk.opened.folders = {**dict(found.folders), **desk.opened.folders}
    brush = found.hand.brush
    named = next((preset for preset in desk.known.presets if brush is not None and preset.name == brush.name), None)
    if brush is None or named is None or desk.hand.preset or not brush.brush.row.lays_ink:
        return
    desk.hand.take(brush.brush, brush.name, brush.textures)
    desk.hand.original = named.brush


class Remembering:
    """Looks now and then for what is to be remembered; all calls from the window's thread.  `strips`: what may be open
    below the canvas."""

    def __init__(self, where: Where, strips: Collection[str] = ()) -> None:
        self._where, self._strips = where, strips
        self._next, self._told = 0.0, (KeptWindow(), KeptWindow())

    def watch(self, desk: Desk, now: float) -> None:
        """Keeps what has been so twice, a second apart; called in every frame."""
        if now < self._next or desk.painting or not desk.known.presets:
            return
        self._next = now + _PAUSE
        if desk.remembered.strip and desk.known.ready:
            wanted, desk.remembered.strip = desk.remembered.strip, ""
            desk.strip = wanted if wanted in self._strips else desk.strip
        self._keep(desk, sure=False)

    def end(self, desk: Desk) -> None:
        """Keeps it as it is now."""
        if desk.known.presets:
            self._keep(desk, sure=True)

    def _keep(self, desk: Desk, sure: bool) -> None:
        kept, before = remembered_now(desk, self._where()), self._told[1]
        self._told = before, kept
        if kept != desk.remembered.kept and (sure or kept == before):
            desk.remembered.kept = kept
            desk.work(KeepWindow(kept))


def remembered_now(desk: Desk, box: WindowBox | None) -> KeptWindow:
    """Returns what is to be remembered; `box`: where the window lies, None where that is not known."""
    hand, before = desk.hand, desk.remembered.kept
    brush = Preset(hand.preset or "Brush", hand.brush, textures=hand.needs)
    held = KeptHand(brush, (to_hex(hand.colour), to_hex(hand.other_colour)), hand.stabiliser, hand.steadying)
    folders = {name: str(folder) for name, folder in desk.opened.folders.items()}
    return replace(
        before,
        box=box or before.box,
        welcomed=desk.start.welcomed,
        strip=desk.remembered.strip or desk.strip,
        folded=tuple(sorted(desk.remembered.folded.items())),
        folders=tuple(sorted(folders.items())),
        hand=held,
        export=replace(desk.export, light=None),
        panels=desk.arranged.now,
        workspaces=desk.arranged.workspaces,
        solid=KeptSolid.of(desk.solid),
    )
