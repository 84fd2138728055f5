"""Land as files for other programs: height maps with what those have to know beside them, meshes."""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass
from pathlib import Path, PurePath
from typing import BinaryIO

import numpy as np

from engine.files.atomic import replacing
from engine.files.fault import WriteError
from engine.files.png_writer import PngWriter
from engine.files.spatial.exr_writer import write_exr
from engine.files.spatial.geotiff_writer import write_geotiff
from engine.files.spatial.glb_writer import GlbMesh, write_glb
from engine.files.spatial.sidecar import CODES, MapFacts, facts_for
from engine.files.spatial.stl_writer import write_stl
from engine.terrain.drape import Cover
from engine.terrain.height_window import Relief, number_of
from engine.terrain.right_triangles import Mesh, closed_block, count_of, errors_of, mesh_of_at_most, mesh_within

MAPS, MESHES = (".exr", ".tif", ".tiff", ".png"), (".glb", ".stl")
_STRIP = 256  # rows that are coded at a time


def beside(path: str) -> str:
    """Returns the path of what is told of a map."""
    return str(Path(path).with_suffix(".json"))


def write_map(path: str, target: str, relief: Relief, pixel: float) -> None:
    """Writes a height map for a program, and `beside` it what that has to know.  `pixel`: metres of a pixel's side.
    WriteError on failure."""
    metres = (relief.heights.astype(np.float64) * pixel).astype(np.float32)
    if not np.isfinite(metres).all():
        raise WriteError(path, "heights beyond all numbers; expected fewer metres per pixel")
    low, high = float(metres.min()), float(metres.max())
    rows, columns = metres.shape
    facts = MapFacts(PurePath(path).name, (columns, rows), pixel, low, high, relief.place)
    text = json.dumps(facts_for(target, facts), indent=1) + "\n"
    ending = PurePath(path).suffix.lower()
    corner = number_of(relief.rect.x0) * pixel, -number_of(relief.rect.y0) * pixel
    if ending.startswith(".tif") and not all(map(math.isfinite, corner)):
        raise WriteError(path, "its place is beyond all numbers; expected .exr or .png there")
    with replacing(path) as file:
        if ending == ".exr":
            write_exr(file, (columns, rows), ("Y",), [metres[:, :, None]], {"metresPerPixel": pixel})
        elif ending == ".png":
            _codes(file, metres, low, high)
        else:
            write_geotiff(file, metres, pixel, corner)
        with replacing(beside(path)) as notes:
            notes.write(text.encode())


def _codes(file: BinaryIO, metres: np.ndarray, low: float, high: float) -> None:
    writer = PngWriter(file, metres.shape[1], metres.shape[0], channels=1, depth=16, colours=False)
    scale = CODES / (high - low) if high > low else 0.0
    for y in range(0, len(metres), _STRIP):
        part = (metres[y : y + _STRIP].astype(np.float64) - low) * scale
        writer.rows(np.rint(part).astype(np.uint16)[:, :, None])
    writer.close()


@dataclass(frozen=True)
class Meshed:
    """Land as a mesh: how many triangles it has, and how far it is from any sample at most, in pixels."""

    relief: Relief
    mesh: Mesh
    triangles: int
    error: float
    closed: bool

    @property
    def cells(self) -> tuple[int, int]:
        """Gives its columns and rows."""
        return self.relief.rect.width - 1, self.relief.rect.height - 1


def meshed(relief: Relief, error: float, most: int | None, closed: bool) -> Meshed:
    """Returns a relief of at least 2 x 2 samples as a mesh that errs by at most `error`, or has at most so many
    triangles; ValueError if it cannot have so few."""
    bounds = errors_of(relief.heights)
    if most is not None:
        mesh, error = mesh_of_at_most(bounds, most, closed)
    else:
        mesh = mesh_within(bounds, error)
    return Meshed(relief, mesh, count_of(mesh, bounds, closed), error, closed)


def write_mesh(path: str | os.PathLike[str], made: Meshed, cover: Cover, base: float, pixel: float) -> None:
    """Writes a mesh, in metres, y up (.glb) or z up (.stl); `base`: pixels below the lowest point at which a closed one
    ends.  WriteError on failure."""
    x, y = made.mesh.places.T
    h = made.relief.heights
    upright = np.stack([x, -y, h[y, x]], 1).astype(np.float64)
    points, faces = upright, made.mesh.faces
    if made.closed:
        points, faces = closed_block(made.mesh, upright, made.cells, float(h.min()) - base)
    with replacing(path) as file:
        if PurePath(path).suffix.lower() == ".stl":
            write_stl(file, points * pixel, faces)
            return
        down, across = np.gradient(h.astype(np.float64), axis=0), np.gradient(h.astype(np.float64), axis=1)
        normals = np.stack([-across[y, x], np.ones(len(x)), -down[y, x]], 1)
        colours = cover.colours(made.relief.level, made.relief.rect, h)[y, x]
        if made.closed:
            points, faces, normals, colours = _opened(points, faces, normals, colours)
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        facts: dict[str, float | str] = {"metres_per_pixel": pixel, "error_metres": made.error * pixel}
        place = points[:, [0, 2, 1]] * np.array([pixel, pixel, -pixel])
        write_glb(file, GlbMesh(place, normals, faces, colours, extras=facts))


def _opened(
    points: np.ndarray, faces: np.ndarray, normals: np.ndarray, colours: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Returns a closed body whose walls and base have corners of their own, for their normals."""
    ground = len(normals)
    outer = (faces >= ground).any(axis=1)
    corners = points[faces[outer]]
    flat = np.asarray(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
    flat = flat[:, [0, 2, 1]] * [1.0, 1.0, -1.0]
    count = 3 * len(corners)
    around = np.arange(ground, ground + count).reshape(-1, 3)
    shade = np.broadcast_to(np.float32(0.2), (count, 3))
    return (
        np.concatenate([points[:ground], corners.reshape(-1, 3)]),
        np.concatenate([faces[~outer], around]),
        np.concatenate([normals, np.repeat(flat, 3, axis=0)]),
        np.concatenate([colours, shade]),
    )
