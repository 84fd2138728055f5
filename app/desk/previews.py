"""Small pictures of files, made on a thread of their own."""

from __future__ import annotations

import io
import threading
from collections import deque
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Generic, NamedTuple, TypeVar

import numpy as np

from engine.studio.results import Picture

_Job = TypeVar("_Job")
_MOST = 100_000_000  # pixels of a picture that is made small
MOST_BYTES = 4 << 20  # of the small picture in a painting
PAPER, FIELD = (244, 244, 244, 255), (29, 29, 29, 255)  # sRGB: below pictures with holes, and around them
OF_HEIGHTS = (".exr",)  # files of heights
PAINTING, PHOTOSHOP, PICTURES = ".ora", (".psd", ".psb"), (".png", ".jpg", ".jpeg", ".tif", ".tiff")


class FileRow(NamedTuple):
    """A file or a folder in a list.  `size`: bytes; `changed`: when, nanoseconds since 1970; `date`: that, local."""

    name: str
    folder: bool
    size: int = 0
    changed: int = 0
    date: str = ""


def ident(folder: Path, row: FileRow) -> str:
    """Returns what its picture is called: otherwise once the file has changed."""
    return f"file {folder / row.name} {row.changed} {row.size}"


class InTurn(Generic[_Job]):
    """Jobs that a thread does one after another: it begins when there are some, and ends when there are none.  `do` is
    called on it, and it has this `name`; all else comes from the window's thread."""

    def __init__(self, name: str, do: Callable[[_Job], None]) -> None:
        self._name, self._do = name, do
        self._lock = threading.Lock()  # for moments: of the jobs, and of whether the thread looks for one more
        self._jobs: deque[_Job] = deque()
        self._looks = False
        self.thread: threading.Thread | None = None

    def want(self, jobs: Iterable[_Job], instead: bool = False) -> None:
        """Has jobs done after those that wait, or `instead` of them."""
        with self._lock:
            if instead:
                self._jobs.clear()
            self._jobs.extend(jobs)
            if self._jobs and not self.busy:
                self._looks = True
                self.thread = threading.Thread(target=self._work, name=self._name, daemon=True)
                self.thread.start()

    @property
    def busy(self) -> bool:
        """Tells whether jobs are done, or wait."""
        return self._looks and self.thread is not None and self.thread.is_alive()

    def _work(self) -> None:
        while (found := self._taken()) is not None:
            self._do(found)

    def _taken(self) -> _Job | None:
        with self._lock:
            self._looks = bool(self._jobs)
            return self._jobs.popleft() if self._jobs else None


class Previews:
    """Makes the pictures asked for last.  `wake` is called from the thread when one is ready; one that cannot be made
    never comes.  All other calls come from the window's thread."""

    def __init__(self, wake: Callable[[], None]) -> None:
        self._wake = wake
        self._made: InTurn[tuple[str, Path, int]] = InTurn("inkfall previews", self._make)
        self._ready: deque[Picture] = deque()
        self._begun: set[str] = set()

    def ask(self, folder: Path, rows: Iterable[FileRow], side: int) -> None:
        """Has pictures of files in a folder made, at most `side` pixels wide and high; in place of those asked for
        before that are not begun."""
        files = [row for row in rows if row.name.lower().endswith((PAINTING, *PHOTOSHOP, *PICTURES))]
        wanted = [(ident(folder, row), folder / row.name, side) for row in files]
        self._made.want([one for one in wanted if one[0] not in self._begun], instead=True)

    def take(self) -> list[Picture]:
        """Returns what is ready."""
        return [self._ready.popleft() for _ in range(len(self._ready))]

    @property
    def busy(self) -> bool:
        """Tells whether pictures are made, or to be taken."""
        return self._made.busy or bool(self._ready)  # in this order: what is made is ready then

    def _make(self, wanted: tuple[str, Path, int]) -> None:
        name, path, side = wanted
        if name not in self._begun:
            self._begun.add(name)
            small = small_picture(path, side)
            if small is not None:
                self._ready.append(Picture(name, small))
                self._wake()


def small_picture(path: Path, side: int) -> np.ndarray | None:
    """Returns a file's picture on paper in the middle of a field, uint8 RGBA (side, side, 4), opaque; None if it has
    none, or one that is damaged or too large."""
    from PIL import Image  # here: it takes its time to load

    try:
        with Image.open(io.BytesIO(_thumbnail(path)) if path.suffix.lower() == PAINTING else path) as picture:
            if picture.width * picture.height > _MOST:
                return None
            picture.draft("RGB", (2 * side, 2 * side))  # a JPEG is read small
            picture.thumbnail((side, side), reducing_gap=2.0)
            small = picture.convert("RGBA")
    except Exception:  # Pillow raises many kinds for damaged files
        return None
    out = Image.new("RGBA", (side, side), FIELD)
    at = (side - small.width) // 2, (side - small.height) // 2
    out.paste(Image.alpha_composite(Image.new("RGBA", small.size, PAPER), small), at)
    return np.array(out)


def _thumbnail(path: Path) -> bytes:
    from engine.archive.saving import THUMB  # here: the window is up before the engine is loaded
    from engine.files.zip_reader import ZipArchive

    with path.open("rb") as file:
        return ZipArchive(file, path.name).read(THUMB, MOST_BYTES)
