"""libmypaint's own speed on this machine, where its library is installed (Debian: libmypaint-1.5-1).

Its calls go through ctypes, which costs it about a microsecond for each event.
"""

from __future__ import annotations

import ctypes
import math
import os
import time
from collections.abc import Sequence
from contextlib import suppress
from functools import cache
from typing import Any

NAMES = ("libmypaint-1.5.so.1", "libmypaint.so.0", "libmypaint-1.5.dylib")
SIDE = 2048  # pixels of the surface
AT_ONCE = 4  # events between two times that the surface is brought up to date, as a frame brings them
_FLOAT, _POINTER = ctypes.c_float, ctypes.c_void_p


@cache
def library() -> Any:
    """The library with the types of its calls, or None.  One thread: a team of two stalls when a core is busy."""
    before = dict(os.environ)
    os.environ.setdefault("OMP_NUM_THREADS", "1")  # which is read as it is loaded
    try:
        for name in NAMES:
            with suppress(OSError, AttributeError):
                return _typed(ctypes.CDLL(name))
    finally:
        os.environ.clear()
        os.environ.update(before)
    return None


def _typed(lib: Any) -> Any:
    lib.mypaint_brush_new.restype = _POINTER
    lib.mypaint_brush_from_defaults.argtypes = [_POINTER]
    lib.mypaint_brush_set_base_value.argtypes = [_POINTER, ctypes.c_int, _FLOAT]
    lib.mypaint_brush_setting_from_cname.argtypes = [ctypes.c_char_p]
    lib.mypaint_brush_unref.argtypes = [_POINTER]
    lib.mypaint_brush_stroke_to.argtypes = [_POINTER, _POINTER, *[_FLOAT] * 5, ctypes.c_double, *[_FLOAT] * 3]
    lib.mypaint_fixed_tiled_surface_new.restype = _POINTER
    lib.mypaint_fixed_tiled_surface_new.argtypes = [ctypes.c_int, ctypes.c_int]
    lib.mypaint_fixed_tiled_surface_interface.restype = _POINTER
    lib.mypaint_fixed_tiled_surface_interface.argtypes = [_POINTER]
    lib.mypaint_surface_begin_atomic.argtypes = [_POINTER]
    lib.mypaint_surface_end_atomic.argtypes = [_POINTER, _POINTER]
    lib.mypaint_surface_draw_dab.argtypes = [_POINTER, *[_FLOAT] * 13]
    return lib


@cache
def _surface() -> int:
    lib = library()
    return lib.mypaint_fixed_tiled_surface_interface(lib.mypaint_fixed_tiled_surface_new(SIDE, SIDE))


def stroke(
    points: Sequence[tuple[float, float, float]], radius: float, hardness: float, spacing: float, smudge: float = 0.0
) -> float:
    """CPU seconds for a stroke through x, y, pressure; opacity follows the pressure; `spacing` in radii.  `smudge`: how
    much of the paint that lies there it takes along."""
    lib, surface = library(), _surface()
    brush = lib.mypaint_brush_new()
    lib.mypaint_brush_from_defaults(brush)
    settings = (
        (b"radius_logarithmic", math.log(radius)),
        (b"hardness", hardness),
        (b"dabs_per_actual_radius", 1.0 / spacing),
        (b"dabs_per_basic_radius", 0.0),
        (b"slow_tracking", 0.0),
        (b"smudge", smudge),
    )
    for name, value in settings:
        lib.mypaint_brush_set_base_value(brush, lib.mypaint_brush_setting_from_cname(name), value)
    start = time.process_time()
    for first in range(0, len(points), AT_ONCE):
        lib.mypaint_surface_begin_atomic(surface)
        for x, y, pressure in points[first : first + AT_ONCE]:
            lib.mypaint_brush_stroke_to(brush, surface, x, y, pressure, 0.0, 0.0, 0.002, 1.0, 0.0, 0.0)
        lib.mypaint_surface_end_atomic(surface, None)
    taken = time.process_time() - start
    lib.mypaint_brush_unref(brush)
    return taken


def dabs(places: Sequence[tuple[float, float]], radius: float, hardness: float) -> float:
    """CPU seconds for dabs at half opacity."""
    lib, surface = library(), _surface()
    start = time.process_time()
    lib.mypaint_surface_begin_atomic(surface)
    for x, y in places:
        lib.mypaint_surface_draw_dab(surface, x, y, radius, 0.2, 0.4, 0.6, 0.5, hardness, 1.0, 1.0, 0.0, 0.0, 0.0)
    lib.mypaint_surface_end_atomic(surface, None)
    return time.process_time() - start
