"""What a desk keeps between sessions: favourite brushes, the colours painted with and how the wheel is set, as
`desk.json` in the configuration folder."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import platformdirs

from app.desk.colours import from_hex, to_hex
from app.desk.desk import Desk, FileWork
from app.desk.hand import HISTORY
from app.desk.holding.desk_record import MOST_FAVOURITES, KeptDesk
from app.desk.holding.wheel_record import read_wheel, wheel_told
from app.desk.remembering.kept_json import KeptObject, read_kept_object, write_kept_object
from engine.checks.field_error import FieldError
from engine.checks.values import described

_NAMES = 4096  # characters of a name at most


def kept_file() -> Path:
    """Returns where it lies, whether it is there or not."""
    return platformdirs.user_config_path("inkfall") / "desk.json"


def read_kept(path: Path) -> tuple[KeptDesk, str]:
    """Returns what was kept, and why that is not what the file should tell, one line."""
    return read_kept_object(path, _kept_of, KeptDesk())


def _kept_of(data: KeptObject) -> KeptDesk:
    favourites = _texts(data.get("favourites", list(KeptDesk().favourites)), "favourites", MOST_FAVOURITES)
    colours = _texts(data.get("colours", []), "colours", HISTORY)
    (palette,) = _texts([data.get("palette", "")], "palette", 1)
    wheel = read_wheel(data.get("wheel", {}))
    return KeptDesk(favourites, tuple(to_hex(from_hex(colour)) for colour in colours), palette, wheel)


def _texts(value: object, place: str, most: int) -> tuple[str, ...]:
    if not isinstance(value, list) or not all(isinstance(one, str) and len(one) <= _NAMES for one in value):
        raise FieldError(place, described(value), "a list of texts")
    return tuple(dict.fromkeys(value))[:most]


@dataclass(frozen=True, slots=True)
class KeepDesk(FileWork):
    """Writes it; a file that cannot be read is put aside before."""

    kept: KeptDesk

    def carry_out(self) -> None:
        """Writes the file."""
        path, kept = kept_file(), self.kept
        told: KeptObject = {"favourites": kept.favourites, "colours": kept.colours, "palette": kept.palette}
        told["wheel"] = wheel_told(kept.wheel)
        write_kept_object(path, told, bool(read_kept(path)[1]))

    def arrive(self, desk: Desk, found: None) -> None:
        """Tells nothing: nobody asked for it."""

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells that it is not kept."""
        desk.say(f"Favourites and colours are not kept: {fault}", bad=True)


def restore(desk: Desk, kept: KeptDesk) -> None:
    """Lays on the desk what was kept."""
    here = [colour for colour in map(to_hex, desk.hand.colours) if colour not in kept.colours]
    desk.kept = kept
    desk.hand.colours = [from_hex(colour) for colour in (*here, *kept.colours)][:HISTORY]


def keep_colours(desk: Desk) -> None:
    """Keeps the colours painted with, where they are others now."""
    colours = tuple(dict.fromkeys(map(to_hex, desk.hand.colours)))
    if set(colours) - set(desk.kept.colours):
        change_kept(desk, replace(desk.kept, colours=colours))


def change_kept(desk: Desk, kept: KeptDesk) -> None:
    """Keeps something else."""
    if kept != desk.kept:
        desk.kept = kept
        desk.work(KeepDesk(kept))
