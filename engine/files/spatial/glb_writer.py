"""Writing one mesh as GLB (glTF 2.0, binary): positions, normals, colours of vertices."""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass, field
from typing import BinaryIO

import numpy as np

_VERTICES, _INDICES = 34962, 34963  # what a view is for
_UINT16, _UINT32, _FLOAT = 5123, 5125, 5126


@dataclass(frozen=True)
class GlbMesh:
    """A mesh: `positions` (n, 3), y up; `normals` (n, 3) of length 1; `faces` (m, 3), counterclockwise from outside;
    `colours` (n, 3), linear, 0..1, or None; `roughness`: 0 mirrors, 1 is dull; `extras`: what
    else is told of it."""

    positions: np.ndarray
    normals: np.ndarray
    faces: np.ndarray
    colours: np.ndarray | None = None
    name: str = "terrain"
    roughness: float = 0.95
    extras: dict[str, float | str] = field(default_factory=dict)


class _Packed:
    """The binary part, as it grows, and what the other one tells of it."""

    def __init__(self) -> None:
        self.parts: list[bytes] = []
        self.views: list[dict[str, int]] = []
        self.accessors: list[dict[str, object]] = []
        self.size = 0

    def add(self, values: np.ndarray, target: int, component: int, **more: object) -> int:
        """Appends an array of vectors (n, k) or of numbers (n); returns its number."""
        data = np.ascontiguousarray(values).tobytes()
        self.views.append({"buffer": 0, "byteOffset": self.size, "byteLength": len(data), "target": target})
        kind = "SCALAR" if values.ndim == 1 else f"VEC{values.shape[1]}"
        told = {"bufferView": len(self.views) - 1, "componentType": component, "count": len(values), "type": kind}
        self.accessors.append(told | more)
        self.parts.append(data + bytes(-len(data) % 4))
        self.size += len(self.parts[-1])
        return len(self.accessors) - 1


def write_glb(file: BinaryIO, shape: GlbMesh) -> None:
    """Writes a mesh of at least one face; ValueError if it is too large for the format, which is 4 GB."""
    packed = _Packed()
    place = shape.positions.astype("<f4")
    bounds = {"min": place.min(axis=0).tolist(), "max": place.max(axis=0).tolist()}
    attributes = {
        "POSITION": packed.add(place, _VERTICES, _FLOAT, **bounds),
        "NORMAL": packed.add(shape.normals.astype("<f4"), _VERTICES, _FLOAT),
    }
    if shape.colours is not None:
        opaque = np.concatenate([shape.colours, np.ones((len(shape.colours), 1))], axis=1)
        words = (np.clip(opaque, 0.0, 1.0) * 65535.0 + 0.5).astype("<u2")
        attributes["COLOR_0"] = packed.add(words, _VERTICES, _UINT16, normalized=True)
    indices = packed.add(shape.faces.astype("<u4").ravel(), _INDICES, _UINT32)
    told = json.dumps(_document(shape, packed, attributes, indices), separators=(",", ":")).encode()
    told += b" " * (-len(told) % 4)
    whole = 28 + len(told) + packed.size
    if whole >= 1 << 32:
        raise ValueError(f"GLB of {whole} bytes; expected less than 2^32")
    file.write(struct.pack("<4sII", b"glTF", 2, whole) + struct.pack("<I4s", len(told), b"JSON") + told)
    file.write(struct.pack("<I4s", packed.size, b"BIN\0"))
    for part in packed.parts:
        file.write(part)


def _document(shape: GlbMesh, packed: _Packed, attributes: dict[str, int], indices: int) -> dict[str, object]:
    node = {"mesh": 0, "name": shape.name} | ({"extras": shape.extras} if shape.extras else {})
    surface = {"metallicFactor": 0.0, "roughnessFactor": shape.roughness}
    return {
        "asset": {"version": "2.0", "generator": "Inkfall"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [node],
        "materials": [{"name": shape.name, "pbrMetallicRoughness": surface}],
        "meshes": [{"name": shape.name, "primitives": [{"attributes": attributes, "indices": indices, "material": 0}]}],
        "accessors": packed.accessors,
        "bufferViews": packed.views,
        "buffers": [{"byteLength": packed.size}],
    }
