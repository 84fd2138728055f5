"""What Photoshop's brushes from version 6 on tell of how their tips are painted with."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from engine.files.brushes.descriptor import CLASS_TOLD
from engine.files.brushes.found_brush import (
    MOST_BRUSHES,
    ByName,
    FoundBrush,
    FoundBrushes,
    called,
    radius_of,
    spacing_of,
    stamp_settings,
)

_SPACING = 25.0  # percent of the diameter, where nothing is said
_PRESSURE, _FIRST_WAY, _WAY = 2, 6, 7  # what is followed
_LEFT = {  # what cannot be painted with here, by the switch that turns it on
    "useTexture": "a pattern",
    "useColorDynamics": "changes of colour",
    "Wtdg": "wet edges",
    "Nose": "noise",
    "flipX": "mirrored dabs",
    "flipY": "mirrored dabs",
}


class SampledTip(NamedTuple):
    """A picture, uint8 (n, n), the radius of the circle around it, and the longer side of what it was before, px."""

    square: np.ndarray
    radius: float
    longest: int


def painted_with(tips: Mapping[str, SampledTip], told: list[object], file: str, found: FoundBrushes) -> None:
    """Adds a brush for each that is told, and for each tip that none of them has."""
    used = set()
    for number, preset in enumerate(told[:MOST_BRUSHES], 1):
        own = preset.get("Brsh") if isinstance(preset, dict) else None
        if not isinstance(preset, dict) or not isinstance(own, dict):
            continue
        name = called(_text(preset, "Nm  "), file, number)
        tip = tips.get(_text(own, "sampledData"))
        if "sampledData" in own and tip is None:
            found.left.append(f"“{name}”, whose tip is not there")
        elif own.get(CLASS_TOLD) not in ("sampledBrush", "computedBrush"):
            found.left.append(f"“{name}”, of bristles or worn down")
        else:
            used.add(_text(own, "sampledData"))
            found.brushes.append(_brush(name, own, preset, tip))
    if len(told) > MOST_BRUSHES:
        found.left.append(f"all but {MOST_BRUSHES} brushes")
    for number, (known, tip) in enumerate(tips.items(), 1):
        if known not in used and len(found.brushes) < MOST_BRUSHES:
            settings = stamp_settings((tip.square, tip.radius), 1.0, _SPACING / 100.0 * tip.longest)
            found.brushes.append(FoundBrush(called("", file, number), settings, tip.square))


def _brush(name: str, own: ByName, preset: ByName, tip: SampledTip | None) -> FoundBrush:
    wide = _number(own, "Dmtr", 0.0 if tip is None else float(tip.longest))
    step = _number(own, "Spcn", _SPACING) / 100.0
    if tip is None:
        hardness = min(max(_number(own, "Hrdn", 100.0) / 100.0, 0.0), 1.0)
        settings: ByName = {"radius": radius_of(wide / 2.0), "hardness": hardness, "spacing": spacing_of(2.0 * step)}
    else:
        settings = stamp_settings((tip.square, tip.radius), max(wide, 0.1) / tip.longest, step * tip.longest)
    shape: ByName = {
        "ratio": min(max(_number(own, "Rndn", 100.0) / 100.0, 0.01), 1.0),
        "angle": -_number(own, "Angl", 0.0) % 360.0,
    }
    dynamics: ByName = {}
    if preset.get("useTipDynamics") is True:
        _follow_shape(preset, shape, dynamics)
    if preset.get("usePaintDynamics") is True:
        for target, member in (("flow", "prVr"), ("opacity", "opVr")):
            if _control(preset, member) == _PRESSURE:
                dynamics[target] = [[0.0, 0.0], [1.0, 1.0]]
    if preset.get("useScatter") is True:
        shape["scatter"] = min(max(_jitter(preset, "scatterDynamics") / 50.0, 0.0), 16.0)
        shape["count"] = min(max(round(_number(preset, "Cnt ", 1.0)), 1), 16)
    left = [words for switch, words in _LEFT.items() if preset.get(switch) is True]
    if _flag(preset.get("dualBrush"), "useDualBrush"):
        left.append("a second tip")
    settings = {**settings, "shape": shape, "dynamics": dynamics}
    return FoundBrush(name, settings, None if tip is None else tip.square, tuple(dict.fromkeys(left)))


def _follow_shape(preset: ByName, shape: ByName, dynamics: ByName) -> None:
    """Has the tip's size and angle follow what they followed."""
    if _control(preset, "szVr") == _PRESSURE:
        least = min(max(_number(preset, "minimumDiameter", 0.0) / 100.0, 0.0), 1.0)
        dynamics["radius"] = [[0.0, least], [1.0, 1.0]]
    if _control(preset, "angleDynamics") in (_FIRST_WAY, _WAY):
        shape["follow"] = "direction"
    spread = min(max(_jitter(preset, "angleDynamics") / 100.0, 0.0), 1.0) / 2.0
    if spread:
        dynamics["angle"] = {"random_dab": [[0.0, 1.0 - spread], [1.0, 1.0 + spread]]}


def _text(members: ByName, name: str) -> str:
    value = members.get(name)
    return value if isinstance(value, str) else ""


def _number(members: ByName, name: str, usual: float) -> float:
    value = members.get(name)
    if isinstance(value, bool) or not isinstance(value, int | float):
        return usual
    return min(max(float(value), -1e6), 1e6) if math.isfinite(value) else usual


def _flag(members: object, name: str) -> bool:
    return isinstance(members, dict) and members.get(name) is True


def _control(preset: ByName, name: str) -> int:
    members = preset.get(name)
    return int(_number(members, "bVTy", 0.0)) if isinstance(members, dict) else 0


def _jitter(preset: ByName, name: str) -> float:
    members = preset.get(name)
    return _number(members, "jitter", 0.0) if isinstance(members, dict) else 0.0
