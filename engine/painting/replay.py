"""Replaying a recording: the same commands through the same session, so the same pixels."""

from __future__ import annotations

from collections.abc import Callable

from engine.canvas.evaluate import TileCache
from engine.painting.fault import FileError
from engine.painting.history import History
from engine.painting.painting import STEPS, Painting, Refusal
from engine.painting.recording import Recording, undo_reach
from engine.painting.session import Session


def opened(recording: Recording, cache: TileCache | None = None, seed: int | None = None) -> Session:
    """A session as the recording's header describes it, nothing done yet.  Undo remembers what the recording needs."""
    header = recording.header
    painting = Painting(header.frame, header.seed if seed is None else seed)
    history = History(steps_cap=undo_reach(recording.commands, STEPS))
    return Session(painting, cache, folder=recording.folder, history=history, extra=header.extra)


def replay(
    recording: Recording,
    cache: TileCache | None = None,
    seed: int | None = None,
    tell: Callable[[int], object] = lambda done: None,
) -> Session:
    """The session after all commands.  `seed`: in place of the header's; `tell` hears how many are done.

    FileError names the line of a command that cannot be done.
    """
    session = opened(recording, cache, seed)
    for i, command in enumerate(recording.commands):
        try:
            session.do(command)
        except (Refusal, FileError) as error:
            raise recording.fault(i, str(error)) from None
        tell(i + 1)
    return session
