"""Meshes of strangers: Wavefront .obj, .stl of both kinds, binary glTF .glb.

Only triangles and where they are is read.  What is wrong with a file is one line; numbers in it are claims, which are
compared with its size before anything is made of them.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from itertools import pairwise

import numpy as np

from engine.files.fault import FileError, TooMuch, reason_of, shown
from engine.solids import glb_reader
from engine.solids.mesh import Mesh, meshed, unit_sized

_BYTES = 512 << 20
MOST_FACES = 4_000_000
_Parts = tuple[np.ndarray, np.ndarray]
_NUMBER = re.compile(rb"\s*vertex\s+(\S+)\s+(\S+)\s+(\S+)")


def read_mesh(path: str) -> Mesh:
    """Returns the mesh in a file, 2 long and around 0, upright.  FileError says what is wrong with it."""
    ending = os.path.splitext(path)[1].lower()
    if ending not in READERS:
        raise FileError(path, f"found the ending {shown(ending)}, expected {', '.join(READERS)}")
    try:
        if os.path.getsize(path) > _BYTES:
            raise TooMuch(path, f"found {os.path.getsize(path):,} bytes, expected at most {_BYTES:,}")
        with open(path, "rb") as file:
            data = file.read()
    except OSError as error:
        raise FileError(path, f"cannot be read: {reason_of(error)}") from error
    try:
        points, faces = READERS[ending](data)
    except ValueError as error:
        raise FileError(path, str(error)) from None
    return _checked(path, points, faces)


def _checked(path: str, points: np.ndarray, faces: np.ndarray) -> Mesh:
    if len(faces) > MOST_FACES:
        raise TooMuch(path, f"found {len(faces):,} triangles, expected at most {MOST_FACES:,}")
    if len(faces) == 0 or len(points) == 0:
        raise FileError(path, "found no triangle, expected some")
    if faces.min() < 0 or faces.max() >= len(points):
        raise FileError(path, f"found a triangle of point {int(faces.max()) + 1}, expected one of {len(points)}")
    used = points[np.unique(faces)]
    if not np.isfinite(used).all() or np.abs(used).max() > 1e30:
        raise FileError(path, "found a point that is no number, or beyond 1e30, expected finite places")
    if float(np.ptp(used, axis=0).max()) <= 0.0:
        raise FileError(path, "found all points in one place, expected an object")
    kept = np.unique(faces, return_inverse=True)
    made = meshed(unit_sized(points[kept[0]]), kept[1].reshape(-1, 3))
    if len(made.faces) == 0:
        raise FileError(path, "found triangles without area, expected an object")
    return made


def upright(points: np.ndarray) -> np.ndarray:
    """Points of a file whose y axis points up, with z up."""
    x, y, z = points.T
    return np.stack([x, -z, y], axis=1)


def _obj(data: bytes) -> _Parts:
    points: list[list[float]] = []
    faces: list[tuple[int, int, int]] = []
    for number, line in enumerate(data.split(b"\n"), 1):
        words = line.split()
        try:
            if words[:1] == [b"v"]:
                points.append([float(word) for word in words[1:4]])
                if len(words) < 4:
                    raise ValueError
            elif words[:1] == [b"f"]:
                names = [int(word.split(b"/")[0]) for word in words[1:]]
                if len(names) < 3 or 0 in names:
                    raise ValueError
                corners = [name - 1 if name > 0 else len(points) + name for name in names]
                faces += [(corners[0], b, c) for b, c in pairwise(corners[1:])]
        except ValueError:
            raise ValueError(f"line {number}: found {shown(line)}, expected v X Y Z or f A B C ...") from None
        if len(faces) > MOST_FACES:
            break
    if max((max(face) for face in faces), default=0) >= len(points) or min((min(f) for f in faces), default=0) < 0:
        raise ValueError(f"found a face of a point that is not there, expected one of {len(points)}")
    return upright(np.array(points, np.float64).reshape(-1, 3)), np.array(faces, np.int64).reshape(-1, 3)


def _stl(data: bytes) -> _Parts:
    count = int.from_bytes(data[80:84], "little")
    if len(data) >= 84 and len(data) == 84 + 50 * count:
        kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
        points = np.frombuffer(data, kind, count, 84)["corners"].reshape(-1, 3).astype(np.float64)
    elif data[:5].lower() == b"solid":
        try:
            points = np.array(_NUMBER.findall(data)).astype(np.float64).reshape(-1, 3)
        except ValueError:
            raise ValueError("found a vertex that is no number, expected vertex X Y Z") from None
        if len(points) % 3:
            raise ValueError(f"found {len(points)} vertices, expected three for each triangle")
    else:
        raise ValueError(f"found {len(data):,} bytes for {count:,} triangles, expected {84 + 50 * count:,}")
    return points, np.arange(len(points)).reshape(-1, 3)


def _glb(data: bytes) -> _Parts:
    points, faces = glb_reader.triangles(data, 3 * MOST_FACES)
    return upright(points), faces


READERS: dict[str, Callable[[bytes], _Parts]] = {".obj": _obj, ".stl": _stl, ".glb": _glb}
"""The kinds of files, by their endings."""
