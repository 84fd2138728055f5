"""Writing triangles as binary STL."""

from __future__ import annotations

import struct
from typing import BinaryIO

import numpy as np

_PART = 1 << 16  # triangles that are written at a time
_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def write_stl(file: BinaryIO, positions: np.ndarray, faces: np.ndarray) -> None:
    """Writes triangles: `positions` (n, 3), z up; `faces` (m, 3), counterclockwise from outside."""
    place = positions.astype(np.float32)
    file.write(b"Inkfall terrain".ljust(80) + struct.pack("<I", len(faces)))
    for start in range(0, len(faces), _PART):
        corners = place[faces[start : start + _PART]]
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        records = np.zeros(len(corners), _RECORD)
        records["normal"] = across / np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-30)
        records["corners"] = corners
        file.write(records.tobytes())
