"""Solid textures, `inkfall texture solid`: a cube grown from an example, written as an array or as slices."""

from __future__ import annotations

import os
import secrets
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from app.cli import match_command
from app.cli.arguments import Parser
from app.cli.outcome import DONE, Failed, Refused
from app.cli.output import checked_output

if TYPE_CHECKING:
    import numpy as np

SIDES = 4, 2048
SLICES = 5  # of the cube, on the sheet
_GAP = 4  # pixels between pictures on the sheet
SHADES = (1.0, 0.86, 0.72)  # of the top, the left and the right face
ITERATIONS = 6
EACH = 64  # bytes of memory for each channel of a voxel


def run(words: list[str]) -> int:
    """Carries the command out; returns the exit status."""
    given = _parser().parse_args(words)
    write = _writer(given.out)
    checked_output(given.png, (".png",))
    example = match_command.read(given.example, given.out)
    side = given.size
    match_command.check_memory(side**3, [example], f"{side}, a cube of {side} voxels each way", EACH)
    from engine.texture import solid
    from engine.texture.matching import Shape, matched_colours

    shape = Shape("steerable", given.levels, given.orientations)
    wanted = solid.patterns(example.planes, side, shape)
    start = solid.noise(wanted.oriented.colours.count, side, given.seed)
    with match_command.threads() as pool:
        cubes = match_command.finished("growing", solid.matching(wanted, start, given.iterations, pool))
    voxels = _voxels(matched_colours(wanted.oriented, cubes), given.depth or example.bits)
    write(voxels)
    facts = match_command.summary(given, wanted.oriented.shape, voxels) | {"size": [side, side, side]}
    if given.png is not None:
        match_command.write(given.png, sheet(voxels))
        facts["sheet"] = given.png
    match_command.tell(given, facts)
    return DONE


def _parser() -> Parser:
    parser = Parser(
        prog="inkfall texture solid",
        description="A cube of texture, every plane through which looks like the example; seamless in three directions",
        allow_abbrev=False,
    )
    parser.add_argument("example", metavar="EXAMPLE", help=match_command.PICTURE)
    parser.add_argument("--out", metavar="OUT", required=True, help="P.npy, an array (z, y, x, channels); or a folder")
    parser.add_argument(
        "--size", type=match_command.whole(*SIDES), default=64, metavar="N", help="voxels a side (default 64)"
    )
    parser.add_argument("--png", metavar="P.png", help="a sheet: a row of slices, and the cube")
    match_command.add_common(parser, ITERATIONS)
    return parser


def _writer(out: str) -> Callable[[np.ndarray], None]:
    """Returns what writes voxels to a place that was looked at first."""
    if out.lower().endswith(".npy"):
        checked_output(out, (".npy",))
        return lambda voxels: _write_array(out, voxels)
    folder = Path(out)
    if folder.suffix:
        raise Refused(f"{out}: found the ending {folder.suffix}, expected .npy, or a folder")
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise Refused(f"{out}: found something there, expected a new folder or an empty one")
    if not folder.parent.is_dir():
        raise Failed(f"{out}: there is no folder {folder.parent}")
    return lambda voxels: _write_slices(folder, voxels)


def _voxels(colours: np.ndarray, bits: int) -> np.ndarray:
    """(z, y, x, C), uint8 or uint16, of colours (C, z, y, x)."""
    count, depth, height, width = colours.shape
    pixels = match_command.pixels_of(colours.reshape(count, depth * height, width), bits)
    return pixels.reshape(depth, height, width, count)


def _write_array(path: str, voxels: np.ndarray) -> None:
    import numpy as np

    from engine.files.atomic import replacing

    with replacing(path) as file:
        np.save(file, voxels[..., 0] if voxels.shape[-1] == 1 else voxels)


def _write_slices(folder: Path, voxels: np.ndarray) -> None:
    """slice-0000.png and so on.  The folder takes its name when all are in it."""
    part = folder.with_name(f".{folder.name}.{secrets.token_hex(4)}.part")
    part.mkdir()
    try:
        for z, pixels in enumerate(voxels):
            match_command.write(str(part / f"slice-{z:04}.png"), pixels)
        if folder.exists():
            folder.rmdir()
        os.rename(part, folder)
    finally:
        shutil.rmtree(part, ignore_errors=True)


def sheet(voxels: np.ndarray) -> np.ndarray:
    """Returns a row of slices and the cube, for the eye: uint8 RGB (h, w, 3) of voxels (n, n, n, C), transparency as
    grey."""
    import numpy as np

    n, channels = len(voxels), voxels.shape[-1]
    seen = voxels.astype(np.float32) / np.iinfo(voxels.dtype).max
    if channels == 4:
        seen = seen[..., :3] * seen[..., 3:] + 0.5 * (1.0 - seen[..., 3:])
    seen = np.repeat(seen, 3, axis=-1) if channels == 1 else seen
    scale = max(1, 128 // n)
    places = [n * k // SLICES for k in range(SLICES)]
    row = [np.repeat(np.repeat(seen[z], scale, axis=0), scale, axis=1) for z in places]
    drawn = cube(seen, n * scale)
    height = max(len(drawn), n * scale)
    padded = []
    for picture in [*row, drawn]:
        above = (height - len(picture)) // 2
        below = height - len(picture) - above
        padded.append(np.pad(picture, ((above, below), (0, _GAP), (0, 0)), constant_values=1.0))
    return np.rint(np.concatenate(padded, axis=1) * 255.0).astype(np.uint8)


def cube(seen: np.ndarray, edge: int) -> np.ndarray:
    """Three faces of a cube (n, n, n, 3), z downwards, in isometric projection: (2 edge, 1.73 edge, 3), on white."""
    import numpy as np

    n = len(seen)
    half = 0.75**0.5 * edge
    y, x = np.mgrid[0.5 : 2 * edge, 0.5 : int(2 * half)]
    right, down = (x - half) / half, y / edge  # in edges of the cube, from its uppermost corner
    out = np.ones((*right.shape, 3), np.float32)
    # On each face a point is its uppermost or leftmost corner and u and v, 0..1, along two edges.
    faces = (
        (down + 0.5 * right, down - 0.5 * right, seen[0].swapaxes(0, 1)),  # z = 0, by x and y
        (right + 1.0, down - 0.5 * right - 1.0, seen[:, n - 1].swapaxes(0, 1)),  # y = n - 1, by x and z
        (1.0 - right, down + 0.5 * right - 1.0, seen[:, :, n - 1].swapaxes(0, 1)),  # x = n - 1, by y and z
    )
    sides = (np.ones_like(right, bool), right < 0.0, right >= 0.0)
    for (u, v, face), side, shade in zip(faces, sides, SHADES, strict=True):
        inside = side & (u >= 0.0) & (u < 1.0) & (v >= 0.0) & (v < 1.0)
        out[inside] = shade * face[(u[inside] * n).astype(int), (v[inside] * n).astype(int)]
    return out
