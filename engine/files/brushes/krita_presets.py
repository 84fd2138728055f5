"""Presets of Krita, `.kpp`: a PNG, its icon, whose text chunk "preset" holds XML: parameters by name, of which one is
the tip, XML again; pictures of tips are in it, or files that it names.

After Krita's sources' names of parameters; PNG's text chunks after ISO/IEC 15948, section 11.3.4.
"""

from __future__ import annotations

import base64
import binascii
import io
import math
from collections.abc import Callable
from xml.etree.ElementTree import Element, ParseError

import numpy as np
from defusedxml.common import DefusedXmlException
from defusedxml.ElementTree import fromstring

from engine.files.brushes.found_brush import (
    ByName,
    FoundBrush,
    FoundBrushes,
    called,
    radius_of,
    spacing_of,
    stamp_settings,
)
from engine.files.brushes.krita_tips import tip_of_file
from engine.files.fault import FileError, shown
from engine.files.inflate import DeflateError, Inflated
from engine.files.limits import LIMITS
from engine.files.png_chunks import Chunks
from engine.files.png_writer import SIGNATURE
from engine.numeric.curves import KNOTS_CAP

_PRESET = b"preset"
_XML_CAP = 24 << 20
_SENSED = {"pressure": "pressure", "fuzzy": "random_dab", "fuzzystroke": "random_stroke"}
_FOLLOWING = {"Size": "radius", "Opacity": "opacity", "Flow": "flow", "Softness": "hardness", "Ratio": "ratio"}
_ALWAYS = ("Opacity", "Flow")  # what cannot be switched off there, but for its curve
_ENGINES = ("paintbrush", "eraser")
_LEFT = {  # what cannot be painted with here, by the parameter that is true then
    "Texture/Pattern/Enabled": "its pattern",
    "MaskingBrush/Enabled": "its second tip",
    "PressureMirror": "mirrored dabs",
    "PressureDarken": "darkening",
    "PressureMix": "mixing",
    "PressureSharpness": "sharpness",
    "Pressureh": "changes of hue",
    "Pressures": "changes of saturation",
    "Pressurev": "changes of value",
}
Beside = Callable[[str], bytes | None]  # what a file holds that is named; None where there is none
Params = dict[str, str]


def read_kpp(data: bytes, file: str, beside: Beside) -> FoundBrushes:
    """Returns the brush of a preset; `beside` gives files that it names."""
    root = _xml(_preset(data, file), file)
    if root.tag != "Preset":
        raise FileError(file, f"preset: found <{shown(root.tag)}>, expected <Preset>")
    params = {param.get("name", ""): param.text or "" for param in root.iter("param")}
    left = [words for name, words in _LEFT.items() if _true(params, name)]
    engine = root.get("paintopid", "")
    if engine not in _ENGINES:
        left.insert(0, f"what Krita's “{engine[:30]}” does")
    brush = _brush(params, file, _all_files(root, beside), left)
    name = (root.get("name", "") or file.rpartition(".")[0]).replace("_", " ")
    return FoundBrushes([FoundBrush(called(name, file), brush.settings, brush.tip, tuple(left))])


def _preset(data: bytes, file: str) -> bytes:
    """Returns the text of the chunk "preset"."""
    if data[:8] != SIGNATURE:
        raise FileError(file, f"starts with {shown(data[:8])}; expected a PNG with a preset of Krita")
    chunks = Chunks(io.BytesIO(data[8:]), file, LIMITS)
    kind, length = chunks.head()
    while kind != b"IEND":
        if kind not in (b"tEXt", b"zTXt", b"iTXt"):
            chunks.skip(kind, length)
        else:
            key, _, rest = chunks.body(kind, length).partition(b"\0")
            if key == _PRESET:
                return _text(kind, rest, file)
        kind, length = chunks.head()
    raise FileError(file, "found a PNG without a text “preset”, expected a preset of Krita")


def _text(kind: bytes, rest: bytes, file: str) -> bytes:
    if kind == b"tEXt":
        return rest
    packed = kind == b"zTXt" or rest[:1] == b"\1"
    rest = rest[1:] if kind == b"zTXt" else rest[2:].partition(b"\0")[2].partition(b"\0")[2]
    if not packed:
        return rest
    room = bytearray(min(_XML_CAP, LIMITS.ratio * len(rest)) + 1)
    try:
        count = Inflated(iter((rest,))).readinto(memoryview(room))
    except DeflateError as error:
        raise FileError(file, f"preset: {error}") from None
    if count > _XML_CAP:
        raise FileError(file, f"preset: found more than {_XML_CAP >> 20} MiB of text")
    return bytes(room[:count])


def _xml(text: bytes | str, file: str) -> Element:
    try:
        root: Element = fromstring(text)
    except (ParseError, DefusedXmlException, ValueError, RecursionError) as error:
        raise FileError(file, f"preset: {error}") from None
    return root


def _all_files(root: Element, beside: Beside) -> Beside:
    """Returns a giver of what is named: what the preset holds itself comes first."""
    held = {
        (part.get("filename") or part.get("name") or "").rpartition("/")[2]: part
        for part in root.iter("resource")
        if part.get("type") == "brushes"
    }

    def give(name: str) -> bytes | None:
        part = held.get(name)
        if part is None:
            return beside(name)
        try:
            return base64.b64decode("".join((part.text or "").split()), validate=True)
        except (binascii.Error, ValueError):
            return None

    return give


def _brush(params: Params, file: str, give: Beside, left: list[str]) -> FoundBrush:
    told = params.get("brush_definition", "").strip()
    root = _xml(told, file) if told else Element("Brush")
    tip = root if root.tag == "Brush" else root.find(".//Brush")
    settings, shape, picture = _tip(Element("Brush") if tip is None else tip, file, give, left)
    dynamics: ByName = {}
    for name, target in _FOLLOWING.items():
        _follow(params, name, target, dynamics, left, file)
    if _true(params, "PressureRotation"):
        ids = _sensors(params, "Rotation", file)
        if "drawingangle" in ids:
            shape["follow"] = "direction"
        if "fuzzy" in ids:
            dynamics["angle"] = {"random_dab": [[0.0, 0.5], [1.0, 1.5]]}
        if not {"drawingangle", "fuzzy"} & set(ids):
            left.append("what its angle follows")
    if _true(params, "PressureScatter"):
        shape["scatter"] = _within(_number(params, "ScatterValue", 0.0) * 2.0, 0.0, 16.0)
    for name, target in (("OpacityValue", "opacity"), ("FlowValue", "flow")):
        settings[target] = _within(_number(params, name, 1.0), 0.0, 1.0)
    if _true(params, "EraserMode") or params.get("CompositeOp", "").strip() == "erase":
        settings["mode"] = "erase"
    elif params.get("CompositeOp", "normal").strip() not in ("normal", ""):
        left.append(f"its mode “{params['CompositeOp'].strip()[:30]}”")
    return FoundBrush("", settings | {"shape": shape, "dynamics": dynamics}, picture)


def _tip(tip: Element, file: str, give: Beside, left: list[str]) -> tuple[ByName, ByName, np.ndarray | None]:
    """Returns radius, spacing, hardness and shape of a brush, and the picture of its tip, None for a round one."""
    attributes: Params = dict(tip.attrib)
    angle = -math.degrees(_number(attributes, "angle", 0.0)) % 360.0
    mask = tip.find("MaskGenerator")
    if mask is None and tip.get("filename"):
        name = tip.get("filename", "").replace("\\", "/").rpartition("/")[2]
        found = tip_of_file(name, give(name), tip.get("ColorAsMask") == "1", left)
        if found is not None:
            square, radius, wide = found
            scale = _within(_number(attributes, "scale", 1.0), 1e-3, 1e3)
            step = _step(attributes, wide * scale) / scale
            settings = stamp_settings((square, radius), scale, step)
            return settings, {"angle": angle}, square
    made: Params = {} if mask is None else dict(mask.attrib)
    wide = _within(_number(made, "diameter", 20.0), 0.1, 8000.0)
    if made.get("type") == "rect":
        left.append("the corners of its square tip")
    if _number(attributes, "randomness", 0.0) > 0.0 or _number(attributes, "density", 1.0) < 1.0:
        left.append("the grain of its tip")
    if _number(made, "spikes", 2.0) > 2.0:
        left.append("the spikes of its tip")
    shape: ByName = {"ratio": _within(_number(made, "ratio", 1.0), 0.01, 1.0), "angle": angle}
    fade = min(_number(made, "hfade", 1.0), _number(made, "vfade", 1.0))
    round_one: ByName = {
        "radius": radius_of(wide / 2.0),
        "hardness": _within(fade, 0.0, 1.0),
        "spacing": spacing_of(_step(attributes, wide) * 2.0 / wide),
    }
    return round_one, shape, None


def _step(attributes: Params, wide: float) -> float:
    """Returns how far dabs of a width lie apart, px."""
    if attributes.get("useAutoSpacing") == "1":
        return _number(attributes, "autoSpacingCoeff", 1.0) * (wide if wide < 1.0 else math.sqrt(wide))
    return _number(attributes, "spacing", 0.1) * wide


def _follow(params: Params, name: str, target: str, dynamics: ByName, left: list[str], file: str) -> None:
    sensed = bool(params.get(f"{name}Sensor")) if name in _ALWAYS else _true(params, f"Pressure{name}")
    if not sensed or params.get(f"{name}UseCurve", "true").strip() == "false":
        return
    curves = {}
    for sensor, curve in _sensors(params, name, file).items():
        if sensor in _SENSED:
            curves[_SENSED[sensor]] = _knots(curve)
        else:
            left.append(f"its {name.lower()} by {sensor[:20]}")
    if curves:
        dynamics[target] = curves


def _sensors(params: Params, name: str, file: str) -> dict[str, str]:
    """Returns what a value follows: the curves by the names of sensors."""
    text = params.get(f"{name}Sensor", "").strip()
    if not text:
        return {"pressure": ""}
    root = _xml(text, file)
    common = params.get(f"{name}commonCurve", "") if _true(params, f"{name}UseSameCurve") else ""
    parts = root.findall("ChildSensor") if root.get("id") == "sensorslist" else [root]
    return {part.get("id", ""): common or (part.findtext("curve") or "") for part in parts if part.get("id")}


def _knots(curve: str) -> list[list[float]]:
    """Returns the knots of a curve "x,y;x,y;"; straight where it is none."""
    found: dict[float, float] = {}
    for pair in curve.split(";")[:KNOTS_CAP]:
        x, _, y = pair.partition(",")
        try:
            place, value = float(x), float(y)
        except ValueError:
            continue
        if math.isfinite(place) and math.isfinite(value):
            found[_within(place, 0.0, 1.0)] = _within(value, 0.0, 1.0)
    return [[x, y] for x, y in sorted(found.items())] if len(found) > 1 else [[0.0, 0.0], [1.0, 1.0]]


def _true(params: Params, name: str) -> bool:
    return params.get(name, "").strip() == "true"


def _number(params: Params, name: str, usual: float) -> float:
    try:
        value = float(params.get(name, "").strip() or usual)
    except ValueError:
        return usual
    return _within(value, -1e6, 1e6) if math.isfinite(value) else usual


def _within(value: float, lo: float, hi: float) -> float:
    return min(max(value, lo), hi)
