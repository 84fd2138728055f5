"""Thumbnails of examples, made on a thread of their own: each is cut out by its region and lies on paper; and the
pictures that maps of theirs are.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from contextlib import suppress
from functools import partial

import numpy as np

from app.desk.examples import own_example_files
from app.desk.examples.charts import chart_of
from app.desk.examples.example_state import Entry
from app.desk.previews import InTurn
from engine.files.fault import FileError
from engine.studio.results import Picture

PAPER = (214, 209, 200)  # sRGB
MARGIN = 0.06  # of a thumbnail's side
LARGE = 104.0  # its side where there is room, points


def ident(entry: Entry) -> str:
    """Returns what its picture is called."""
    return f"example {entry.ident}"


def map_path(told: object) -> str:
    """Returns the path of the picture that a map is, as a definition tells it; empty if it is none."""
    path = chart_of(told).get("path", "")
    return path if isinstance(path, str) else ""


def map_ident(path: str) -> str:
    """Returns what the picture of a map is called."""
    return f"map {path}"


def side(scale: float) -> int:
    """Returns the side of a thumbnail, pixels, where a point is `scale` of them."""
    return round(LARGE * scale)


class Shelf:
    """`wake` is called from the thread when a picture is ready."""

    def __init__(self, wake: Callable[[], None]) -> None:
        self._wake = wake
        self._made: InTurn[Callable[[], Picture]] = InTurn("inkfall thumbnails", self._make)
        self._ready: deque[Picture] = deque()
        self._known: dict[str, tuple[str, int]] = {}

    def ask(self, entries: tuple[Entry, ...], side: int) -> None:
        """Has thumbnails made of those with files that have none, or none of that size, or another region by now; and
        their maps read that are pictures, once."""
        wanted: list[Callable[[], Picture]] = []
        for entry in (entry for entry in entries if entry.here is None):
            state = entry.mask_sha, side
            if self._known.get(entry.ident) != state:
                self._known[entry.ident] = state
                wanted.append(partial(_seen, entry, side))
            for path in map(map_path, entry.maps.values()):
                if path and map_ident(path) not in self._known:
                    self._known[map_ident(path)] = "", 0
                    wanted.append(partial(_map_seen, path))
        self._made.want(wanted)

    def take(self) -> list[Picture]:
        """Returns what is ready."""
        found = []
        while self._ready:
            found.append(self._ready.popleft())
        return found

    @property
    def busy(self) -> bool:
        """Tells whether pictures are made, or to be taken."""
        return self._made.busy or bool(self._ready)  # in this order: what is made is ready then

    def _make(self, make: Callable[[], Picture]) -> None:
        with suppress(FileError, OSError):  # a picture that cannot be read has no thumbnail
            self._ready.append(make())
            self._wake()


def _seen(entry: Entry, side: int) -> Picture:
    return Picture(ident(entry), thumbnail(entry, side))


def _map_seen(path: str) -> Picture:
    """Returns the picture of a map as dark and light as it tells."""
    from engine.files.images import read_image  # on the thread: it loads what compiles

    pixels, _ = read_image(path)
    full = int(np.iinfo(pixels.dtype).max)
    out = np.full(pixels.shape, 255, np.uint8)
    out[..., :3] = (pixels[..., :3].astype(np.int64).sum(axis=-1) * 255 // (3 * full))[..., None]
    return Picture(map_ident(path), out)


def thumbnail(entry: Entry, side: int) -> np.ndarray:
    """Returns an example's region on paper, uint8 RGBA (side, side, 4), opaque."""
    from PIL import Image  # here: it takes its time to load

    pixels, inside = own_example_files.cut_out(entry)
    alpha = (pixels[..., 3:] * inside[..., None]).astype(np.uint32)
    flat = ((pixels[..., :3] * alpha + np.array(PAPER, np.uint32) * (255 - alpha) + 127) // 255).astype(np.uint8)
    rows, columns = (np.flatnonzero(inside.any(axis=axis)) for axis in (1, 0))
    if rows.size:
        flat = flat[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]
    room = side * (1 - 2 * MARGIN)
    scale = min(room / flat.shape[1], room / flat.shape[0])
    size = max(1, round(flat.shape[1] * scale)), max(1, round(flat.shape[0] * scale))
    small = np.asarray(Image.fromarray(flat).resize(size, Image.Resampling.LANCZOS))
    out = np.empty((side, side, 4), np.uint8)
    out[...] = (*PAPER, 255)
    top, left = (side - size[1]) // 2, (side - size[0]) // 2
    out[top : top + size[1], left : left + size[0], :3] = small
    return out
