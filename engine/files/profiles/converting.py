"""Pictures with profiles, converted to sRGB as they come in."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from engine.files.fault import FileError
from engine.files.profiles.by_littlecms import to_srgb
from engine.files.profiles.icc_profile import Profile, profile_of
from engine.files.profiles.matrix_profile import matrix_conversion
from engine.numeric.parted import Raster

if TYPE_CHECKING:
    from PIL.Image import Image as Picture

_NOT_APPLIED = "its colour profile is not applied"
_PIXELS = 1 << 20  # that are converted at a time
Convert = Callable[[np.ndarray], np.ndarray]


def conversion_of(data: bytes, file: str, bits: int) -> tuple[Convert | None, tuple[str, ...]]:
    """Returns what makes sRGB of RGBA pixels of so many bits, as `matrix_conversion`; None where they are that, or are
    taken as that; and what is to be told."""
    if not data:
        return None, ()
    try:
        profile = profile_of(data, file)
        if profile.is_srgb:
            return None, ()
        if profile.mode == "RGB" and profile.by_xyz and not profile.has_tables:
            return matrix_conversion(profile), ()
        if bits > 8:
            raise FileError(file, "it goes by tables, which are applied to 8 bits alone")
        return _by_tables(profile), ()
    except FileError as error:
        return None, (f"{_NOT_APPLIED}: {error.message}",)


def converted_rows(pixels: Raster, convert: Convert | None) -> None:
    """Converts pixels (h, w, 4) where they are, some rows at a time."""
    if convert is None:
        return
    step = max(1, _PIXELS // max(1, pixels.shape[1]))
    for top in range(0, pixels.shape[0], step):
        pixels[top : top + step] = convert(pixels[slice(top, top + step), slice(None)])


def of_pillow(picture: Picture, data: bytes, file: str) -> tuple[Picture, tuple[str, ...]]:
    """Returns a picture of Pillow in CMYK as RGB by its profile, or as it is; and what is to be told."""
    try:
        profile = profile_of(data, file)
        if profile.mode != picture.mode:
            raise FileError(file, f"it is for {profile.mode}, found {picture.mode}")
        return to_srgb(profile)(picture), ()
    except FileError as error:
        return picture, (f"{_NOT_APPLIED}: {error.message}",)


def _by_tables(profile: Profile) -> Convert:
    """Returns what LittleCMS makes of RGBA of 8 bits: of grey pictures, and of profiles with tables."""
    from PIL import Image

    if profile.mode == "CMYK":
        raise FileError(profile.file, "it is for CMYK, found other colours")
    through = to_srgb(profile)

    def convert(pixels: np.ndarray) -> np.ndarray:
        out = pixels.copy()
        given = pixels[..., 0] if profile.mode == "L" else pixels[..., :3]
        out[..., :3] = np.asarray(through(Image.fromarray(np.ascontiguousarray(given), profile.mode)))
        return out

    return convert
