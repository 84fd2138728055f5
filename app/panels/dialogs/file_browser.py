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
from app.actions.binding import BringKeys
from app.desk.desk import Desk
from app.desk.examples import example_work
from app.desk.exporting.export_areas import export_wish
from app.desk.exporting.export_state import EXPORT_FORMATS
from app.desk.folders import A_FILE, A_FOLDER, LookAt, ReadFolder
from app.desk.holding.palette_making import palette_of_file
from app.desk.holding.palette_shelf import PALETTES, WritePalette, bring_palette, palette_to_write
from app.desk.keys.kept_keys import GiveKeys
from app.desk.outside import bringing, pictured
from app.desk.outside.opened_files import OF_PAINTINGS
from app.desk.preferring.preferring import keep_preferences, prefer
from app.desk.presets import stem_of
from app.desk.previews import FileRow
from app.desk.proofing.proof_work import PROFILES
from app.desk.sharing.preset_work import BRUSH, BRUSHES, SharePreset, bring_preset
from app.desk.solids.cube_work import CUBES, DRAWABLE, bring_cube
from app.desk.workshop.workshop_work import TEXT, TEXTS, ReadText, keep_text, text_stem
from app.language import said
from app.panels.controls import widgets as w
from app.panels.dialogs import file_list
from engine.studio.filing.film_requests import MakeFilm

OPENS = (".ora", ".png", ".jpg", ".jpeg", ".tif", ".tiff", ".jsonl")
_PICTURES = (".png", ".jpg", ".jpeg", ".tif", ".tiff")
_MESHES = (".obj", ".stl", ".glb")
_BROUGHT = (*_PICTURES, ".exr", ".ora", ".psd", ".psb")
SAVES = (".ora",)
FILMS = (".mp4", ".webm", ".webp", ".avif", ".gif", ".png")
EXPORTS = (".png", ".tif", ".exr")
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
        said.text_unformatted("Choose a file in the other window")
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
        self._folder, self._name = (start.parent, start.name) if saving else (start, "")
        self._rows: tuple[FileRow, ...] = ()
        self._wanted: Path | None = self._folder  # a folder that is to be listed
        self._fault, self._focus = "", True
        self._sure: Path | None = None  # a file that is replaced if it is chosen again
        self._chosen: Path | None = None  # what is being looked at, before it is handed on
        self._leads: str | None = None  # to what it does, as soon as that is known

    def _go(self, folder: Path) -> None:
        """Lists a folder as soon as it is read."""
        self._wanted = folder

    def _listed(self, folder: Path, rows: tuple[FileRow, ...], fault: str) -> None:
        """Hears what is in a folder."""
        self._fault, self._sure = fault, None
        if not fault:
            self._folder, self._rows = folder.absolute(), rows

    def draw(self, desk: Desk) -> bool:
        """Draws the folders and files, the name and the buttons; False when it is done."""
        if self._wanted is not None:
            desk.work(ReadFolder(self._wanted, self._endings, self._listed))
            self._wanted = None
        if self._chosen is not None and self._leads is not None and not self._decided(desk, self._chosen, self._leads):
            return False
        em = imgui.get_font_size()
        self._path_row(em)
        imgui.push_style_color(imgui.Col_.child_bg, theme.vec(theme.look.field))
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
        sure = self._sure is not None and self._sure == self._ended(self._folder / self._name)
        word = "Replace" if sure else "Save" if self._saving else "Open"
        hint = f"{word} this file"
        if w.default_button(f"{word}###go", hint, enabled=bool(self._name), width=em * 6) or picked:
            self._choose(desk, self._folder / self._name)
        imgui.same_line()
        if w.text_button("Cancel", "Go back", width=em * 6):
            desk.asked.give_up()
            return False
        if self._fault:
            said.text_colored(theme.vec(theme.look.warn), self._fault)
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
        said.text_disabled(text if len(text) < 64 else "…" + text[-62:])

    def _entries(self, desk: Desk) -> bool:
        """Lists the folder; True when a file was chosen by a double click, both clicks on the same."""
        row = file_list.draw(desk, self._folder, self._rows, self._name)
        if row is None:
            return False
        if row.folder:
            self._go(self._folder / row.name)
            return False
        again, self._name = row.name == self._name, row.name
        return again and imgui.is_mouse_double_clicked(0)

    def _ended(self, path: Path) -> Path:
        """Returns a path; where a file is saved, with one of its endings."""
        ends = not self._saving or path.suffix.lower() in self._endings
        return path if ends else path.parent / (path.name + self._endings[0])

    def _choose(self, desk: Desk, path: Path) -> None:
        """Has a path looked at, beside the window: what is typed may be a folder, and its disk may not answer."""
        self._chosen, self._leads, self._fault = path, None, ""
        desk.work(LookAt(path, self._seen))

    def _seen(self, path: Path, leads: str) -> None:
        """Hears to what a path leads."""
        if path == self._chosen:
            self._leads = leads

    def _decided(self, desk: Desk, chosen: Path, leads: str) -> bool:
        """Opens a folder, tells what is wrong, or hands the path on: then False, the dialog is done."""
        self._leads, path = None, self._ended(chosen)
        if leads == A_FOLDER:
            self._go(chosen)
            self._name = ""
        elif path != chosen:
            self._choose(desk, path)
        elif self._saving and leads == A_FILE and self._sure != path:
            self._sure, self._fault = path, f"{path.name} exists: press again to replace it"
        elif not self._saving and leads != A_FILE:
            self._fault = f"{path.name}: there is no such file"
        else:
            self._then(desk, path)
            return False
        return True


def _chooser(
    desk: Desk, title: str, endings: tuple[str, ...], then: Then, name: str | None = None
) -> SystemDialog | Browser:
    """Returns what asks for a file to read, or where to write one that is called `name` at first."""

    def chosen(desk: Desk, path: Path) -> None:
        desk.opened.folders[title] = path.parent
        if title in OF_PAINTINGS:
            desk.opened.folder = path.parent
        then(desk, path)

    make, folder = SystemDialog if has_system_dialogs() else Browser, desk.opened.begin(title, desk.known.path)
    return make(title, folder if name is None else folder / name, endings, name is not None, chosen)


def opening(desk: Desk) -> SystemDialog | Browser:
    """Asks for a file to open."""
    return _chooser(desk, "Open", OPENS, Desk.open)


def saving(desk: Desk) -> SystemDialog | Browser:
    """Asks where to save the painting."""
    return _chooser(desk, "Save as", SAVES, Desk.save, f"{desk.known.stem}.ora")


def exporting(desk: Desk) -> SystemDialog | Browser:
    """Asks where to export the picture."""
    ending = EXPORT_FORMATS[desk.export.format].ending
    name, endings = f"{desk.known.stem}{ending}", (ending, *(e for e in EXPORTS if e != ending))
    return _chooser(desk, "Export picture", endings, lambda d, path: d.post(export_wish(d, path)), name)


def filming(desk: Desk) -> SystemDialog | Browser:
    """Asks where to write a film."""
    stem = desk.known.path.stem if desk.known.path else "untitled"
    wish = desk.asked.film.wished
    assert wish is not None
    return _chooser(desk, "Film", FILMS, lambda d, path: d.post(MakeFilm(path, wish)), f"{stem}.mp4")


def choosing_spectrum(desk: Desk) -> SystemDialog | Browser:
    """Asks for a picture to begin a spectrum with."""

    def choose(d: Desk, path: Path) -> None:
        d.lab.change(shapes=(Map({"shape": "image", "path": str(path.absolute())}),))

    return _chooser(desk, "Begin with a picture's spectrum", _PICTURES, choose)


def choosing_example(index: int) -> Callable[[Desk], SystemDialog | Browser]:
    """For the first example of a match, or the second."""

    def choose(d: Desk, path: Path) -> None:
        d.match.show_file(index, path)

    return lambda desk: _chooser(desk, "Make a texture like a picture", _PICTURES, choose)


def choosing_own(desk: Desk) -> SystemDialog | Browser:
    """For an example of the artist's own."""
    return _chooser(desk, "Add an example", _PICTURES, example_work.add)


def choosing_texture(desk: Desk) -> SystemDialog | Browser:
    """Asks for a picture to paint with."""
    return _chooser(desk, "Paint with a picture", _PICTURES, pictured.from_file)


def choosing_text(desk: Desk) -> SystemDialog | Browser:
    """Asks for a texture that was written."""
    return _chooser(desk, "Open a written texture", TEXTS, lambda d, path: d.work(ReadText(path)))


def writing_text(desk: Desk) -> SystemDialog | Browser:
    """Asks where to write the texture that is in the workshop, for others."""
    name = f"{text_stem(desk.workshop.name)}{TEXT}"
    return _chooser(desk, "Share a written texture", (TEXT,), keep_text, name)


def choosing_mesh(desk: Desk) -> SystemDialog | Browser:
    """Asks for a mesh to show a solid on."""

    def choose(d: Desk, path: Path) -> None:
        d.solid.name = str(path.absolute())

    return _chooser(desk, "Show a solid on a mesh", _MESHES, choose)


def choosing_cube(desk: Desk) -> SystemDialog | Browser:
    """Asks for a picture from which a solid grows, or a file that holds a cube."""
    return _chooser(desk, "A solid like a picture, or a cube", CUBES, bring_cube)


def choosing_drawn_cube(desk: Desk) -> SystemDialog | Browser:
    """A picture that is drawn out into a solid."""
    return _chooser(desk, "A solid drawn out of a picture", DRAWABLE, lambda d, path: bring_cube(d, path, drawn=True))


def choosing_wrapped(desk: Desk) -> SystemDialog | Browser:
    """A picture that goes around the object."""
    return _chooser(desk, "A picture that tiles, around the object", DRAWABLE, lambda d, path: d.solid.wrap(str(path)))


def choosing_to_bring(desk: Desk) -> SystemDialog | Browser:
    """Asks for a picture, or a file of layers, to bring into the painting, in the middle of what is seen."""
    return _chooser(desk, "Bring in a picture", _BROUGHT, bringing.offer)


def sharing_brush(desk: Desk) -> SystemDialog | Browser:
    """Asks where to write a brush that is shared."""
    preset = desk.asked.brush
    assert preset is not None
    name = f"{stem_of(preset.name)}{BRUSH}"
    return _chooser(desk, "Share a brush", (BRUSH,), lambda d, path: d.work(SharePreset(preset, path)), name)


def choosing_brush(desk: Desk) -> SystemDialog | Browser:
    """Asks for a brush that somebody shared, or another program's."""
    return _chooser(desk, "Bring in a brush", BRUSHES, bring_preset)


def choosing_palette(desk: Desk) -> SystemDialog | Browser:
    """Asks for a palette."""
    return _chooser(desk, "Bring in a palette", PALETTES, bring_palette)


def choosing_palette_picture(desk: Desk) -> SystemDialog | Browser:
    """Asks for a picture to make a palette of."""
    return _chooser(desk, "Make a palette of a picture", _PICTURES, palette_of_file)


def writing_palette(desk: Desk) -> SystemDialog | Browser:
    """Asks where to write the palette that is shown."""
    palette = palette_to_write(desk)
    name = f"{stem_of(palette.name)}.gpl"
    return _chooser(desk, "Write a palette", (".gpl",), lambda d, path: d.work(WritePalette(palette, path)), name)


def choosing_profile(member: str) -> Callable[[Desk], SystemDialog | Browser]:
    """Returns what asks for the profile that a member of the preferences names."""

    def chosen(desk: Desk, path: Path) -> None:
        prefer(desk, **{member: str(path.absolute())})
        keep_preferences(desk, desk.preferred.now)
        desk.asked.show("preferences")

    return lambda desk: _chooser(desk, "Choose a profile", PROFILES, chosen)


def choosing_keys(desk: Desk) -> SystemDialog | Browser:
    """Asks for a map of keys."""
    return _chooser(desk, "Bring in keys", (".json",), lambda d, path: d.work(BringKeys(path)))


def writing_keys(desk: Desk) -> SystemDialog | Browser:
    """Asks where to write the artist's keys."""
    bound = desk.keys.bound
    return _chooser(desk, "Give keys away", (".json",), lambda d, path: d.work(GiveKeys(bound, path)), "keys.json")
