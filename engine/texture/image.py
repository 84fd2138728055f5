"""Pictures as textures: an image tiles the plane and is refined, level by level, as far as its own pixels go.

Perlin & Velho 1995, section 7.1: a source image is a bandpass pyramid, built with toroidal ends so that its tiles join.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from typing import ClassVar, TypeGuard
from weakref import WeakValueDictionary

import numpy as np

from engine.numeric.address import Rect
from engine.numeric.detail import cut, parents, subtract_expanded
from engine.numeric.grid import snapped
from engine.numeric.memo import remembered
from engine.numeric.parted import Raster
from engine.numeric.pyramid import reduce
from engine.numeric.resample import resampled_rows
from engine.texture.lean_planes import LeanPlanes, lean_of
from engine.texture.raster import AT_ONCE, planes_of, row_bands, straight_of

_STRIP = 64  # narrower images are repeated to this width before they are laid out
_WHOLE = 16  # a picture enlarged beyond so many times its pixels is made piece by piece
_NARROW = 1 << 12  # pixels from which on a picture is held in as few bits as tell it
_BANDED = 1 << 20  # pixels from which on a picture is read and resampled part by part
_LARGE = 1 << 26  # pixels of a picture beyond which, as a texture, it is refined no further than to so many

Pixels = np.ndarray | Raster | LeanPlanes
_HELD: WeakValueDictionary[str, Pixels] = WeakValueDictionary()  # the pixels of pictures, by their hash


@dataclass(frozen=True, slots=True)
class ImageSource:
    """A picture: `pixels` its planes, float32 (4, h, w), premultiplied RGBA in 0..1, or what tells the same in fewer
    bits: a raster of 8 or 16, lean planes; None where only its name is known any more.

    Sources are equal when name and `sha` are: `sha` is the SHA-256 of the size and the planes, in hexadecimal.
    """

    name: str
    sha: str
    pixels: Pixels | None = field(default=None, compare=False, repr=False)

    @classmethod
    def of(cls, name: str, data: np.ndarray) -> ImageSource:
        """Makes the source of float32 (4, h, w), premultiplied, named by the hash of its pixels; those that are there
        already are shared.  ValueError for other arrays."""
        if data.ndim != 3 or data.shape[0] != 4 or data.dtype != np.float32 or not data.size:
            raise ValueError(f"image: found {data.dtype} {data.shape}, expected float32 (4, h, w)")
        data = np.ascontiguousarray(data)
        return cls(name, "", narrowed(data))._hashed()

    @classmethod
    def of_raster(cls, name: str, pixels: Raster) -> ImageSource:
        """Makes the source of straight RGBA, uint8 or uint16 (h, w, 4), as `put_plainly` leaves it."""
        height, width, _ = pixels.shape
        if height * width < _BANDED:
            return cls.of(name, planes_of(pixels[0:height, 0:width]))
        return cls(name, "", pixels)._hashed()

    def _hashed(self) -> ImageSource:
        """Returns it with its hash, and the pixels that are held of it already."""
        digest = hashlib.sha256(repr((4, self.height, self.width)).encode())
        for plane in range(4):
            for band in row_bands(self.width, self.height):
                digest.update(np.ascontiguousarray(self.planes(band)[plane], "<f4").data)
        sha = digest.hexdigest()
        held = _HELD.get(sha)
        if held is None and self.pixels is not None:
            held = _HELD[sha] = self.pixels
        return ImageSource(self.name, sha, held)

    @property
    def told_apart(self) -> tuple[str, str, bool]:
        """Tells it apart from others, without its pixels."""
        return self.name, self.sha, self.there

    @property
    def there(self) -> bool:
        """Tells whether its pixels are there."""
        return self.pixels is not None

    @property
    def data(self) -> np.ndarray | None:
        """Gives all planes, float32 (4, h, w): made anew of a picture that is held in fewer bits."""
        return self.pixels if self.pixels is None or _is_planes(self.pixels) else self.planes(self.whole)

    def planes(self, rect: Rect) -> np.ndarray:
        """Returns the planes of a part of the picture that is there: float32 (4, h, w), not to be written to."""
        assert self.pixels is not None
        if _is_planes(self.pixels):
            return self.pixels[:, rect.y0 : rect.y1, rect.x0 : rect.x1]
        if isinstance(self.pixels, LeanPlanes):
            return self.pixels.planes(rect)
        return planes_of(self.pixels[rect.y0 : rect.y1, rect.x0 : rect.x1])

    def rows(self, places: np.ndarray) -> np.ndarray:
        """Returns the planes of some rows, in rising order: float32 (4, places, w), contiguous."""
        assert self.pixels is not None
        if _is_planes(self.pixels):
            return np.ascontiguousarray(self.pixels[:, places])
        runs = np.split(places, np.flatnonzero(np.diff(places) != 1) + 1)
        parts = [self.planes(Rect(0, int(run[0]), self.width, int(run[-1]) + 1)) for run in runs]
        return parts[0] if len(parts) == 1 else np.concatenate(parts, axis=1)

    def straight(self) -> Raster | None:
        """Returns the pixels of 8, else of 16 bits that tell all that there is; None where neither does."""
        if isinstance(self.pixels, LeanPlanes):  # no raster tells them
            return None
        if self.pixels is None or not _is_planes(self.pixels):
            return self.pixels
        return straight_of(self.pixels + np.float32(0.0))  # which makes -0 to 0

    @property
    def whole(self) -> Rect:
        """Gives the rectangle of all its pixels."""
        return Rect(0, 0, self.width, self.height)

    @property
    def opaque(self) -> bool:
        """Tells whether alpha is 1 all over; False where the pixels are not there."""
        return self.there and _opaque(self)

    @property
    def width(self) -> int:
        """Gives the columns; 0 where the pixels are not there."""
        return 0 if self.pixels is None else self.pixels.shape[2 if _is_planes(self.pixels) else 1]

    @property
    def height(self) -> int:
        """Gives the rows; 0 where the pixels are not there."""
        return 0 if self.pixels is None else self.pixels.shape[1 if _is_planes(self.pixels) else 0]


def _is_planes(pixels: Pixels) -> TypeGuard[np.ndarray]:
    return not isinstance(pixels, LeanPlanes) and pixels.dtype == np.float32


def narrowed(data: np.ndarray) -> np.ndarray | LeanPlanes:
    """Returns planes, float32 (4, h, w), as the pixels of 8 or 16 bits that tell them, else as lean planes, where these
    do and there are not few."""
    if data[0].size < _NARROW:
        return data
    found = straight_of(data)
    return (lean_of(data) or data) if found is None else found


@remembered
def _opaque(source: ImageSource) -> bool:
    return all(bool((source.planes(band)[3] == 1.0).all()) for band in row_bands(source.width, source.height))


@dataclass(frozen=True, slots=True)
class _Picture:
    """`period`: the width of the picture in pixels of the base level; its height follows.

    The plane is tiled from pixel (0, 0) of the base level on.  A source without pixels is transparent everywhere.
    """

    base: int
    period: int
    source: ImageSource

    kind: ClassVar[str]
    shown: ClassVar[slice]  # the planes of RGBA that `appearance` gives
    refined: ClassVar[slice]  # and those that `bandpass` gives

    @property
    def key(self) -> tuple[object, ...]:
        return (self.kind, self.base, self.period, self.source.name, self.source.sha)

    @property
    def told_apart(self) -> tuple[object, ...]:
        """Tells it apart from others, without its pixels."""
        return (self.kind, self.base, self.period, self.source.told_apart)

    @property
    def refinements(self) -> int:
        """Tells how many levels finer than its base the picture has pixels for."""
        return 0 if not self.source.there else _refinements(self.source, self.period)

    def appearance(self, level: int, rect: Rect) -> np.ndarray:
        """Returns the picture over `rect`, float32; beyond its own pixels it is expanded."""
        if level < self.base:
            raise ValueError(f"{self.kind}: level {level} is coarser than the base level {self.base}")
        if not self.source.there:
            return np.zeros((4, rect.height, rect.width), np.float32)[self.shown]
        if level - self.base <= self.refinements:
            return self._own(level, rect, self.shown)
        even = rect.evened()
        coarse = self.appearance(level - 1, parents(even))
        out = np.zeros((coarse.shape[0], even.height, even.width), np.float32)
        subtract_expanded(out, coarse)
        result: np.ndarray = np.negative(cut(out, rect, even))
        return result

    def bandpass(self, level: int, rect: Rect) -> np.ndarray | None:
        """Returns what the picture's next finer level adds, float32."""
        if not 0 < level - self.base <= self.refinements or rect.empty:
            return None
        even = rect.evened()
        out = self._own(level, even, self.refined)
        if not subtract_expanded(out, self._own(level - 1, parents(even), self.refined)):
            return None
        inner = cut(out, rect, even)
        return inner if rect == even or inner.any() else None

    def _own(self, level: int, rect: Rect, planes: slice) -> np.ndarray:
        """Returns the picture at one of the levels for which it has pixels."""
        height, width = _base_size(self.source, self.period)
        if level > self.base or height * width <= _most(self.source):
            return tiled(picture_pyramid(self.source, self.period)[level - self.base][planes], rect)
        rows = rect.y0 % height + np.arange(rect.height)
        columns = rect.x0 % width + np.arange(rect.width)
        return stretched(self.source, (height, width), rows, columns)[planes]


@dataclass(frozen=True, slots=True)
class Image(_Picture):
    """The picture's colours: S is premultiplied RGBA (4, h, w), the bandpass red, green and blue (3, h, w)."""

    kind: ClassVar[str] = "image"
    shown: ClassVar[slice] = slice(0, 4)
    refined: ClassVar[slice] = slice(0, 3)

    @property
    def cover(self) -> _Picture | None:
        """Returns what the picture hides, for an ink that lies over another colour; None if it is opaque, and hides
        all."""
        return None if self.source.opaque else Cover(self.base, self.period, self.source)


@dataclass(frozen=True, slots=True)
class Cover(_Picture):
    """The picture's alpha: S and the bandpass (1, h, w)."""

    kind: ClassVar[str] = "cover"
    shown: ClassVar[slice] = slice(3, 4)
    refined: ClassVar[slice] = slice(3, 4)


def _base_size(source: ImageSource, period: int) -> tuple[int, int]:
    return max(1, round(period * source.height / source.width)), period


def _refinements(source: ImageSource, period: int) -> int:
    """Until the picture is no smaller than its source, or, for a sliver of a picture, several times as large."""
    height, width = _base_size(source, period)
    n = 0
    while (width << n < source.width or height << n < source.height) and (
        (width << n + 1) * (height << n + 1) <= _most(source)
    ):
        n += 1
    return n


def _most(source: ImageSource) -> int:
    """Returns how many pixels of a picture as a texture are made at once."""
    own = source.height * source.width
    return _WHOLE * own if own <= _LARGE else _LARGE


@remembered
def picture_pyramid(source: ImageSource, period: int) -> tuple[np.ndarray, ...]:
    """S of a picture from its base level on, each twice as large as the one before: float32 (4, h, w) on the grid.

    The base is `period` pixels wide.  The finest is the first that is no smaller than the picture: the picture
    resampled to it; every coarser one is the 2 x 2 mean of the next.
    """
    height, width = _base_size(source, period)
    n = _refinements(source, period)
    size = height << n, width << n
    levels = [stretched(source, size, np.arange(size[0]), np.arange(size[1]))]
    for _ in range(n):
        levels.append(reduce(levels[-1]))
    for level in levels:
        level.flags.writeable = False
    return tuple(reversed(levels))


def stretched(source: ImageSource, size: tuple[int, int], rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """Some pixels of a picture resampled to `size` (h, w): premultiplied RGBA that is valid, on the grid."""
    out = np.empty((4, rows.size, columns.size), np.float32)
    old = source.height, source.width
    count = rows.size if old[0] * old[1] < _BANDED else max(1, int(AT_ONCE / old[1] / max(1.0, old[0] / size[0])))
    for top in range(0, rows.size, count):
        part = out[:, top : top + count]
        part[:] = resampled_rows(source.rows, old, size, rows[top : top + count], columns)
        np.clip(part[3], 0.0, 1.0, out=part[3])
        np.clip(part[:3], 0.0, part[3], out=part[:3])
    return snapped(out)


def tiled(planes: np.ndarray, rect: Rect) -> np.ndarray:
    """`planes` (C, h, w) repeated over the plane from (0, 0) on, cut to `rect`: a new C-contiguous array."""
    repeats = [max(1, -(-_STRIP // size)) for size in planes.shape[1:]]
    if max(repeats) > 1:
        planes = np.tile(planes, (1, *repeats))
    channels, height, width = planes.shape
    out = np.empty((channels, rect.height, rect.width), planes.dtype)
    for y, v, rows in _pieces(rect.y0, rect.height, height):
        for x, u, columns in _pieces(rect.x0, rect.width, width):
            out[:, y : y + rows, x : x + columns] = planes[:, v : v + rows, u : u + columns]
    return out


def _pieces(origin: int, size: int, period: int) -> list[tuple[int, int, int]]:
    """Tells where runs of a periodic axis fall: (place in the result, place in the period, length)."""
    pieces = []
    at, inside = 0, origin % period
    while at < size:
        run = min(size - at, period - inside)
        pieces.append((at, inside, run))
        at, inside = at + run, 0
    return pieces
