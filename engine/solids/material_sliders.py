"""The materials by name, and what can be set of each; light, for the window lists them before anything is carved."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

Values = Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Slider:
    """A parameter: what it is, its least, usual and greatest value; `whole`: only whole numbers keep the solid free of
    seams."""

    about: str
    low: float
    usual: float
    high: float
    whole: bool = False


@dataclass(frozen=True, slots=True)
class Material:
    """`gloss`: how much it mirrors, 0..1."""

    about: str
    gloss: float
    sliders: Mapping[str, Slider]

    def values(self, given: Values) -> dict[str, float]:
        """Returns the values of all sliders, those given within their bounds and whole where they must be."""
        out = {}
        for name, slider in self.sliders.items():
            value = min(max(float(given.get(name, slider.usual)), slider.low), slider.high)
            out[name] = float(round(value)) if slider.whole else value
        return out


# The ways of Heeger & Bergen's section 6, for every material: a solid moved by noise, multiplied by another one, and by
# a signal of one dimension.
_WARP = Slider("how far noise bends the whole block", 0.0, 0.0, 1.0)
_STRATA = Slider("dark layers across the block's upright axis", 0.0, 0.0, 1.0)
_SPECKLED = {"warp": _WARP, "strata": _STRATA, "speckle": Slider("granite laid over it, as a glaze", 0.0, 0.0, 1.0)}
_VEINED = {"warp": _WARP, "strata": _STRATA, "cloud": Slider("marble laid over it, as a glaze", 0.0, 0.0, 1.0)}
_VEINS = Slider("veins in a unit", 1.0, 2.0, 12.0, whole=True)
MATERIALS: dict[str, Material] = {
    "marble": Material(
        "ramps of sines that noise has moved",
        0.7,
        {
            "veins": _VEINS,
            "turbulence": Slider("how far noise moves them", 0.0, 0.75, 3.0),
            "sharpness": Slider("how thin they are", 2.0, 14.0, 60.0),
            "gold": Slider("gold in thin veins", 0.0, 0.6, 1.0),
            "green": Slider("0 white, 1 green stone", 0.0, 0.0, 1.0),
            **_SPECKLED,
        },
    ),
    "wood": Material(
        "rings around an axis, fibres and pores along it",
        0.25,
        {
            "rings": Slider("rings from the axis to the farthest place", 4.0, 26.0, 120.0),
            "bend": Slider("how far noise bends them", 0.0, 1.0, 4.0),
            "fibres": Slider("fibres and pores", 0.0, 1.0, 2.0),
            **_VEINED,
        },
    ),
    "granite": Material(
        "three minerals, each where band-passed noise is high",
        0.4,
        {
            "grains": Slider("grains in a unit", 4.0, 28.0, 120.0, whole=True),
            "pink": Slider("how much feldspar", 0.0, 0.5, 1.0),
            "mica": Slider("how much mica", 0.0, 0.5, 1.0),
            **_VEINED,
        },
    ),
    "agate": Material(
        "bands of a one-dimensional signal around hollows",
        0.85,
        {"bands": Slider("bands from the rim to the middle of a hollow", 4.0, 22.0, 96.0), **_SPECKLED},
    ),
}
