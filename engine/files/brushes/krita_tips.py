"""Pictures that Krita's presets have as tips: PNG, dark where it paints, and GIMP's."""

from __future__ import annotations

from typing import cast

import numpy as np

from engine.files.brushes.found_brush import LONGEST_TIP, TIP_PIXELS, encircled
from engine.files.brushes.gimp_tips import read_gbr, read_gih
from engine.files.fault import FileError
from engine.files.images import read_image
from engine.files.limits import Limits

_LIMITS = Limits(side=LONGEST_TIP, pixels=TIP_PIXELS)
_READERS = {".gbr": read_gbr, ".gih": read_gih}


def tip_of_file(name: str, data: bytes | None, dark: bool, left: list[str]) -> tuple[np.ndarray, float, float] | None:
    """Returns a tip as a square, the radius around it and the longer side of its picture, px; None, and what is left
    out, where there is none.  `dark`: a coloured one, too, paints where it is dark."""
    ending = name[name.rfind(".") :].lower()
    if data is None:
        left.append(f"its tip “{name[:40]}”, which is not beside it")
        return None
    try:
        if ending in _READERS:
            brush = _READERS[ending](data, name).brushes[0]
            left += brush.left
            radius = cast(float, brush.settings["radius"])
            assert brush.tip is not None
            return brush.tip, radius, 2.0 * radius
        pixels = read_image(data, name, _LIMITS)[0]
    except FileError as error:
        left.append(f"its tip ({error})")
        return None
    tip = encircled(_coverage(pixels if pixels.dtype == np.uint8 else (pixels >> 8).astype(np.uint8), dark))
    if tip is None:
        left.append(f"its tip “{name[:40]}”, which covers nothing")
        return None
    return *tip, float(max(pixels.shape[:2]))


def _coverage(pixels: np.ndarray, dark: bool) -> np.ndarray:
    """Returns where a picture, uint8 RGBA, paints: where a grey one is dark, a coloured one where it is there."""
    colours, alpha = pixels[..., :3].astype(np.float32), pixels[..., 3].astype(np.float32) / np.float32(255)
    coloured = bool(((pixels[..., :3] != pixels[..., :1]).any(axis=2) & (pixels[..., 3] > 0)).any())
    darkness = (np.float32(255) - colours.mean(axis=2)) * alpha
    if (coloured and not dark) or not (darkness > 2).any():
        darkness = alpha * np.float32(255)
    coverage: np.ndarray = np.rint(darkness).astype(np.uint8)
    return coverage
