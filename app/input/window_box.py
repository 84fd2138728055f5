"""Where the window lay when it was closed: read before there is a window, so with next to nothing loaded."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, NamedTuple

import imgui_bundle  # before glfw, so that both use one libglfw

import glfw  # isort: skip
import platformdirs

assert imgui_bundle

Area = tuple[int, int, int, int]  # left, top, width, height
_LEAST, _MOST = (320, 240), 32768  # of width and height, and of all numbers
_BYTES = 1 << 20  # of the file, at most
_SEEN = 64  # pixels of the window that have to lie on a screen


class WindowBox(NamedTuple):
    """`area`: place on the desktop and size in points; `maximised`: it filled the screen, and is as large otherwise."""

    area: Area
    maximised: bool = False


def kept_window_file() -> Path:
    """Returns where all that a window remembers lies, whether it is there or not."""
    return platformdirs.user_config_path("inkfall") / "window.json"


def read_box(path: Path) -> WindowBox | None:
    """Returns where the window lay; None where that is not to be had, of which others tell why."""
    try:
        with path.open("rb") as file:
            told = json.loads(file.read(_BYTES + 1))
        return box_of(told.get("box"), told.get("maximised", False)) if isinstance(told, dict) else None
    except (OSError, ValueError, RecursionError):
        return None


def box_of(area: object, maximised: object) -> WindowBox | None:
    """Returns a box as the file tells it; None for what is none."""
    if not isinstance(area, list) or len(area) != 4 or not isinstance(maximised, bool):
        return None
    if not all(type(number) is int and abs(number) <= _MOST for number in area):
        return None
    x, y, width, height = area
    return WindowBox((x, y, width, height), maximised) if width >= _LEAST[0] and height >= _LEAST[1] else None


def box_in_points(
    corner: tuple[int, int], size: tuple[int, int], shown: tuple[int, int], scale: float
) -> WindowBox | None:
    """Returns where a window lies that fills no screen; None for what is none.  `shown`: its framebuffer: where the
    system tells sizes in points, that is another than its `size`."""
    by = scale if shown == size else 1.0
    return box_of([*corner, *(round(side / by) for side in size)], False)


def box_of_window(handle: Any, scale: float) -> WindowBox | None:
    """Returns where a window lies now, on a screen of `scale` pixels per point; None while it is an icon or fills the
    screen, and where the system does not tell."""
    if glfw.get_window_attrib(handle, glfw.ICONIFIED) or glfw.get_window_attrib(handle, glfw.MAXIMIZED):
        return None
    size, shown = glfw.get_window_size(handle), glfw.get_framebuffer_size(handle)
    return box_in_points(glfw.get_window_pos(handle), size, shown, scale)


def fitted_box(area: Area, screens: list[Area]) -> tuple[Area, bool]:
    """Returns the area no larger than the screen on which most of it lies, and whether that is on a screen at all: else
    the system is to choose a place."""
    if not screens:
        return area, False
    best = max(screens, key=lambda screen: _shared(area, screen))
    x, y, width, height = area
    left, top, wide, high = best
    width, height = min(width, wide), min(height, high)
    seen = _shared((x, y, width, _SEEN), best) >= _SEEN * _SEEN
    return (max(left, min(x, left + wide - width)), max(top, min(y, top + high - height)), width, height), seen


def _shared(one: Area, other: Area) -> int:
    """Counts the pixels that two areas have in common."""
    wide = min(one[0] + one[2], other[0] + other[2]) - max(one[0], other[0])
    high = min(one[1] + one[3], other[1] + other[3]) - max(one[1], other[1])
    return max(wide, 0) * max(high, 0)
