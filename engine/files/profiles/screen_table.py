"""What a screen has to show so that sRGB's colours are seen: a table in three dimensions, made by LittleCMS."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from engine.files.fault import FileError
from engine.files.profiles.by_littlecms import open_profile, transformed
from engine.files.profiles.icc_profile import Profile

# Values of 8 bits at which colours are told: closer in the dark, where curves are steep.
NODES = (*range(8), 8, 10, 12, 14, 16, 18, *range(20, 256, 5))


@dataclass(frozen=True, eq=False)
class ScreenTable:
    """`colours`: uint8 (b, g, r, 3), what is sent for each of `NODES`; `title`: what its profile is called; `proof`:
    that of what is imitated, if anything is."""

    colours: np.ndarray
    title: str
    proof: str = ""


def screen_table(screen: Profile | None, proof: Profile | None = None) -> ScreenTable:
    """Returns the table of a screen, one of sRGB if that is None, on which another is imitated, if there is a `proof`.
    FileError where a profile is not for that."""
    from PIL import Image, ImageCms

    if screen is not None and screen.mode != "RGB":
        raise FileError(screen.file, f"a profile of {screen.mode}, expected one of a screen, RGB")
    nodes, side = np.array(NODES, np.uint8), len(NODES)
    grid = np.empty((side, side, side, 3), np.uint8)
    grid[..., 0], grid[..., 1], grid[..., 2] = nodes, nodes[:, None], nodes[:, None, None]
    srgb = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB"))
    shown = srgb if screen is None else open_profile(screen)
    intent, flags = ImageCms.Intent.RELATIVE_COLORIMETRIC, ImageCms.Flags.BLACKPOINTCOMPENSATION
    try:
        if proof is None:
            made = ImageCms.buildTransform(srgb, shown, "RGB", "RGB", intent, flags)
        else:
            flags |= ImageCms.Flags.SOFTPROOFING
            made = ImageCms.buildProofTransform(srgb, shown, open_profile(proof), "RGB", "RGB", intent, intent, flags)
    except ImageCms.PyCMSError as error:
        told = (proof or screen).file if proof or screen else "sRGB"  # type: ignore[union-attr]
        raise FileError(told, f"no colours can be made for it: {error}") from error
    picture = transformed(made, Image.fromarray(grid.reshape(side * side, side, 3), "RGB"))
    colours = np.asarray(picture).reshape(grid.shape).copy()
    colours.setflags(write=False)
    return ScreenTable(colours, _called(screen), "" if proof is None else _called(proof))


def _called(profile: Profile | None) -> str:
    from pathlib import PurePath

    return "sRGB" if profile is None else profile.title or PurePath(profile.file).stem
