"""Maps of examples that are painted in the palette: used at once, and kept in the files of the artist's own."""

from __future__ import annotations

from dataclasses import dataclass

from immutables import Map

from app.desk.desk import Desk, FileWork
from app.desk.examples import own_example_files
from app.desk.examples.chart_use import maps_of
from app.desk.examples.example_state import Entry
from app.desk.examples.example_use import take_example
from app.desk.examples.example_work import Listing, listing_of, relist
from engine.texture.example.parameters import ORIENTATION, Parameters


def use(desk: Desk, maps: Map[str, object]) -> None:
    """Paints with these maps from now on."""
    state, entry = desk.examples, desk.examples.entry
    if entry is None or maps == maps_of(state, entry):
        return
    if ORIENTATION in maps and ORIENTATION not in maps_of(state, entry):
        state.follows = True
    state.charts[entry.ident] = maps
    take_example(desk)


@dataclass(frozen=True, slots=True)
class _KeepMaps(FileWork):
    entry: Entry
    parameters: Parameters
    maps: Map[str, object]

    def carry_out(self) -> Listing:
        name = self.entry.name if self.entry.own else own_example_files.copy(self.entry, self.parameters)
        parameters = self.entry.parameters if self.entry.own else self.parameters
        own_example_files.write_parameters(name, parameters, self.entry.given if self.entry.own else "", self.maps)
        return listing_of(name)

    def arrive(self, desk: Desk, found: Listing) -> None:
        if desk.examples.charts.get(self.entry.ident) == self.maps:
            del desk.examples.charts[self.entry.ident]
        if not self.entry.own:
            desk.examples.tab = "palette"
        relist(desk, found)
        title = desk.examples.entry.title if desk.examples.entry is not None else ""
        desk.say(f"Saved the maps of “{title}”" + ("" if self.entry.own else ", an example of your own now"))


def keep_maps(desk: Desk) -> None:
    """Writes the maps as they are; those of an example that comes along go to a copy of the artist's own."""
    state, entry = desk.examples, desk.examples.entry
    if entry is not None:
        desk.work(_KeepMaps(entry, state.draft(entry), maps_of(state, entry)))
