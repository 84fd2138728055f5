"""The maker `solid`: a flat slice through a material of three dimensions (Heeger & Bergen 1995, section 6)."""

from __future__ import annotations

import numpy as np

from engine.checks.values import is_number
from engine.files.strict_json import Fields
from engine.makers.lewis import Sample
from engine.numeric.grid import snapped
from engine.painting.capture import PictureSource
from engine.painting.commands import SEED_LIMIT
from engine.solids.material_sliders import MATERIALS
from engine.solids.slicing import STEEPEST, Slice, sliced

_UNITS = 16, 512  # pixels of a unit


def of_solid(members: Fields, place: PictureSource) -> Sample:
    """Returns the slice that the members `material`, `values`, `normal`, `depth`, `unit` and `seed` tell."""
    colours = sliced(slice_of(members))
    out = np.ones((4, *colours.shape[1:]), np.float32)
    out[:3] = np.clip(colours, 0.0, 1.0)
    return Sample(snapped(out))


def slice_of(members: Fields) -> Slice:
    """Returns the slice that a definition asks for; FieldError names the member that is wrong."""
    name = members.take("material")
    if not isinstance(name, str) or name not in MATERIALS:
        raise members.fault("material", f"one of {', '.join(MATERIALS)}")
    normal = members.integers("normal", 3, (0, 0, 1), limit=STEEPEST)
    if not any(normal):
        raise members.fault("normal", "three whole numbers that are not all 0")
    values = members.take("values", {})
    sliders = MATERIALS[name].sliders
    told = ", ".join(f"{key} from {row.low:g} to {row.high:g}" for key, row in sliders.items())
    if not isinstance(values, dict) or not all(
        key in sliders and is_number(value) and sliders[key].low <= value <= sliders[key].high
        for key, value in values.items()
    ):
        raise members.fault("values", told)
    seed = members.integer("seed", 0, lo=-SEED_LIMIT, hi=SEED_LIMIT)
    depth = members.number("depth", 0.0, lo=-1e6, hi=1e6)
    return Slice(name, seed, values, normal, depth, members.integer("unit", 256, lo=_UNITS[0], hi=_UNITS[1]))
