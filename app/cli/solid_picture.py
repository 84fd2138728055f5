"""Show an object made of a solid: a procedural material, a cube of texture, or one grown from an example."""

from __future__ import annotations

import argparse
import json
import os
import re
from typing import TYPE_CHECKING

from app.cli import match_command
from app.cli.arguments import seed, size
from app.cli.outcome import DONE, Refused
from app.cli.output import checked_output, opened_painting
from app.cli.progress import Progress

if TYPE_CHECKING:
    import numpy as np

    from engine.solids.mesh import Mesh
    from engine.solids.solid_lookup import Lookup
    from engine.solids.solid_rendering import Body

_PIXELS = 64 << 20
_CUBES = "a cube: P.npy, a folder of slices, or a picture of them in a column"
MOST_SAMPLES = 6
_Facts = dict[str, int | float | list[int]]


def declare(parser: argparse.ArgumentParser) -> None:
    """Declares the command's arguments."""
    from engine.solids.baked import ENOUGH, FEWEST, MOST
    from engine.solids.material_sliders import MATERIALS
    from engine.solids.mesh_files import READERS

    known = ", ".join(MATERIALS)
    parser.add_argument("solid", metavar="SOLID", help=f"{known}; {_CUBES}; or a picture, from which one grows")
    parser.add_argument("out", metavar="OUT", help="OUT.png, a picture; or OUT.glb, a mesh in the colours of the solid")
    parser.add_argument(
        "--on",
        metavar="OBJECT",
        default="sphere",
        help=f"sphere, cube, torus, vase, teapot, knot, bust, or a mesh: {', '.join(READERS)} (default sphere)",
    )
    parser.add_argument("--turn", type=_angles, default=(25.0, 0.0), metavar="A,B", help="degrees round, and forwards")
    parser.add_argument("--scale", type=_positive, default=0.42, metavar="S", help="of the solid (default 0.42)")
    parser.add_argument("--size", type=size, metavar="WxH", help="pixels of a picture (default 1280x800)")
    wraps = "wrap SOLID, a picture that tiles, around the object without a seam, in place of carving"
    parser.add_argument("--map", action="store_true", help=wraps)
    drawn = "draw a picture out into the solid, under a signal along it, in place of growing one"
    parser.add_argument("--drawn", action="store_true", help=drawn)
    parser.add_argument("--seed", type=seed, default=0, metavar="S", help="another seed, another solid (default 0)")
    parser.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE", help="a slider of the material; may be repeated"
    )
    parser.add_argument(
        "--samples",
        type=match_command.whole(1, MOST_SAMPLES),
        metavar="N",
        help="N x N samples of each pixel of a picture (default 3)",
    )
    parser.add_argument(
        "--triangles",
        type=match_command.whole(FEWEST, MOST),
        metavar="N",
        help=f"of a mesh at most; the more, the finer its colours (default {ENOUGH})",
    )
    parser.add_argument("--touches", metavar="P.ora", help="with what is painted in it on the solid of this name")
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def run(options: argparse.Namespace) -> int:
    """Carries the command out; returns the exit status."""
    checked_output(options.out, (".png", ".glb"))
    facts = _mesh_facts(options) if options.out.lower().endswith(".glb") else _picture_facts(options)
    told = {"written": options.out} | facts | {"on": options.on}
    if options.json:
        print(json.dumps(told))
    else:
        print(f"wrote {options.out}: " + ", ".join(f"{name} {value}" for name, value in facts.items()))
    return DONE


def _picture_facts(options: argparse.Namespace) -> _Facts:
    """Writes the picture; returns what is told of it."""
    if options.triangles is not None:
        raise Refused("--triangles: found one for a picture, expected OUT.glb")
    width, height = options.size or (1280, 800)
    if width * height > _PIXELS:
        raise Refused(f"--size: found {width * height:,} pixels, expected at most {_PIXELS:,}")
    from engine.solids.solid_rendering import framed

    body = _body(options)
    scene = framed([body])
    with Progress("drawing", height) as tell:
        pixels = scene.picture((width, height), options.samples or 3, tell)
    match_command.write(options.out, pixels)
    return {"size": [width, height], "triangles": len(body.mesh.faces)}


def _mesh_facts(options: argparse.Namespace) -> _Facts:
    """Writes the mesh; returns what is told of it."""
    for option in ("size", "samples"):
        if getattr(options, option) is not None:
            raise Refused(f"--{option}: found one for a mesh, expected OUT.png")
    from engine.files.atomic import replacing
    from engine.files.spatial.glb_writer import GlbMesh, write_glb
    from engine.solids.baked import ENOUGH, colours_baked, turned_upright
    from engine.terrain.drape import linear

    body, most = _body(options), options.triangles or ENOUGH
    if len(body.mesh.faces) > most:
        raise Refused(f"--triangles: found {most:,}, expected at least the {len(body.mesh.faces):,} of {options.on}")
    with Progress("dividing", most) as tell:
        made = colours_baked(body, most, tell)
    name = os.path.splitext(os.path.basename(options.out))[0]
    points, normals = turned_upright(made.points), turned_upright(made.normals)
    rough = 1.0 - 0.8 * body.solid.gloss
    with replacing(options.out) as file:
        write_glb(file, GlbMesh(points, normals, made.faces, linear(made.colours), name, rough))
    return {"triangles": len(made.faces), "vertices": len(made.points), "error": round(made.error, 4)}


def _angles(text: str) -> tuple[float, float]:
    if not re.fullmatch(r"-?[0-9]{1,6}(\.[0-9]{1,6})?,-?[0-9]{1,6}(\.[0-9]{1,6})?", text):
        raise argparse.ArgumentTypeError(f"found {text[:40]!a}, expected A,B: degrees")
    about, tilt = text.split(",")
    return float(about), float(tilt)


def _positive(text: str) -> float:
    if not re.fullmatch(r"[0-9]{1,6}(\.[0-9]{1,6})?", text) or not 1e-4 <= float(text) <= 1000.0:
        raise argparse.ArgumentTypeError(f"found {text[:40]!a}, expected a number from 0.0001 to 1000")
    return float(text)


def _object(name: str) -> Mesh:
    from engine.solids.mesh_files import read_mesh
    from engine.solids.objects import OBJECTS, object_named

    if name in OBJECTS:
        return object_named(name)
    if not os.path.exists(name):
        raise Refused(f"--on: found {name[:80]!a}, expected {', '.join(OBJECTS)}, or a mesh that is there")
    return read_mesh(name)


def _solid(options: argparse.Namespace) -> Lookup:
    from engine.solids.material_sliders import MATERIALS
    from engine.solids.solid_lookup import Cubed, Procedural

    name = options.solid
    if options.map and (name in MATERIALS or name.lower().endswith(".npy")):
        raise Refused(f"--map: found {name[:80]!a}, expected a picture that tiles")
    if name in MATERIALS:
        return Procedural(name, options.seed, _values(name, options.set))
    if options.set:
        raise Refused(f"--set: found one for {name[:80]!a}, expected a material: {', '.join(MATERIALS)}")
    if not os.path.exists(name):
        raise Refused(f"{name}: no such file, and no material: {', '.join(MATERIALS)}")
    if options.map:
        from engine.solids.object_map import ObjectMap

        return ObjectMap.of(match_command.read(name, options.out).planes[:3], options.on, options.scale)
    from engine.solids.cube_files import is_column, read_cube

    known = name.lower().endswith(".npy") or os.path.isdir(name)
    if known or (name.lower().endswith(".png") and is_column(name)):
        return Cubed(read_cube(name), seed=options.seed)
    return Cubed(_grown(name, options), seed=options.seed)


def _values(name: str, given: list[str]) -> dict[str, float]:
    """The sliders of a material that were set."""
    from engine.solids.material_sliders import MATERIALS

    sliders = MATERIALS[name].sliders
    out = {}
    for text in given:
        found = re.fullmatch(r"([a-z]+)=(-?[0-9]{1,6}(?:\.[0-9]{1,6})?)", text)
        row = sliders.get(found.group(1)) if found else None
        if found is None or row is None or not row.low <= float(found.group(2)) <= row.high:
            known = ", ".join(f"{key}={row.low:g}..{row.high:g} ({row.about})" for key, row in sliders.items())
            raise Refused(f"--set: found {text[:40]!a}, expected {known}")
        out[found.group(1)] = float(found.group(2))
    return out


def _grown(path: str, options: argparse.Namespace) -> np.ndarray:
    """The cube that grows from an example: float32 (z, y, x, 3)."""
    from engine.solids.cube_growing import drawn_cube, growing_cube

    grow = drawn_cube if options.drawn else growing_cube
    example, cube = match_command.read(path, options.out), None
    with match_command.threads() as pool, Progress("growing", 100) as bar:
        for step in grow(example.planes, options.seed, threads=pool):
            bar.part(step.done)
            cube = step.cube
    assert cube is not None
    return cube


def _body(options: argparse.Namespace) -> Body:
    from engine.solids.solid_rendering import Body, turning

    mesh = _object(options.on)
    return Body(mesh, _touched(_solid(options), options), turning(*options.turn), scale=options.scale).standing()


def _touched(solid: Lookup, options: argparse.Namespace) -> Lookup:
    """The solid with what is painted on it in a painting."""
    if options.touches is None:
        return solid
    if options.map:
        raise Refused("--touches: found it with --map, expected a solid")
    from engine.painting.layering.touch_command import VOXELS
    from engine.solids.painted.touching import Touched

    name = os.path.splitext(os.path.basename(options.solid))[0]
    strokes = opened_painting(options.touches).painting.touches.get(name)
    if strokes is None:
        raise Refused(f"--touches: found no paint on {name[:80]!a} in {options.touches}, expected some")
    return Touched(solid, strokes, VOXELS)
