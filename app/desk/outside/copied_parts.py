"""What is selected of a layer, copied within the program: exact, with its ink.

The painting holds it; a line of text on the system's clipboard tells whether it is what was copied last.
"""

from __future__ import annotations

import secrets
from dataclasses import dataclass

from app.desk.desk import Desk, FileWork
from app.desk.naming import free_name
from app.desk.selecting.select_state import CopiedHere
from engine.painting.layering.paste_commands import CopyPaint, CutPaint, PastePaint
from engine.studio.requests import Do


@dataclass(frozen=True, slots=True)
class _Mark(FileWork):
    text: str

    def carry_out(self) -> None:
        import copykitten  # here: it takes its time to load

        try:
            copykitten.copy(self.text)
        except copykitten.CopykittenError as error:
            raise OSError(f"the clipboard cannot be written: {error}") from error

    def arrive(self, desk: Desk, found: None) -> None:
        """Nothing: it is there."""


def _names(desk: Desk) -> set[str]:
    return {row.name for row in desk.known.scene.layers} if desk.known.scene else set()


def _hold(desk: Desk, way: type[CopyPaint | CutPaint]) -> None:
    row, scene = desk.known.active, desk.known.scene
    if row is None or scene is None:
        return
    copied = CopiedHere(scene.serial, f"Inkfall {secrets.token_hex(6)}")
    desk.post(Do(way(row.name)))
    desk.selecting.copied = copied
    desk.work(_Mark(copied.mark))
    what = "what is selected of " if desk.selecting.selected else ""
    desk.say(f"{'Cut' if way is CutPaint else 'Copied'} {what}“{row.name}”")


def copy_part(desk: Desk) -> None:
    """Copies what is selected of the layer that is chosen, all of it where nothing is: no step."""
    _hold(desk, CopyPaint)


def cut_part(desk: Desk) -> None:
    """Copies it likewise and takes it off the layer, as one step."""
    _hold(desk, CutPaint)


def paste_part(desk: Desk) -> None:
    """Lays what was copied here on a layer of its own, where it was."""
    copied, scene = desk.selecting.copied, desk.known.scene
    if copied is None or scene is None:
        desk.say("Nothing was copied yet", bad=True)
        return
    if copied.serial != scene.serial:
        desk.say("What was copied lies in another painting", bad=True)
        return
    desk.post(Do(PastePaint(free_name("Pasted", _names(desk)))))
