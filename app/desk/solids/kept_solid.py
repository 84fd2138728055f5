"""What a window remembers of the panel of solids: the material with its sliders, the object, how it is cut."""

from __future__ import annotations

from dataclasses import dataclass, field

from immutables import Map

from app.desk.solids.solid_state import (
    DEEPEST_SLICE,
    OBJECTS,
    SOLID_SCALES,
    USUAL_DEPTH,
    USUAL_MATERIAL,
    USUAL_OBJECT,
    USUAL_SCALE,
    SolidState,
)
from engine.checks.field_error import FieldError
from engine.checks.values import described, is_within
from engine.solids.material_sliders import MATERIALS

_MOST_SEED = (1 << 31) - 1
_Set = Map[str, float]  # values by sliders' names


@dataclass(frozen=True, slots=True)
class KeptSolid:
    """As the members of `SolidState` have it; a cube or a mesh of one's own is not kept: its file may be gone."""

    material: str = USUAL_MATERIAL
    name: str = USUAL_OBJECT
    seed: int = 1
    values: Map[str, _Set] = field(default_factory=Map)
    scale: float = USUAL_SCALE
    depth: float = USUAL_DEPTH

    @classmethod
    def of(cls, state: SolidState) -> KeptSolid:
        """Returns what is to be remembered of a panel."""
        usual = cls()
        values = {name: Map(found) for name, found in state.values.items() if name in MATERIALS and found}
        return cls(
            state.material if state.material in MATERIALS else usual.material,
            state.name if state.name in OBJECTS else usual.name,
            state.seed,
            Map(values),
            state.scale,
            state.depth,
        )

    def lay(self, state: SolidState) -> None:
        """Has a panel begin with it."""
        state.material, state.name, state.seed = self.material, self.name, self.seed
        state.values = {name: dict(found) for name, found in self.values.items()}
        state.scale, state.depth = self.scale, self.depth


def solid_json(kept: KeptSolid) -> dict[str, object]:
    """Returns the object that a file holds."""
    values = {name: dict(sorted(found.items())) for name, found in sorted(kept.values.items())}
    told = {"material": kept.material, "name": kept.name, "seed": kept.seed, "scale": kept.scale, "depth": kept.depth}
    return told | ({"values": values} if values else {})


def solid_of(told: object) -> KeptSolid:
    """Returns what an object of a file tells; FieldError where a number is none.  What there is not, of a newer program
    perhaps, is as it comes."""
    found = _object(told, "solid")
    usual = KeptSolid()
    material, name = found.get("material", usual.material), found.get("name", usual.name)
    values = {}
    for one, given in _object(found.get("values", {}), "solid.values").items():
        sliders = MATERIALS[one].sliders if one in MATERIALS else {}
        numbers = _object(given, f"solid.values.{one}")
        bounds = {slider: (row.low, row.high) for slider, row in sliders.items() if slider in numbers}
        values[one] = Map({slider: _number(numbers, slider, within) for slider, within in bounds.items()})
    return KeptSolid(
        material if isinstance(material, str) and material in MATERIALS else usual.material,
        name if isinstance(name, str) and name in OBJECTS else usual.name,
        int(_number({"seed": usual.seed} | found, "seed", (0, _MOST_SEED), whole=True)),
        Map({one: numbers for one, numbers in values.items() if numbers}),
        _number({"scale": usual.scale} | found, "scale", SOLID_SCALES),
        _number({"depth": usual.depth} | found, "depth", (0.0, DEEPEST_SLICE)),
    )


def _object(found: object, place: str) -> dict[str, object]:
    if not isinstance(found, dict):
        raise FieldError(place, described(found), "an object")
    return found


def _number(found: dict[str, object], name: str, within: tuple[float, float], whole: bool = False) -> float:
    value = found[name]
    if not (isinstance(value, float | int) and is_within(value, *within, whole=whole)):
        raise FieldError(f"solid.{name}", described(value), f"a number from {within[0]:g} to {within[1]:g}")
    return value
