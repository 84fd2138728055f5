"""Pictures from files: PNG, JPEG and TIFF, known by their first bytes and never by their name."""

from __future__ import annotations

import io
import os
import threading
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, BinaryIO

import numpy as np

from engine.files.fault import Cancelled, FileError, shown
from engine.files.limits import LIMITS, Limits
from engine.files.png_reader import FOREIGN_PROFILE, PngReader
from engine.files.png_writer import SIGNATURE
from engine.files.profiles.converting import conversion_of, converted_rows, of_pillow
from engine.files.tiff_reader import read_layout, read_tiff
from engine.numeric.parted import Raster, Room

# EXIF 2.3, tag 0x0112: how an array (height, width, ...) is turned upright.
UPRIGHT: dict[int, Callable[[np.ndarray], np.ndarray]] = {
    2: lambda a: a[:, ::-1],
    3: lambda a: a[::-1, ::-1],
    4: lambda a: a[::-1],
    5: lambda a: a.swapaxes(0, 1),
    6: lambda a: a.swapaxes(0, 1)[:, ::-1],
    7: lambda a: a[::-1, ::-1].swapaxes(0, 1),
    8: lambda a: a.swapaxes(0, 1)[::-1],
}
_ORIENTATION = 0x0112
_TIFF = b"II*\0", b"MM\0*", b"II+\0", b"MM\0+"
_READ_AT_ONCE = 1 << 16  # bytes that are read at once
_warnings = threading.Lock()  # the list of warning filters belongs to the whole process


if TYPE_CHECKING:
    from _typeshed import WriteableBuffer as Buffer


@dataclass(frozen=True)
class Meta:
    """What is told of a picture besides its pixels."""

    kind: str  # "png", "jpeg", "tiff"
    notes: tuple[str, ...] = ()  # what was not kept, in words
    profile: bytes = b""  # of its colours, where they are not sRGB and the pixels are not converted


class _Wanted(io.RawIOBase):
    """A file that is read until nobody wants it any more: then reading it raises Cancelled, whoever reads."""

    def __init__(self, file: BinaryIO, cancelled: Callable[[], bool]) -> None:
        self._file, self._cancelled = file, cancelled

    def readable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True

    def fileno(self) -> int:
        return self._file.fileno()

    def seek(self, offset: int, whence: int = os.SEEK_SET) -> int:
        return self._file.seek(offset, whence)

    def tell(self) -> int:
        return self._file.tell()

    def readinto(self, room: Buffer) -> int:
        if self._cancelled():
            raise Cancelled
        view = memoryview(room)
        data = self._file.read(len(view))
        view[: len(data)] = data
        return len(data)


def read_image(
    source: str | os.PathLike[str] | bytes,
    name: str | None = None,
    limits: Limits = LIMITS,
    cancelled: Callable[[], bool] | None = None,
    converted: bool = False,
) -> tuple[np.ndarray, Meta]:
    """Returns a picture as uint8 or uint16 RGBA (height, width, 4), alpha not premultiplied, upright; and what is
    known of it.  `converted`: from its profile to sRGB, else its numbers are as they are.

    `name` stands in messages for a source that is bytes.  FileError, one line, on any fault; Cancelled if `cancelled()`
    becomes true, which is asked between pieces of the file.
    """
    if isinstance(source, bytes):
        return _read(io.BytesIO(source), name or "picture", limits, converted)
    path = os.fspath(source)
    try:
        if os.path.exists(path) and not os.path.isfile(path) and not os.path.isdir(path):
            raise FileError(name or path, "not a regular file")  # and no pipe is waited for
        with open(path, "rb") as file:
            watched = file if cancelled is None else io.BufferedReader(_Wanted(file, cancelled), _READ_AT_ONCE)
            return _read(watched, name or path, limits, converted)
    except (OSError, ValueError) as error:
        raise FileError(name or path, f"cannot be read: {getattr(error, 'strerror', None) or error}") from error


def read_png(
    path: str | os.PathLike[str], name: str, limits: Limits, room: Room, converted: bool = False
) -> Raster | None:
    """Returns a PNG, as `read_image` does, read strip by strip to where there is room; None for other files."""
    try:
        with open(path, "rb") as file:
            if file.read(len(SIGNATURE)) != SIGNATURE:
                return None
            file.seek(0)
            reader = PngReader(file, name, limits)
            pixels = room((reader.header.height, reader.header.width, 4), reader.header.dtype)
            reader.read_into(pixels)
            if converted:
                convert, _ = conversion_of(reader.header.profile, name, reader.header.depth)
                converted_rows(pixels, convert)
            return pixels
    except (OSError, MemoryError) as error:
        raise FileError(name, f"cannot be read: {getattr(error, 'strerror', None) or 'not enough memory'}") from error


def picture_size(path: str | os.PathLike[str]) -> tuple[int, int]:
    """Returns columns and rows of a picture, upright, as its head tells; FileError where that cannot be read."""
    from PIL import Image

    name = os.fspath(path)
    try:
        with open(path, "rb") as file:
            if file.read(4) in _TIFF:
                file.seek(0)
                layout = read_layout(file, name, LIMITS)
                size, orientation = (layout.one("ImageWidth"), layout.one("ImageLength")), layout.one("Orientation", 1)
            else:
                with Image.open(path) as picture:
                    size, orientation = picture.size, picture.getexif().get(_ORIENTATION, 1)
    except FileError:
        raise
    except Exception as error:  # a decoder of hostile bytes may raise anything
        raise FileError(name, f"cannot be read: {getattr(error, 'strerror', None) or error}") from error
    return (size[1], size[0]) if orientation in (5, 6, 7, 8) else size


def wants_conversion(path: str | os.PathLike[str]) -> bool:
    """Tells whether a picture's head has a profile by which its colours become others; FileError where it cannot be
    read."""
    from PIL import Image

    name = os.fspath(path)
    try:
        with open(path, "rb") as file:
            start = file.read(8)
            file.seek(0)
            if start == SIGNATURE:
                header = PngReader(file, name).header
                return conversion_of(header.profile, name, header.depth)[0] is not None
            with Image.open(file) as picture:
                profile, mode = picture.info.get("icc_profile") or b"", picture.mode
    except (OSError, ValueError, MemoryError) as error:
        raise FileError(name, f"cannot be read: {getattr(error, 'strerror', None) or error}") from error
    if mode == "CMYK" and profile:
        return True
    return conversion_of(profile, name, 16 if mode.startswith("I;16") else 8)[0] is not None


def _read(file: BinaryIO, name: str, limits: Limits, converted: bool) -> tuple[np.ndarray, Meta]:
    pixels, meta = _decoded(file, name, limits, converted)
    if not converted or not meta.profile:
        return pixels, meta
    convert, notes = conversion_of(meta.profile, name, 8 * pixels.itemsize)
    converted_rows(pixels, convert)
    kept = tuple(note for note in meta.notes if note != FOREIGN_PROFILE)
    return pixels, Meta(meta.kind, (*kept, *notes))


def _decoded(file: BinaryIO, name: str, limits: Limits, converted: bool) -> tuple[np.ndarray, Meta]:
    start = file.read(8)
    file.seek(0)
    try:
        if start == SIGNATURE:
            reader = PngReader(file, name, limits)
            return reader.read(), Meta("png", reader.header.notes, reader.header.profile if converted else b"")
        if start[:3] == b"\xff\xd8\xff":
            return _by_pillow(file, name, "JPEG", limits, converted)
        if start[:4] in _TIFF:
            return _tiff(file, name, limits, converted)
    except MemoryError as error:
        raise FileError(name, "not enough memory for its pixels") from error
    raise FileError(name, f"starts with {shown(start)}; expected a PNG, JPEG or TIFF")


def _tiff(file: BinaryIO, name: str, limits: Limits, converted: bool) -> tuple[np.ndarray, Meta]:
    layout = read_layout(file, name, limits)
    if not layout.ours:
        if max(layout.bits) > 16 or set(layout.tags.get("SampleFormat", (1,))) != {1}:
            raise FileError(name, f"samples of {max(layout.bits)} bits, not whole numbers of 8 or 16")
        file.seek(0)
        pixels, meta = _by_pillow(file, name, "TIFF", limits, converted)
        lost = ("its 16 bits were reduced to 8",) if max(layout.bits) > 8 and pixels.itemsize == 1 else ()
        return pixels, Meta("tiff", (*meta.notes, *lost), meta.profile)
    pixels, profile = read_tiff(file, layout), bytes(layout.tags.get("ICCProfile", ()))
    return _upright(pixels, layout.one("Orientation", 1)), Meta("tiff", _about_profile(profile), profile)


def _upright(pixels: np.ndarray, orientation: int) -> np.ndarray:
    turn = UPRIGHT.get(orientation)
    return pixels if turn is None else np.ascontiguousarray(turn(pixels))


def _by_pillow(file: BinaryIO, name: str, form: str, limits: Limits, converted: bool) -> tuple[np.ndarray, Meta]:
    """Pillow's decoder for one named format only; whatever it raises comes out as FileError."""
    from PIL import Image, ImageOps, UnidentifiedImageError

    try:
        with _warnings, warnings.catch_warnings():
            # Its warnings are about sizes, checked below, and about tags that are not used.
            warnings.simplefilter("ignore")
            with Image.open(file, formats=[form]) as picture:
                _check(picture.size, name, limits)
                if picture.mode in ("F", "I"):
                    raise FileError(name, f"pixels of kind {picture.mode}; expected 8 or 16 bits")
                profile = picture.info.get("icc_profile") or b""
                upright = ImageOps.exif_transpose(picture)
                if upright.mode.startswith("I;16"):
                    return _grey16(np.asarray(upright)), Meta(form.lower())
                if converted and upright.mode == "CMYK" and profile:
                    upright, notes = of_pillow(upright, profile, name)
                    return np.array(upright.convert("RGBA")), Meta(form.lower(), notes)
                pixels = np.array(upright.convert("RGBA"))
    except (FileError, MemoryError, Cancelled):
        raise
    except UnidentifiedImageError as error:
        raise FileError(name, f"damaged {form}: its head is not that of a {form}") from error
    except Image.DecompressionBombError as error:
        raise FileError(name, f"more pixels than may be; expected at most {limits.pixels}") from error
    except Exception as error:  # a decoder of hostile bytes may raise anything
        raise FileError(name, f"damaged {form}: {error or type(error).__name__}") from error
    return pixels, Meta(form.lower(), _about_profile(profile), profile)


def _about_profile(profile: bytes) -> tuple[str, ...]:
    """Returns what to say of an ICC profile: nothing if it calls itself sRGB, in ASCII or UTF-16."""
    return () if not profile or b"sRGB" in profile.replace(b"\0", b"") else (FOREIGN_PROFILE,)


def _check(size: tuple[int, int], name: str, limits: Limits) -> None:
    width, height = size
    if max(size) > limits.side or width * height > limits.pixels:
        raise FileError(
            name, f"{width} x {height} pixels; expected at most {limits.side} each way, {limits.pixels} in all"
        )


def _grey16(grey: np.ndarray) -> np.ndarray:
    rgba = np.empty((*grey.shape, 4), np.uint16)
    rgba[:, :, :3] = grey[:, :, None]
    rgba[:, :, 3] = 65535
    return rgba
