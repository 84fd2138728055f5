"""The maker `solid`: a flat slice through a material of three dimensions (Heeger & Bergen 1995, section 6)."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from engine.checks.values import is_number
from engine.files.fault import FileError
from engine.files.strict_json import Fields
from engine.makers.lewis import Sample
from engine.numeric.grid import snapped
from engine.painting.capture import PictureSource
from engine.painting.commands import SEED_LIMIT
from engine.painting.layering.touch_command import NO_TOUCHES, VOXELS, Touches
from engine.solids.cube_files import read_cube
from engine.solids.material_sliders import MATERIALS
from engine.solids.painted.touching import Touched
from engine.solids.slicing import STEEPEST, Slice, sliced
from engine.solids.solid_lookup import Cubed, Lookup, Procedural

_UNITS = 16, 512  # pixels of a unit


def of_solid(members: Fields, place: PictureSource) -> Sample:
    """Returns the slice that the members `material` and `values`, or `cube`, and `normal`, `depth`, `unit` and `seed`
    tell; with the paint on the solid that `touches` names."""
    colours = sliced(slice_of(members, place.folder, place.touches))
    out = np.ones((4, *colours.shape[1:]), np.float32)
    out[:3] = np.clip(colours, 0.0, 1.0)
    return Sample(snapped(out))


def slice_of(members: Fields, folder: Path | None = None, touches: Touches = NO_TOUCHES) -> Slice:
    """Returns the slice that a definition asks for; FieldError names the member that is wrong, FileError the cube that
    cannot be read.  A relative path starts from `folder`."""
    bare = _cubed(members, folder) if "cube" in members else _procedural(members)
    solid = _touched(bare, members, touches) if "touches" in members else bare
    normal = members.integers("normal", 3, (0, 0, 1), limit=STEEPEST)
    if not any(normal):
        raise members.fault("normal", "three whole numbers that are not all 0")
    depth = members.number("depth", 0.0, lo=-1e6, hi=1e6)
    return Slice(solid, normal, depth, members.integer("unit", 256, lo=_UNITS[0], hi=_UNITS[1]))


def _touched(bare: Lookup, members: Fields, touches: Touches) -> Touched:
    name = members.text("touches")
    if name not in touches:
        raise members.fault("touches", "the name of a solid that was painted on")
    return Touched(bare, touches[name], VOXELS)


def _cubed(members: Fields, folder: Path | None) -> Cubed:
    if "material" in members:
        raise members.fault("material", "either material or cube")
    path = members.text("cube", cap=4096)
    where = Path(path) if folder is None else folder / path
    if not where.is_file() and not where.is_dir():  # also so that no pipe or device is opened
        raise FileError(path, f"found no cube there, expected a file or a folder of slices ({where})")
    return Cubed(read_cube(str(where)), seed=_seed(members))


def _seed(members: Fields) -> int:
    found: int = members.integer("seed", 0, lo=-SEED_LIMIT, hi=SEED_LIMIT)
    return found


def _procedural(members: Fields) -> Procedural:
    name = members.take("material")
    if not isinstance(name, str) or name not in MATERIALS:
        raise members.fault("material", f"one of {', '.join(MATERIALS)}")
    values = members.take("values", {})
    sliders = MATERIALS[name].sliders
    told = ", ".join(f"{key} from {row.low:g} to {row.high:g}" for key, row in sliders.items())
    if not isinstance(values, dict) or not all(
        key in sliders and is_number(value) and sliders[key].low <= value <= sliders[key].high
        for key, value in values.items()
    ):
        raise members.fault("values", told)
    return Procedural(name, _seed(members), values)
