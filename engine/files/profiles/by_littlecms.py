"""What LittleCMS makes of colours, through Pillow, which is loaded when it is asked for."""

from __future__ import annotations

import io
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from engine.files.fault import FileError
from engine.files.profiles.icc_profile import Profile

if TYPE_CHECKING:
    from PIL.Image import Image as Picture
    from PIL.ImageCms import ImageCmsProfile, ImageCmsTransform


def to_srgb(profile: Profile) -> Callable[[Picture], Picture]:
    """Returns what makes pictures of Pillow sRGB, from the mode that the profile is for."""
    from PIL import ImageCms

    try:
        srgb = ImageCms.createProfile("sRGB")
        made = ImageCms.buildTransform(
            open_profile(profile), srgb, profile.mode, "RGB", ImageCms.Intent.RELATIVE_COLORIMETRIC,
            ImageCms.Flags.BLACKPOINTCOMPENSATION,
        )  # fmt: skip
    except ImageCms.PyCMSError as error:
        raise FileError(profile.file, f"no colours can be made by it: {error}") from error
    return partial(transformed, made)


def transformed(made: ImageCmsTransform, picture: Picture) -> Picture:
    """Returns what LittleCMS makes of a picture."""
    from PIL import ImageCms

    found = ImageCms.applyTransform(picture, made)
    assert found is not None  # it is not done in place
    return found


def open_profile(profile: Profile) -> ImageCmsProfile:
    """Returns a profile as Pillow's ImageCms takes it; FileError where LittleCMS finds fault with it."""
    from PIL import ImageCms

    try:
        return ImageCms.getOpenProfile(io.BytesIO(profile.data))
    except (ImageCms.PyCMSError, OSError) as error:
        raise FileError(profile.file, f"not a profile that can be used: {error}") from error
