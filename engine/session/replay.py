"""Replaying a recording: the same commands through the same session, so the same pixels."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from immutables import Map

from engine.canvas.tile_cache import TileCache
from engine.files.fault import FileError
from engine.keeping import memory
from engine.painting import commands as c
from engine.painting.recording import Recording, undo_reach
from engine.painting.value import first_painting
from engine.session.apply import STEPS, Refusal
from engine.session.history import History
from engine.session.session import Session
from engine.texture.image import ImageSource

NO_PICTURES: Map[str, ImageSource] = Map()


def opened(
    recording: Recording, cache: TileCache | None = None, seed: int | None = None, history_bytes: int | None = None
) -> Session:
    """Returns a session as the recording's header describes it, nothing done yet.

    However few `history_bytes` are (None: the share of the budget), undo remembers as many steps as the recording takes
    back.
    """
    header = recording.header
    painting = first_painting(header if seed is None else replace(header, seed=seed))
    history_bytes = memory.history_share() if history_bytes is None else history_bytes
    history = History(history_bytes, undo_reach(recording.commands, STEPS))
    return Session(painting, cache, folder=recording.folder, history=history, extra=header.extra)


def replay(
    recording: Recording,
    cache: TileCache | None = None,
    seed: int | None = None,
    tell: Callable[[int], object] = lambda done: None,
) -> Session:
    """Returns the session after all commands.  `seed`: in place of the header's; `tell` hears how many are done.

    FileError names the line of a command that cannot be done.
    """
    session, fault = replay_torn(recording, cache, seed, tell)
    if fault is not None:
        raise fault
    return session


def replay_torn(
    recording: Recording,
    cache: TileCache | None = None,
    seed: int | None = None,
    tell: Callable[[int], object] = lambda done: None,
    pictures: Mapping[str, ImageSource] = NO_PICTURES,
) -> tuple[Session, FileError | None]:
    """Returns the session after all commands up to the first that cannot be done, and what is wrong with that.

    As `replay`; `pictures`: what definitions may name by their sha, wherever their files are now.
    """
    session = opened(recording, cache, seed, history_bytes=0)
    session.pictures = pictures
    for i, command in enumerate(recording.commands):
        try:
            session.do(command)
        except (Refusal, FileError) as error:
            return session, recording.fault(i, str(error))
        tell(i + 1)
    return session, None


def stays_within(commands: Sequence[c.Command]) -> bool:
    """Tells whether commands take back and do again nothing but their own steps: no undo goes behind them, no redo does
    what was undone before them."""
    done = undone = 0
    for command in commands:
        if isinstance(command, c.Undo):
            done, undone = done - command.count, undone + command.count
        elif isinstance(command, c.Redo):
            done, undone = done + command.count, undone - command.count
        elif type(command) in STEPS:
            done, undone = done + 1, 0
        if done < 0 or undone < 0:
            return False
    return True
