"""Choosing files: the system's own dialogs where there are any, else a small browser."""

from __future__ import annotations

import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from imgui_bundle import ImVec2, imgui
from imgui_bundle import portable_file_dialogs as pfd
from immutables import Map

from app import icons, theme
from app.desk import pictured
from app.desk.desk import Desk
from app.desk.examples import example_work
from app.desk.folders import ReadFolder
from app.desk.previews import FileRow
from app.panels.controls import widgets as w
from app.panels.dialogs import file_list
from engine.studio.filing.film_requests import MakeFilm
from engine.studio.requests import Export, Save

OPENS = (".ora", ".png", ".jpg", ".jpeg", ".tif", ".tiff", ".jsonl")
_PICTURES = (".png", ".jpg", ".jpeg", ".tif", ".tiff")
SAVES = (".ora",)
FILMS = (".mp4", ".webm", ".webp", ".avif", ".gif", ".png")
EXPORTS = (".png", ".tif")
Then = Callable[[Desk, Path], None]


def has_system_dialogs() -> bool:
    """portable_file_dialogs needs a program on Linux and silently answers nothing without one."""
    return not sys.platform.startswith("linux") or any(shutil.which(p) for p in ("zenity", "kdialog", "matedialog"))


class SystemDialog:
    """A dialog of the system in its own process; looked at once a frame."""

    def __init__(self, title: str, start: Path, endings: tuple[str, ...], saving: bool, then: Then) -> None:
        self.title, self._then, self._saving, self._endings = title, then, saving, endings
        filters = [title, " ".join(f"*{e}" for e in endings), "All files", "*"]
        make: Any = pfd.save_file if saving else pfd.open_file
        self._dialog = make(title, str(start), filters)

    def draw(self, desk: Desk) -> bool:
        """Draws it into the present window."""
        imgui.text_unformatted("Choose a file in the other window")
        if not self._dialog.ready(0):
            return True
        result = self._dialog.result()
        name = result if isinstance(result, str) else (result[0] if result else "")
        if name:
            path = Path(name)
            if self._saving and path.suffix.lower() not in self._endings:
                path = path.with_name(path.name + self._endings[0])
            self._then(desk, path)
        else:
            desk.asked.give_up()
        return False


class Browser:
    """Folders and files with certain endings, with their sizes, dates and pictures; a field for the name."""

    def __init__(self, title: str, start: Path, endings: tuple[str, ...], saving: bool, then: Then) -> None:
        self.title, self._endings, self._saving, self._then = title, endings, saving, then
        self._folder = start if start.is_dir() else start.parent
        self._name = "" if start.is_dir() else start.name
        self._rows: tuple[FileRow, ...] = ()
        self._wanted: Path | None = self._folder  # a folder that is to be listed
        self._fault, self._focus, self._sure = "", True, False

    def _go(self, folder: Path) -> None:
        """Lists a folder as soon as it is read."""
        self._wanted = folder

    def _listed(self, folder: Path, rows: tuple[FileRow, ...], fault: str) -> None:
        """Hears what is in a folder."""
        self._fault, self._sure = fault, False
        if not fault:
            self._folder, self._rows = folder.absolute(), rows

    def draw(self, desk: Desk) -> bool:
        """Draws the folders and files, the name and the buttons; False when it is done."""
        if self._wanted is not None:
            desk.work(ReadFolder(self._wanted, self._endings, self._listed))
            self._wanted = None
        em = imgui.get_font_size()
        self._path_row(em)
        imgui.push_style_color(imgui.Col_.child_bg, theme.vec(theme.FIELD))
        imgui.begin_child("entries", ImVec2(em * 42, em * 25))
        picked = self._entries(desk)
        imgui.end_child()
        imgui.pop_style_color()
        imgui.set_next_item_width(imgui.get_content_region_avail().x - 2 * (em * 6 + imgui.get_style().item_spacing.x))
        if self._focus and not w.return_down():  # a key that still is would take it away again
            imgui.set_keyboard_focus_here()
            self._focus = False
        _, self._name = imgui.input_text("##name", self._name)
        w.named("name")
        w.tooltip("The file’s name")
        imgui.same_line()
        return self._buttons(desk, em, picked)

    def _buttons(self, desk: Desk, em: float, picked: bool) -> bool:
        """Draws them; False when the dialog is done."""
        word = "Replace" if self._sure else "Save" if self._saving else "Open"
        hint = f"{word} this file"
        if w.default_button(f"{word}###go", hint, enabled=bool(self._name), width=em * 6) or picked:
            return self._choose(desk)
        imgui.same_line()
        if w.text_button("Cancel", "Go back", width=em * 6):
            desk.asked.give_up()
            return False
        if self._fault:
            imgui.text_colored(theme.vec(theme.WARN), self._fault)
        return True

    def _path_row(self, em: float) -> None:
        if w.icon_button("home", icons.HOME, "Your own folder"):
            self._go(Path.home())
        imgui.same_line()
        if w.icon_button("up", icons.UP, "The folder around this one"):
            self._go(self._folder.parent)
        imgui.same_line()
        imgui.align_text_to_frame_padding()
        text = str(self._folder)
        imgui.text_disabled(text if len(text) < 64 else "…" + text[-62:])

    def _entries(self, desk: Desk) -> bool:
        """Lists the folder; True when a file was chosen by a double click, both clicks on the same."""
        row = file_list.draw(desk, self._folder, self._rows, self._name)
        if row is None:
            return False
        if row.folder:
            self._go(self._folder / row.name)
            return False
        again, self._name = row.name == self._name, row.name
        self._sure = self._sure and again
        return again and imgui.is_mouse_double_clicked(0)

    def _choose(self, desk: Desk) -> bool:
        """Hands the path on; False when the dialog is done."""
        path = self._folder / self._name
        if path.is_dir():
            self._go(path)
            self._name = ""
            return True
        if self._saving and path.suffix.lower() not in self._endings:
            path = path.with_name(path.name + self._endings[0])
        if self._saving and path.exists() and not self._sure:
            self._sure, self._fault = True, f"{path.name} exists: press again to replace it"
            return True
        if not self._saving and not path.is_file():
            self._fault = f"{path.name}: there is no such file"
            return True
        self._then(desk, path)
        return False


def _chooser(title: str, start: Path, endings: tuple[str, ...], saving: bool, then: Then) -> SystemDialog | Browser:
    make = SystemDialog if has_system_dialogs() else Browser
    return make(title, start, endings, saving, then)


def _folder(desk: Desk) -> Path:
    return desk.known.path.parent if desk.known.path else Path.cwd()


def opening(desk: Desk) -> SystemDialog | Browser:
    """Asks for a file to open."""
    return _chooser("Open", _folder(desk), OPENS, False, Desk.open)


def saving(desk: Desk) -> SystemDialog | Browser:
    """Asks where to save the painting."""
    return _chooser(
        "Save as", _folder(desk) / f"{desk.known.stem}.ora", SAVES, True, lambda d, path: d.post(Save(path))
    )


def exporting(desk: Desk) -> SystemDialog | Browser:
    """Asks where to export the picture."""
    start, level = _folder(desk) / f"{desk.known.stem}.png", desk.asked.export_level
    return _chooser("Export picture", start, EXPORTS, True, lambda d, path: d.post(Export(path, level)))


def filming(desk: Desk) -> SystemDialog | Browser:
    """Asks where to write a film."""
    stem = desk.known.path.stem if desk.known.path else "untitled"
    start, wish = _folder(desk) / f"{stem}.mp4", desk.asked.film.wished
    assert wish is not None
    return _chooser("Film", start, FILMS, True, lambda d, path: d.post(MakeFilm(path, wish)))


def choosing_spectrum(desk: Desk) -> SystemDialog | Browser:
    """Asks for a picture to begin a spectrum with."""

    def choose(d: Desk, path: Path) -> None:
        d.lab.change(shapes=(Map({"shape": "image", "path": str(path.absolute())}),))

    return _chooser("Begin with a picture's spectrum", _folder(desk), _PICTURES, False, choose)


def choosing_example(index: int) -> Callable[[Desk], SystemDialog | Browser]:
    """For the first example of a match, or the second."""

    def choose(d: Desk, path: Path) -> None:
        d.match.show_file(index, path)

    return lambda desk: _chooser("Make a texture like a picture", _folder(desk), _PICTURES, False, choose)


def choosing_own(desk: Desk) -> SystemDialog | Browser:
    """For an example of the artist's own."""
    return _chooser("Add an example", _folder(desk), _PICTURES, False, example_work.add)


def choosing_texture(desk: Desk) -> SystemDialog | Browser:
    """Asks for a picture to paint with."""
    return _chooser("Paint with a picture", _folder(desk), _PICTURES, False, pictured.from_file)
