"""Brushes of other programs taken in: kept among the artist's own, each with its tip as a picture."""

from __future__ import annotations

import io
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from app.desk import presets
from app.desk.desk import Desk, FileWork
from app.desk.holding.taking import take_preset
from app.desk.notices import Notice
from app.desk.presets import Preset
from engine.checks.field_error import FieldError

if TYPE_CHECKING:
    from engine.files.brushes.found_brush import FoundBrush

STRANGERS = (".myb", ".gbr", ".gih", ".abr", ".kpp")  # endings of what can be read
_TIP_FILE = "files/0.png"
_TOLD = 5  # things that were left out, in one line
_ABOUT = "brought brushes"


class Brought(NamedTuple):
    """The brushes of a file, and a line for each of which something was left out."""

    kept: tuple[Preset, ...]
    left: tuple[str, ...]
    lines: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class BringStrangers(FileWork):
    """Takes in the brushes of another program's file; `taken`: the names that brushes have."""

    path: Path
    taken: frozenset[str]

    def carry_out(self) -> Brought:
        """Reads and keeps them, all or, where one cannot be written, none."""
        from engine.files.brushes.brush_files import read_brushes  # here, on the thread: it loads what reads XML

        found, taken = read_brushes(self.path), set(self.taken)
        group = presets.OWN if len(found.brushes) == 1 else self.path.stem[: presets.NAME_CAP] or presets.OWN
        kept: list[Preset] = []
        left, lines = list(found.left), list(found.left)
        try:
            for brush in found.brushes:
                try:
                    preset = _kept(brush, group, taken)
                except FieldError as error:
                    left.append(f"“{brush.name}” ({error})")
                    lines.append(left[-1])
                    continue
                kept.append(preset)
                taken.add(preset.name)
                left += brush.left
                lines += [f"“{preset.name}”: {', '.join(brush.left)}"] if brush.left else []
        except BaseException:
            for preset in kept:
                _forget(preset)
            raise
        return Brought(tuple(kept), tuple(dict.fromkeys(left)), tuple(lines))

    def arrive(self, desk: Desk, found: Brought) -> None:
        """Lists them, paints with the first, and tells what was left out of them."""
        if not found.kept:
            self.fail(desk, f"{self.path.name}: {found.left[0] if found.left else 'found no brush in it'}")
            return
        desk.learn(presets=(*desk.known.presets, *found.kept))
        take_preset(desk, found.kept[0])
        count = len(found.kept)
        told = f"the brush “{found.kept[0].name}”" if count == 1 else f"{count} brushes of {self.path.name}"
        desk.notices.settle(_ABOUT)
        if not found.left:
            desk.say(f"Brought in {told}")
            return
        more = len(found.left) - _TOLD
        rest = f" and {more} more" if more > 0 else ""
        text = f"Brought in {told}, without {', '.join(found.left[:_TOLD])}{rest}"
        desk.notices.add(Notice(text, bad=False, about=_ABOUT, lines=found.lines if count > 1 or more > 0 else ()))

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells what is wrong with the file."""
        desk.say(f"No brush was brought in: {fault}", bad=True)


def _kept(brush: FoundBrush, group: str, taken: set[str]) -> Preset:
    """Writes one, its tip as a texture of its own; returns it."""
    from app.desk.sharing.bundle import keep_brush
    from engine.files.png_writer import write_png

    told = {"name": brush.name, "group": group, "coloured": brush.coloured, "brush": dict(brush.settings)}
    files: dict[str, bytes] = {}
    if brush.tip is not None:
        held, texture = io.BytesIO(), f"{brush.name} tip"
        write_png(held, brush.tip[..., None])
        files[_TIP_FILE] = held.getvalue()
        told["brush"] = {**brush.settings, "tip": texture}
        told["textures"] = [{"name": texture, "maker": "image", "path": _TIP_FILE}]
    return keep_brush(told, files, brush.name, presets.own_folder(), taken)


def _forget(preset: Preset) -> None:
    """Takes one that was written away again, with its picture."""
    presets.delete(preset)
    for texture in preset.textures:
        shutil.rmtree(Path(str(texture.arguments["path"])).parents[1], ignore_errors=True)
