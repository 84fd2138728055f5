"""Pictures on the system's clipboard, through copykitten; read and written on the thread for files.

copykitten speaks to X11, Wayland, Windows and macOS by itself; Pillow needs other programs for that, and only reads.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import platformdirs

from app.canvas.view import Place
from app.desk.desk import Desk, FileWork
from app.desk.outside import bringing, copied_parts
from engine.studio.copy_records import Copied, CopyPicture

_KEPT = 8  # files of pictures that were pasted


def _folder() -> Path:
    return platformdirs.user_state_path("inkfall") / "pasted"


@dataclass(frozen=True, slots=True)
class _Paste(FileWork):
    place: Place
    mark: str = ""  # that was put there when something was copied here

    def carry_out(self) -> tuple[Path, tuple[int, int]] | None:
        import copykitten  # here: it takes its time to load

        from engine.files.atomic import replacing
        from engine.files.fault import FileError
        from engine.files.png_writer import write_png

        if self.mark and _text() == self.mark:
            return None
        try:
            data, width, height = copykitten.paste_image()
        except copykitten.CopykittenError as error:
            raise FileError("clipboard", "found no picture on it, expected one") from error
        path = _folder() / f"Pasted {hashlib.sha256(data).hexdigest()[:8]}.png"
        path.parent.mkdir(parents=True, exist_ok=True)
        with replacing(path) as file:
            write_png(file, np.frombuffer(data, np.uint8).reshape(height, width, 4))
        for old in sorted(path.parent.glob("*.png"), key=lambda one: one.stat().st_mtime)[:-_KEPT]:
            old.unlink()
        return path, (width, height)

    def arrive(self, desk: Desk, found: tuple[Path, tuple[int, int]] | None) -> None:
        if found is None:
            copied_parts.paste_part(desk)
            return
        bringing.lay(desk, found[0], "Pasted", found[1], self.place)


def paste(desk: Desk) -> None:
    """Lays what was copied last on a layer of its own: here, where it was; elsewhere, at the pointer, or in the middle
    of the view where that is not over the canvas."""
    copied, pointer = desk.selecting.copied, desk.pointer
    place = (pointer.x, pointer.y) if pointer.over_canvas else desk.middle()
    desk.work(_Paste(desk.view.to_canvas(*place), "" if copied is None else copied.mark))


def _text() -> str:
    """Returns the text on the clipboard; "" where there is none."""
    import copykitten

    try:
        return str(copykitten.paste())
    except copykitten.CopykittenError:
        return ""


@dataclass(frozen=True, slots=True, eq=False)
class _Copy(FileWork):
    pixels: np.ndarray

    def carry_out(self) -> None:
        import copykitten

        height, width = self.pixels.shape[:2]
        try:
            copykitten.copy_image(self.pixels.tobytes(), width, height)
        except copykitten.CopykittenError as error:
            raise OSError(f"the clipboard cannot be written: {error}") from error

    def arrive(self, desk: Desk, found: None) -> None:
        height, width = self.pixels.shape[:2]
        desk.say(f"Copied {width} × {height} pixels")


def ask_copy(desk: Desk) -> None:
    """Asks for the frame, as it would be exported, which goes to the clipboard as soon as it is there."""
    desk.post(CopyPicture(0, desk.known.frame))


def give_away(desk: Desk, told: Copied, _now: float) -> None:
    """Puts a picture on the clipboard."""
    desk.work(_Copy(told.pixels))
