"""Triangles of a binary glTF 2.0 file: positions and indices of all meshes, where the scene's nodes put them."""

from __future__ import annotations

import struct
from typing import NoReturn

import numpy as np

from engine.checks.field_error import FieldError
from engine.files.strict_json import loads

_JSON, _BIN = 0x4E4F534A, 0x004E4942
_KINDS: dict[int, np.dtype[np.generic]] = {
    5121: np.dtype("<u1"),
    5123: np.dtype("<u2"),
    5125: np.dtype("<u4"),
    5126: np.dtype("<f4"),
}
_WIDE = {"SCALAR": 1, "VEC3": 3}
_DEEP, _MOST_NODES = 64, 100_000
_TRIANGLES = 4
_Members = dict[str, object]


def triangles(data: bytes, most: int) -> tuple[np.ndarray, np.ndarray]:
    """Returns points (V, 3), y upwards, and triangles (F, 3), of at most `most` corners.  ValueError says what is
    wrong."""
    document, binary = _chunks(data)
    return _File(document, binary, most).read()


def _wrong(found: str, expected: str) -> NoReturn:
    raise ValueError(f"found {found}, expected {expected}")


def _chunks(data: bytes) -> tuple[_Members, bytes]:
    if len(data) < 20 or data[:4] != b"glTF" or data[4:8] != b"\2\0\0\0":
        _wrong("other bytes at the beginning", "those of binary glTF 2")
    parts: dict[int, bytes] = {}
    at = 12
    while at + 8 <= len(data):
        length, kind = struct.unpack_from("<II", data, at)
        if at + 8 + length > len(data):
            _wrong(f"a chunk of {length:,} bytes at {at}", f"at most {len(data) - at - 8:,}")
        parts.setdefault(kind, data[at + 8 : at + 8 + length])
        at += 8 + length
    try:
        document = loads(parts.get(_JSON, b"").rstrip(b" \0"))
    except FieldError as error:
        _wrong(error.found, error.expected)
    if not isinstance(document, dict):
        _wrong("no object as its JSON", "one")
    return document, parts.get(_BIN, b"")


class _File:
    """The members of a file, and the triangles found so far."""

    def __init__(self, document: _Members, binary: bytes, most: int) -> None:
        self.document, self.binary, self.most = document, binary, most
        self.points: list[np.ndarray] = []
        self.faces: list[np.ndarray] = []
        self.count = self.corners = self.visited = 0

    def read(self) -> tuple[np.ndarray, np.ndarray]:
        """Returns the points and triangles of all nodes; of all meshes, if there is no node."""
        nodes = self.document.get("nodes")
        if isinstance(nodes, list) and nodes:
            below = [child for node in nodes if isinstance(node, dict) for child in _list(node.get("children", []))]
            for root in set(range(len(nodes))) - {child for child in below if isinstance(child, int)}:
                self._node(root, np.eye(4), 0)
        else:
            for name in range(len(_list(self.document.get("meshes", [])))):
                self._mesh(name, np.eye(4))
        if not self.points:
            return np.zeros((0, 3)), np.zeros((0, 3), np.int64)
        return np.concatenate(self.points), np.concatenate(self.faces)

    def _row(self, table: str, name: object) -> _Members:
        rows = _list(self.document.get(table, []))
        if isinstance(name, bool) or not isinstance(name, int) or not 0 <= name < len(rows):
            _wrong(f"a place {str(name)[:20]!a} in {table}", f"0 to {len(rows) - 1}")
        row = rows[name]
        if not isinstance(row, dict):
            _wrong(f"no object in {table}", "one")
        return row

    def _node(self, name: object, above: np.ndarray, depth: int) -> None:
        self.visited += 1
        if depth > _DEEP or self.visited > _MOST_NODES:
            _wrong("nodes within one another without end, or too many", f"at most {_MOST_NODES:,}, {_DEEP} deep")
        row = self._row("nodes", name)
        placed = above @ _matrix(row)
        if "mesh" in row:
            self._mesh(row["mesh"], placed)
        for child in _list(row.get("children", [])):
            self._node(child, placed, depth + 1)

    def _mesh(self, name: object, placed: np.ndarray) -> None:
        for part in _list(self._row("meshes", name).get("primitives", [])):
            if not isinstance(part, dict) or not isinstance(part.get("attributes"), dict):
                _wrong("a part of a mesh without attributes", "POSITION")
            if part.get("mode", _TRIANGLES) != _TRIANGLES:
                continue
            points = self._values(part["attributes"].get("POSITION"), "VEC3").astype(np.float64)
            names = self._values(part["indices"], "SCALAR").astype(np.int64) if "indices" in part else None
            order = np.arange(len(points)) if names is None else names.reshape(-1)
            faces = order[: len(order) // 3 * 3].reshape(-1, 3)
            if len(faces) and faces.max() >= len(points):
                _wrong(f"a triangle of point {faces.max()}", f"one of {len(points)}")
            self.corners += faces.size + len(points)
            if self.corners > 2 * self.most:
                _wrong(f"more than {self.most // 3:,} triangles", "less")
            self.points.append(points @ placed[:3, :3].T + placed[:3, 3])
            self.faces.append(faces + self.count)
            self.count += len(points)

    def _values(self, name: object, shape: str) -> np.ndarray:
        """An accessor's values: (count, 1 or 3)."""
        row = self._row("accessors", name)
        kind, wide = _KINDS.get(_whole(row, "componentType")), _WIDE[shape]
        if kind is None or row.get("type") != shape or (shape == "VEC3" and kind.kind != "f"):
            _wrong(f"values of type {str(row.get('type'))[:12]!a}", f"{shape} of floats or whole numbers")
        if "sparse" in row or "bufferView" not in row:
            _wrong("values that are not in the file's buffer", "plain ones")
        view = self._row("bufferViews", row["bufferView"])
        count, size = _whole(row, "count"), kind.itemsize * wide
        stride = _whole(view, "byteStride", size) or size
        start = _whole(view, "byteOffset") + _whole(row, "byteOffset")
        if count and (stride < size or start + stride * (count - 1) + size > len(self.binary)):
            _wrong(f"{count:,} values from byte {start:,}", f"so many within {len(self.binary):,} bytes")
        if count == 0:
            return np.zeros((0, wide), kind)
        return np.ndarray((count, wide), kind, self.binary, start, (stride, kind.itemsize))


def _list(value: object) -> list[object]:
    if not isinstance(value, list):
        _wrong(f"{str(value)[:20]!a}", "a list")
    return value


def _whole(row: _Members, name: str, default: int = 0) -> int:
    value = row.get(name, default)
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value < 1 << 31:
        _wrong(f"{name} {str(value)[:20]!a}", "a whole number from 0")
    return value


def _numbers(row: _Members, name: str, default: tuple[float, ...]) -> np.ndarray:
    value = row.get(name, list(default))
    if not isinstance(value, list) or len(value) != len(default) or not all(_is_number(v) for v in value):
        _wrong(f"{name} {str(value)[:20]!a}", f"{len(default)} numbers")
    return np.array(value, np.float64)


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < 1e30


def _matrix(row: _Members) -> np.ndarray:
    """Where a node puts what is in it: (4, 4)."""
    if "matrix" in row:
        return _numbers(row, "matrix", (0.0,) * 16).reshape(4, 4).T
    x, y, z, w = _numbers(row, "rotation", (0.0, 0.0, 0.0, 1.0))
    out = np.eye(4)
    turned = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
        (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
        (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
    )
    out[:3, :3] = np.array(turned) * _numbers(row, "scale", (1.0, 1.0, 1.0))
    out[:3, 3] = _numbers(row, "translation", (0.0, 0.0, 0.0))
    return out
