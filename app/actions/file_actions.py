"""The actions of the File menu, and those of no menu that notices offer."""

from __future__ import annotations

from app.actions.action import Action as A
from app.actions.action import asks, asks_guarded, idle, ready
from app.desk import offers
from app.desk.desk import Desk
from engine.studio.filing.film_requests import StopFilm
from engine.studio.filing.opening_requests import StopPlaying


def _has_file(desk: Desk) -> bool:
    return ready(desk) and desk.known.path is not None


def _filming(desk: Desk) -> bool:
    return desk.known.filming is not None


def _can_film(desk: Desk) -> bool:
    return ready(desk) and not _filming(desk)


def _stop_film(desk: Desk) -> None:
    desk.post(StopFilm())


def _playing(desk: Desk) -> bool:
    return desk.known.playing is not None


def _stop_playing(desk: Desk) -> None:
    desk.post(StopPlaying())


def _stopped(desk: Desk) -> bool:
    return desk.notices.offering("start_engine") is not None


def close(desk: Desk) -> None:
    """Closes the window, after asking about a film that is being made and about unsaved changes."""
    if _filming(desk):
        desk.asked.show("filming")
    else:
        desk.guard(desk.asked.close)


FILE_ACTIONS: dict[str, A] = {
    "new": A("New…", "File", ("Ctrl+N",), "Start a new painting", asks_guarded("new"), ready),
    "open": A("Open…", "File", ("Ctrl+O",), "Open a painting, a picture or a recording", asks_guarded("open"), ready),
    "bring": A("Bring in a picture…", "File", (), "As a layer, group, texture or example", asks("bring from"), ready),
    "bring_brush": A("Bring in a brush…", "File", (), "Shared, or another program's", asks("brush from"), ready),
    "save": A("Save", "File", ("Ctrl+S",), "Save the painting; you can go on painting meanwhile", Desk.save, ready),
    "save_as": A("Save as…", "File", ("Ctrl+Shift+S",), "Save under another name", asks("save as"), ready),
    "earlier": A("Earlier versions…", "File", (), "What the last saves replaced", asks("earlier"), _has_file),
    "export": A("Export picture…", "File", ("Ctrl+E",), "Write the frame as PNG or TIFF", asks("export"), ready),
    "try_again": A("Try again", "", (), "Try once more what did not work", offers.try_again, offers.can_try),
    "free_space": A("Free space", "", (), "Tell how much room is left, and show the folder", offers.free_space),
    "bin": A("Bin…", "File", (), "Paintings that were closed without saving, or discarded", asks("bin"), idle),
    "start_engine": A(
        "Start it again",
        "",
        (),
        "Start the paint engine, with the painting as it was",
        lambda desk: desk.start_engine(),
        _stopped,
    ),
    "film": A("Film…", "File", ("Ctrl+Shift+E",), "Film how it was made, or a flight", asks("film"), _can_film),
    "stop_film": A("Stop film", "File", (), "Stop making the film; no file is written", _stop_film, _filming),
    "stop_playing": A(
        "Stop playing", "File", (), "Leave the painting as it is; you can paint on it", _stop_playing, _playing
    ),
    "quit": A("Quit", "File", ("Ctrl+Q",), "Close the window", close),
}  # fmt: skip
