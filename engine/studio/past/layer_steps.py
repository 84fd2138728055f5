"""Which layer one paints on after steps that add, copy or remove one were taken back, or done again."""

from __future__ import annotations

from engine.painting import commands as c
from engine.session.session import Session


def layer_after(session: Session, command: c.Undo | c.Redo) -> str | None:
    """Returns the layer that was the active one at the far end of the steps that a command goes over, if those changed
    it and nobody chose another since; else the one that is active now.  Recordings have it told: undo and redo alone
    leave the active layer as it is."""
    undoes, history = isinstance(command, c.Undo), session.history.steps
    steps = (history.done if undoes else history.undone)[::-1][: command.count]
    active = session.painting.active
    for step in steps:
        near, far = (step.after, step.before) if undoes else (step.before, step.after)
        active = far.active if active == near.active else active
    return active
