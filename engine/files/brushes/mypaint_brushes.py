"""Brushes of MyPaint, `.myb` of version 3: settings by name, each a base value and curves by input that add to it.

After libmypaint's "brushsettings.json".  MyPaint paints dab over dab as this program does where opacity is 1: its
opacity of a dab is flow here.
"""

from __future__ import annotations

import colorsys
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise

from engine.checks.field_error import FieldError
from engine.checks.values import is_within
from engine.files import strict_json
from engine.files.brushes.found_brush import ByName, FoundBrush, FoundBrushes, called, radius_of, spacing_of
from engine.files.brushes.mypaint_inputs import (
    INPUTS_THERE,
    AddedCurve,
    Scale,
    added_at,
    knots_of_curve,
    multiplied,
    multiplying,
    resting,
)
from engine.files.fault import FileError

_VERSION = 3
_MOST_SETTINGS, _MOST_POINTS = 256, 64
_FAR = 1e6  # of any number
_NORMAL = ((0.02, -2.05), (0.16, -1.0), (0.5, 0.0), (0.84, 1.0), (0.98, 2.05))  # part of all, deviations
_USUAL = {  # base values where nothing is said; 0 of all others
    "radius_logarithmic": 2.0,
    "hardness": 0.8,
    "opaque": 1.0,
    "opaque_multiply": 1.0,
    "opaque_linearize": 0.9,
    "dabs_per_actual_radius": 2.0,
    "elliptical_dab_ratio": 1.0,
    "elliptical_dab_angle": 90.0,
    "speed1_gamma": 4.0,
    "speed2_gamma": 4.0,
    "stroke_duration_logarithmic": 4.0,
    "smudge_length": 0.5,
}
# Settings of which nothing is told: they are read where they count, or change little.
_SILENT: tuple[str, ...] = (
    "color_",
    "custom_",
    "speed",
    "stroke_",
    "smudge_",
    "anti_aliasing",
    "direction_filter",
    "restore_color",
)
_SILENT += ("opaque_linearize", "offset_by_speed_slowness", "slow_tracking_per_dab", "pressure_gain_log")
_SILENT += ("elliptical_dab_angle", "gridmap", "offset_multiplier", "paint_mode", "posterize_num", "snap_to_pixel")
_WORDS = {"dabs_per_second": "dabs while the pen rests", "eraser": "erasing by parts"}


@dataclass(frozen=True, slots=True)
class _Setting:
    base: float
    curves: dict[str, AddedCurve] = field(default_factory=dict)


class _Settings:
    """The settings of a file; `left`: what of them cannot be painted with here."""

    def __init__(self, members: ByName) -> None:
        self._all = {name: _setting(value, f"settings.{name}") for name, value in members.items()}
        self._asked: set[str] = set()
        self._inputs: set[str] = set()
        gammas = math.exp(min(self.base("speed1_gamma"), 10.0)), math.exp(min(self.base("speed2_gamma"), 10.0))
        stroke = math.exp(min(max(self.base("stroke_duration_logarithmic"), -2.0), 12.0))
        radius = _radius(self.base("radius_logarithmic") + resting(self.curves("radius_logarithmic")))
        self.scale = Scale(radius, gammas, stroke)

    def base(self, name: str) -> float:
        """Returns a setting's base value."""
        self._asked.add(name)
        found = self._all.get(name)
        return _USUAL.get(name, 0.0) if found is None else found.base

    def curves(self, name: str) -> dict[str, AddedCurve]:
        """Returns those of its curves whose inputs are here."""
        self._asked.add(name)
        found = self._all.get(name)
        every = {} if found is None else found.curves
        known = {there: points for there, points in every.items() if there in INPUTS_THERE}
        self._inputs |= set(every) - set(known)
        if "speed1" in known and known.pop("speed2", []):
            self._inputs.add("speed2")
        if "direction" in known and known.pop("direction_angle", []):
            self._inputs.add("direction_angle")
        return known

    def follow(self, name: str, form: Callable[[float], float]) -> tuple[float, dict[str, AddedCurve]]:
        """Returns a setting's value and the curves of it, as `multiplying` does."""
        return multiplying(self.base(name), self.curves(name), self.scale, form)

    def left(self) -> tuple[str, ...]:
        """Returns what was never asked for and counts, in words."""
        unasked = (name for name, found in self._all.items() if name not in self._asked and _counts(name, found))
        words = [_WORDS.get(name, name.replace("_", " ")) for name in sorted(unasked)]
        return (*words, *(f"what follows {name.replace('_', ' ')}" for name in sorted(self._inputs)))


def _counts(name: str, found: _Setting) -> bool:
    return not name.startswith(_SILENT) and (bool(found.curves) or abs(found.base - _USUAL.get(name, 0.0)) > 1e-6)


def read_myb(data: bytes, file: str) -> FoundBrushes:
    """Returns the brush of a file."""
    try:
        told = strict_json.loads(data, twice=True)
        if not isinstance(told, dict):
            raise FieldError("", "no object", "a brush of MyPaint")
        if told.get("version") != _VERSION:
            raise FieldError("version", repr(told.get("version"))[:40], f"{_VERSION}")
        members = told.get("settings")
        if not isinstance(members, dict) or len(members) > _MOST_SETTINGS:
            raise FieldError("settings", type(members).__name__, f"an object of at most {_MOST_SETTINGS} settings")
        return FoundBrushes([_brush(_Settings(members), file)])
    except FieldError as error:
        raise FileError(file, str(error)) from None


def _setting(value: object, place: str) -> _Setting:
    if not isinstance(value, dict):
        raise FieldError(place, type(value).__name__, "an object")
    base, inputs = value.get("base_value", 0.0), value.get("inputs", {})
    if not is_within(base, -_FAR, _FAR):
        raise FieldError(f"{place}.base_value", repr(base)[:40], "a number")
    if not isinstance(inputs, dict) or len(inputs) > _MOST_POINTS:
        raise FieldError(f"{place}.inputs", type(inputs).__name__, "an object")
    curves = {name: _points(points, f"{place}.inputs.{name}") for name, points in inputs.items() if points}
    return _Setting(float(base), {n: p for n, p in curves.items() if any(y for _, y in p)})


def _points(value: object, place: str) -> AddedCurve:
    if not isinstance(value, list) or len(value) > _MOST_POINTS:
        raise FieldError(place, type(value).__name__, f"a list of at most {_MOST_POINTS} points")
    found: dict[float, float] = {}
    for number, pair in enumerate(value):
        if not isinstance(pair, list) or len(pair) != 2 or not all(is_within(n, -_FAR, _FAR) for n in pair):
            raise FieldError(f"{place}[{number}]", repr(pair)[:40], "two numbers")
        found[float(pair[0])] = float(pair[1])
    return sorted(found.items())


def _radius(logarithm: float) -> float:
    return radius_of(math.exp(min(max(logarithm, -10.0), 10.0)))


def _part(value: float) -> float:
    return min(max(value, 0.0), 1.0)


def _brush(told: _Settings, file: str) -> FoundBrush:
    dynamics: dict[str, dict[str, AddedCurve]] = {}
    radius, dynamics["radius"] = told.follow("radius_logarithmic", _radius)
    deviation = min(max(told.base("radius_by_random"), 0.0), 2.0)
    if deviation and "random_dab" not in dynamics["radius"]:
        dynamics["radius"]["random_dab"] = knots_of_curve([(u, math.exp(z * deviation)) for u, z in _NORMAL])
    hardness, dynamics["hardness"] = told.follow("hardness", _part)
    flow, dynamics["flow"], spacing = _flow(told)
    scatter, dynamics["scatter"] = told.follow("offset_by_random", lambda v: min(max(2.0 * v, 0.0), 16.0))
    ratio, dynamics["ratio"] = told.follow("elliptical_dab_ratio", lambda v: 1.0 / min(max(v, 1.0), 100.0))
    shape: ByName = {"ratio": ratio, "scatter": scatter}
    if ratio < 1.0 or dynamics["ratio"]:
        shape |= _turned(told, dynamics)
    _colours(told, dynamics)
    settings = {
        "radius": radius,
        "hardness": hardness,
        "flow": flow,
        "spacing": spacing,
        "shape": shape,
        "dynamics": {target: curves for target, curves in dynamics.items() if curves},
        "colour": _colour(told),
    }
    wet = _wet(told, spacing)
    if wet is not None:
        settings["wet"] = wet
    if told.base("eraser") >= 0.5:
        settings["mode"] = "erase"
    left = [*told.left(), *(["erasing by parts"] if told.curves("eraser") else [])]
    left += ["what smudging follows"] if told.curves("smudge") else []
    return FoundBrush(called("", file), settings, None, tuple(left), told.base("restore_color") >= 0.5)


def _wet(told: _Settings, spacing: float) -> ByName | None:
    """Returns how the brush takes paint along; there a part of it is left after each dab, here after each radius."""
    amount = _part(told.base("smudge") + resting(told.curves("smudge")))
    if amount < 0.01:
        return None
    kept = math.pow(_part(told.base("smudge_length")), 1.0 / spacing)
    mixing = "pigment" if told.base("paint_mode") >= 0.5 else "light"
    return {"amount": round(amount, 3), "length": round(kept, 3), "mixing": mixing}


def _flow(told: _Settings) -> tuple[float, dict[str, AddedCurve], float]:
    """Returns how much each dab lays, its curves, and the spacing."""
    most, first = told.follow("opaque", lambda v: min(max(v, 0.0), 2.0))
    part, second = told.follow("opaque_multiply", lambda v: min(max(v, 0.0), 2.0))
    dabs = max(told.base("dabs_per_actual_radius"), 0.0) + max(told.base("dabs_per_basic_radius"), 0.0)
    over = 1.0 + _part(told.base("opaque_linearize")) * (max(2.0 * dabs, 1.0) - 1.0)  # dabs at each place

    def each(covered: float) -> float:
        return 1.0 - math.pow(1.0 - _part(covered), 1.0 / over)

    flow = each(most * part)
    curves = {}
    if flow > 0.0:
        for name, knots in multiplied(first, second).items():
            curves[name] = knots_of_curve([(x, each(most * part * y) / flow) for x, y in _cut(knots)])
    return flow, curves, spacing_of(1.0 / max(dabs, 1e-3))


def _cut(knots: AddedCurve) -> AddedCurve:
    """Returns knots with more between them, for what is not straight."""
    if len(knots) > 12:
        return knots
    out = [knots[0]]
    for (x0, y0), (x1, y1) in pairwise(knots):
        out += [(x0 + (x1 - x0) * k / 4, y0 + (y1 - y0) * k / 4) for k in (1, 2, 3, 4)]
    return out


def _turned(told: _Settings, dynamics: dict[str, dict[str, AddedCurve]]) -> ByName:
    """Returns how the tip is turned; one that turns with the stroke follows it."""
    angle, curves, follow = told.base("elliptical_dab_angle"), told.curves("elliptical_dab_angle"), "none"
    along = curves.get("direction") or curves.get("direction_angle")
    if along is not None and abs((added_at(along, 180.0) - added_at(along, 0.0)) / 180.0 - 1.0) < 0.25:
        angle, follow = angle + added_at(along, 0.0), "direction"
        curves = {name: points for name, points in curves.items() if not name.startswith("direction")}
    turns = {name: [(x, y / 360.0) for x, y in points] for name, points in curves.items()}
    _add_turns(dynamics, "angle", 0.0, turns, told.scale)
    return {"angle": math.fmod(angle, 360.0), "follow": follow}


def _colours(told: _Settings, dynamics: dict[str, dict[str, AddedCurve]]) -> None:
    """Has the colour follow what it followed: its hue in turns, lightness and chroma in parts of what they are."""
    _add_turns(dynamics, "hue", told.base("change_color_h"), told.curves("change_color_h"), told.scale)
    for target, names in (("lightness", ("v", "l")), ("chroma", ("hsv_s", "hsl_s"))):
        for name in names:
            curves = told.curves(f"change_color_{name}")
            found = multiplying(1.0 + told.base(f"change_color_{name}"), curves, told.scale, lambda v: max(v, 0.0))[1]
            dynamics[target] = multiplied(dynamics.get(target, {}), found)


def _add_turns(
    dynamics: dict[str, dict[str, AddedCurve]], target: str, base: float, curves: dict[str, AddedCurve], scale: Scale
) -> None:
    """Has a target that is an angle follow curves that add parts of a turn."""
    found: dict[str, AddedCurve] = {}
    for name, points in curves.items():
        least = min(base + y for _, y in points)
        whole = 1.0 + max(0.0, math.ceil(-1.0 - least))
        row = INPUTS_THERE[name]
        places = sorted({row.lo, row.hi, *(x for x, _ in points if row.lo < x < row.hi)})
        here = [(u, whole + base + added_at(points, x)) for x in places for u in row.places(x, scale)]
        found.setdefault(row.name, knots_of_curve(here))
    dynamics[target] = found


def _colour(told: _Settings) -> str:
    h, s, v = (told.base(f"color_{name}") for name in "hsv")
    rgb = colorsys.hsv_to_rgb(h % 1.0, _part(s), _part(v))
    return "#" + "".join(f"{round(255 * c):02x}" for c in rgb)
