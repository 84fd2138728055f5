"""What the window begins with: brushes, papers and examples, read from their folders, and a brush in the hand."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from app.desk import presets
from app.desk.desk import Desk, FileWork
from app.desk.examples import example_state
from app.desk.examples.example_state import Entry
from app.desk.examples.example_use import gather
from app.desk.holding.desk_record import KeptDesk
from app.desk.holding.generator_brushes import generator_brushes
from app.desk.holding.kept_desk import kept_file, read_kept, restore
from app.desk.holding.palette_shelf import load_palettes, palettes_folder
from app.desk.holding.written_brushes import written_brushes
from app.desk.notices import Notice
from app.desk.presets import Paper, Preset
from app.desk.remembering.kept_window import FoundAgain, found_again, restore_found
from app.desk.remembering.window_record import KeptWindow
from engine.files.swatches.colour_list import ColourList


class Stock(NamedTuple):
    """`faults`: a line for each file that is at fault."""

    presets: tuple[Preset, ...]
    papers: tuple[Paper, ...]
    examples: tuple[Entry, ...]
    kept: KeptDesk
    palettes: tuple[ColourList, ...]
    found: FoundAgain
    faults: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class TakeStock(FileWork):
    """Reads all that comes along, and all of the artist's own; `window`: what that remembers, `windows_faults`: what is
    wrong with its files, a line each."""

    window: KeptWindow = KeptWindow()  # noqa: RUF009  # it never changes
    windows_faults: tuple[str, ...] = ()

    def carry_out(self) -> Stock:
        """Reads presets, papers and examples, those that come along and the artist's own."""
        bundled, faults = presets.load_brushes(presets.bundled_folder())
        own, more = presets.load_brushes(presets.own_folder())
        papers, torn = presets.load_papers(presets.papers_folder())
        given, bad = example_state.load_examples(example_state.bundled_folder(), False)
        kept, lost = example_state.load_examples(example_state.own_folder(), True)
        examples = example_state.arranged([*given, *kept])
        desk_kept, fault = read_kept(kept_file())
        palettes, worse = load_palettes(palettes_folder())
        told = (*faults, *more, *torn, *bad, *lost, *worse, *([fault] if fault else ()), *self.windows_faults)
        brushes, found = (*bundled, *generator_brushes(), *written_brushes(), *own), found_again(self.window)
        return Stock(brushes, tuple(papers), tuple(examples), desk_kept, tuple(palettes), found, told)

    def arrive(self, desk: Desk, found: Stock) -> None:
        """Puts what was found on the desk."""
        desk.learn(presets=found.presets or (presets.DEFAULT,), papers=found.papers, palettes=found.palettes)
        desk.examples.entries = found.examples
        restore(desk, found.kept)
        restore_found(desk, found.found)
        gather(desk)
        _first(desk)
        if found.faults:
            desk.notices.add(_kept(found.faults))

    def fail(self, desk: Desk, fault: str) -> None:
        """Goes on with the one brush that needs no file, and says why."""
        desk.learn(presets=(presets.DEFAULT,))
        _first(desk)
        desk.say(fault, bad=True)


def _kept(faults: tuple[str, ...]) -> Notice:
    """Returns what is told of files that are at fault: one line of it, or how many there are."""
    if len(faults) == 1:
        return Notice(f"{faults[0]}; the file is kept as it is")
    told = f"{len(faults)} files of brushes, examples and the desk are damaged; they are kept as they are"
    return Notice(told, lines=faults)


def _first(desk: Desk) -> None:
    """Takes a brush that paints, unless there is one in the hand."""
    if not desk.hand.preset:
        listed = desk.known.presets
        first = next((preset for preset in listed if preset.brush.row.lays_ink), listed[0])
        desk.hand.take(first.brush, first.name, first.textures)
