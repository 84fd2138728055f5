"""Palettes that the artist brought in: kept as `.gpl` in a folder of their own, one of them shown."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import platformdirs

from app.desk.desk import Desk, FileWork
from app.desk.holding.kept_desk import change_kept
from app.desk.presets import free_among, stem_of
from engine.files.fault import FileError
from engine.files.swatches.colour_list import ColourList, NamedColour

PALETTES = (".gpl", ".aco", ".ase", ".kpl")  # endings of what can be read


def palettes_folder() -> Path:
    """Tells where they are kept."""
    return platformdirs.user_config_path("inkfall") / "palettes"


def load_palettes(folder: Path) -> tuple[list[ColourList], list[str]]:
    """Returns the palettes of a folder by file name, and a line for each file that is none."""
    from engine.files.swatches.palette_files import read_palette  # here, on the thread: it loads what reads XML

    found, faults = [], []
    for path in sorted(folder.glob("*.gpl")) if folder.is_dir() else []:
        try:
            found.append(read_palette(path))
        except (OSError, FileError) as error:
            faults.append(str(error))
    return found, faults


@dataclass(frozen=True, slots=True)
class KeptPalette(FileWork):
    """Finds a palette and keeps it; `taken`: the names that others have."""

    taken: frozenset[str]

    def found(self) -> ColourList:
        """Returns it; OSError or FileError."""
        raise NotImplementedError

    def carry_out(self) -> ColourList:
        """Finds and writes it."""
        from engine.files.swatches.palette_files import write_palette

        read, folder = self.found(), palettes_folder()
        found = replace(read, name=free_among(read.name, self.taken))
        folder.mkdir(parents=True, exist_ok=True)
        stem, number = stem_of(found.name), 1
        while (folder / f"{stem}.gpl").exists():
            number += 1
            stem = f"{stem_of(found.name)}-{number}"
        write_palette(found, folder / f"{stem}.gpl")
        return found

    def arrive(self, desk: Desk, found: ColourList) -> None:
        """Shows it."""
        desk.learn(palettes=(*desk.known.palettes, found))
        show_palette(desk, found.name)
        desk.say(f"Brought in the palette “{found.name}”, {len(found.colours)} colours")

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells what is wrong with the file."""
        desk.say(f"No palette was brought in: {fault}", bad=True)


@dataclass(frozen=True, slots=True)
class BringPalette(KeptPalette):
    """Reads a palette and keeps it."""

    path: Path

    def found(self) -> ColourList:
        """Reads it."""
        from engine.files.swatches.palette_files import read_palette

        return read_palette(self.path)


@dataclass(frozen=True, slots=True)
class WritePalette(FileWork):
    """Writes a palette for others."""

    palette: ColourList
    path: Path

    def carry_out(self) -> None:
        """Writes it."""
        from engine.files.swatches.palette_files import write_palette

        write_palette(self.palette, self.path)

    def arrive(self, desk: Desk, found: None) -> None:
        """Tells so."""
        desk.say(f"Wrote the palette {self.path.name}")

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells why it was not."""
        desk.say(f"The palette was not written: {fault}", bad=True)


def bring_palette(desk: Desk, path: Path) -> None:
    """Has a palette taken in."""
    desk.work(BringPalette(taken_names(desk), path))


def taken_names(desk: Desk) -> frozenset[str]:
    """Returns the names that palettes have."""
    return frozenset(palette.name for palette in desk.known.palettes)


def show_palette(desk: Desk, name: str) -> None:
    """Shows a palette below the colours, none for an empty name."""
    change_kept(desk, replace(desk.kept, palette=name))


def shown_palette(desk: Desk) -> ColourList | None:
    """Returns the one that is shown."""
    return next((palette for palette in desk.known.palettes if palette.name == desk.kept.palette), None)


def palette_to_write(desk: Desk) -> ColourList:
    """Returns the palette that is shown, else the colours painted with."""
    shown = shown_palette(desk)
    return shown or ColourList("Painted with", tuple(NamedColour(colour) for colour in desk.hand.colours))
