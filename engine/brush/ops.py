"""The raster-ops: what `mode` "raster" may do to the colour that is there, as one table (Lewis 1984, section 6.1).

    pic += d tex f(pic, ...)

d is how far the stroke covers a pixel, tex the brush's textures mixed (1 without), and f the row of the table, or a
formula of the artist's own (`engine.numeric.formula`).  Each row says what it leaves of finer levels' detail, what
coarser levels show, and by name which kernel computes it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from immutables import Map

from engine.brush import checks
from engine.brush.checks import BrushError
from engine.checks.values import described
from engine.numeric.formula import FORMULA_CAP, FormulaError, Tree, parse

STOPS_CAP = 8
_REACH_CAP = 32.0
SHIFT_CAP = 64.0
OFFSET_CAP = 2**31
OpValue = str | Map[str, Any]

STRAIGHT = ((0.0, 0.0), (1.0, 1.0))  # a curve that changes nothing
_DEEPER = ((0.0, 0.0), (0.25, 0.2), (0.75, 0.8), (1.0, 1.0))
_WASH = ((0.0, "#1b1033"), (0.5, "#c8553d"), (1.0, "#ffe9b0"))


@dataclass(frozen=True, slots=True)
class Parameter:
    """One parameter of an op.  `kind`: number (of lo..hi), choice (of `choices`), ramp, curve, layer or offset; a
    default of None means that it has to be given.  `whole`: a number that is rounded before it is used."""

    name: str
    label: str
    default: Any
    tooltip: str
    kind: str = "number"
    lo: float = 0.0
    hi: float = 1.0
    slider: tuple[float, float] = (0.0, 1.0)
    unit: str = ""
    logarithmic: bool = False
    choices: tuple[str, ...] = ()
    whole: bool = False

    def read(self, value: Any, place: str) -> Any:
        """Returns the checked, immutable value of a JSON one."""
        if self.kind == "number":
            return checks.number(value, place, self.lo, self.hi)
        if self.kind == "choice":
            return checks.one_of(value, place, self.choices)
        if self.kind == "layer":
            return checks.text(value, place, "a layer's name")
        if self.kind == "curve":
            return checks.knots(value, place, 1.0)
        return _ramp(value, place) if self.kind == "ramp" else _offset(value, place)


@dataclass(frozen=True, slots=True)
class Op:
    """A row of the table.  `group`: under which heading it is listed.  `finer`, `coarser`: what becomes of the detail
    of finer levels, and what coarser levels show.  `kernel`: what computes it: one of `op_paint.KERNELS` for an op that
    `lays` or takes paint, else one of `op_targets.KERNELS`.  `coloured`: it uses the brush's colour.  `whole`: it has
    to see the whole stroke before it knows any pixel."""

    name: str
    label: str
    group: str
    tooltip: str
    finer: str
    kernel: str
    parameters: tuple[Parameter, ...] = ()
    coloured: bool = False
    lays: bool = False
    whole: bool = False
    coarser: str = "Coarser levels show the mean of the changed pixels."


def _amount(default: float, tooltip: str, lo: float = 0.0, hi: float = 1.0) -> Parameter:
    return Parameter("amount", "Amount", default, tooltip, lo=lo, hi=hi, slider=(lo, hi))


def _reach(tooltip: str) -> Parameter:
    return Parameter("reach", "Reach", 4.0, tooltip, "number", 1.0, _REACH_CAP, (1.0, _REACH_CAP), "px", True)


def _curve(name: str, what: str = "", default: checks.Knots = STRAIGHT) -> Parameter:
    return Parameter(
        name, name.capitalize(), default, f"What becomes of {what or name}: dark left, light right", "curve"
    )


_BY = ("luminance", "texture")
_SLOPE = "Finer detail is multiplied by the slope of the change at the colour under it"
_GONE = "Finer detail fades as the stroke covers it"

OPS: dict[str, Op] = {
    row.name: row
    for row in (
        Op("toward", "Towards colour", "With the colour",
           "Sprays the brush's colour through its texture: a textured airbrush",
           f"{_GONE}, as under paint; the texture goes on where the paint was opaque.", "toward",
           coloured=True, lays=True),
        Op("multiply", "Multiply", "With the colour", "Darkens by the brush's colour, like ink on glass",
           f"{_SLOPE}, which is the brush's colour.", "multiply", coloured=True),
        Op("screen", "Screen", "With the colour", "Lightens by the brush's colour, like a second projector",
           f"{_SLOPE}, which is what the colour lacks to white.", "screen", coloured=True),
        Op("overlay", "Overlay", "With the colour", "Multiplies the dark and screens the light, which raises contrast",
           f"{_SLOPE}, up to twice as strong.", "overlay", coloured=True),
        Op("dodge", "Dodge", "With the colour", "Brightens towards burnt-out light, the brighter the brush's colour",
           f"{_SLOPE}: stronger, and gone where it burns out.", "dodge", coloured=True),
        Op("burn", "Burn", "With the colour", "Darkens towards black, the darker the brush's colour",
           f"{_SLOPE}: stronger, and gone where it is black.", "burn", coloured=True),
        Op("add", "Add", "With the colour", "Adds the brush's colour as light",
           "Finer detail stays as it is, and goes where it burns out.", "add", coloured=True),
        Op("subtract", "Subtract", "With the colour", "Takes the brush's colour away",
           "Finer detail stays as it is, and goes where it is black.", "subtract", coloured=True),
        Op("difference", "Difference", "With the colour", "How far the picture is from the brush's colour",
           "Finer detail stays, turned round where the picture is darker than the colour.", "difference",
           coloured=True),
        Op("lighten", "Lighten", "Tones", "Moves colours towards white",
           f"{_SLOPE}: weaker by the amount.", "lighten", (_amount(0.5, "How far of the way to white"),)),
        Op("darken", "Darken", "Tones", "Moves colours towards black",
           f"{_SLOPE}: weaker by the amount.", "darken", (_amount(0.5, "How far of the way to black"),)),
        Op("gamma", "Gamma", "Tones", "Brightens or darkens the middle tones, black and white stay",
           f"{_SLOPE}.", "gamma",
           (Parameter("gamma", "Gamma", 0.5, "Below 1 brightens, above 1 darkens", lo=0.1, hi=10.0,
                      slider=(0.2, 5.0), logarithmic=True),)),
        Op("contrast", "Contrast", "Tones", "Spreads tones apart around a middle one, or draws them together",
           f"{_SLOPE}: by the gain, at most twice as strong.", "contrast",
           (Parameter("gain", "Gain", 1.5, "Above 1 for more contrast, below for less", hi=4.0, slider=(0.0, 4.0)),
            Parameter("pivot", "Pivot", 0.5, "The tone that stays"))),
        Op("tone", "Brightness and contrast", "Tones", "Lighter or darker as a whole, and more or less spread apart",
           f"{_SLOPE}: by the contrast, at most twice as strong.", "tone",
           (Parameter("brightness", "Brightness", 0.1, "What is added to every tone", lo=-1.0, slider=(-1.0, 1.0)),
            Parameter("contrast", "Contrast", 1.2, "Above 1 for more, below for less", hi=4.0, slider=(0.0, 4.0)))),
        Op("levels", "Levels", "Tones", "Spreads the tones between the darkest and the lightest that are wanted",
           f"{_SLOPE}, at most twice as strong.", "levels",
           (Parameter("black", "Black", 0.05, "The tone that becomes black"),
            Parameter("white", "White", 0.95, "The tone that becomes white"),
            Parameter("gamma", "Middle", 0.9, "Below 1 brightens the middle tones, above 1 darkens them", lo=0.1,
                      hi=10.0, slider=(0.2, 5.0), logarithmic=True))),
        Op("curves", "Curves", "Tones", "Each tone becomes another, along a curve of all channels or of one",
           f"{_SLOPE}, at most twice as strong.", "curves",
           (_curve("all", "every channel, after its own curve", _DEEPER), _curve("red"), _curve("green"),
            _curve("blue"))),
        Op("invert", "Invert", "Tones", "Turns light into dark, each colour into its opposite",
           "Finer detail is turned round: its light becomes its dark.", "invert"),
        Op("posterise", "Posterise", "Tones", "Leaves a few levels of each channel, with hard steps between",
           f"{_GONE}.", "posterise",
           (Parameter("levels", "Levels", 4.0, "How many tones are left of each channel", lo=2.0, hi=64.0,
                      slider=(2.0, 16.0), whole=True),)),
        Op("saturate", "Saturate", "Hues", "Makes colours stronger, or paler; their brightness stays",
           "Finer light and dark stay; the colours in them stay as they are.", "saturate",
           (_amount(1.5, "0 is grey, 1 leaves colours as they are", 0.0, 4.0),)),
        Op("hue", "Turn hue", "Hues", "Turns colours round the colour circle; their brightness stays",
           "Finer light and dark stay; the colours in them stay as they are.", "hue",
           (Parameter("turn", "Turn", 60.0, "How far round the circle", lo=-360.0, hi=360.0, slider=(-180.0, 180.0),
                      unit="degrees"),)),
        Op("recolour", "Hue and saturation", "Hues", "Turns colours, makes them stronger or paler, lighter or darker",
           "Finer light and dark stay, weaker by the lightness; the colours in them stay as they are.", "recolour",
           (Parameter("turn", "Hue", 20.0, "How far round the colour circle", lo=-360.0, hi=360.0,
                      slider=(-180.0, 180.0), unit="degrees"),
            Parameter("amount", "Saturation", 1.2, "0 is grey, 1 leaves colours as they are", hi=4.0,
                      slider=(0.0, 4.0)),
            Parameter("light", "Lightness", 0.1, "Towards white; below 0 towards black", lo=-1.0,
                      slider=(-1.0, 1.0)))),
        Op("gradient", "Gradient map", "Hues", "Colours from a ramp, by brightness or by the texture: a colour wash",
           f"{_SLOPE} of the ramp; by texture it fades, and the texture's own detail takes its place.", "gradient",
           (Parameter("ramp", "Ramp", _WASH, "Two to eight stops [place, colour], places rising from 0 to 1", "ramp"),
            Parameter("by", "By", _BY[0], "What runs along the ramp", "choice", choices=_BY))),
        Op("smooth", "Smooth", "Forms", "Evens colours out, keeping what is transparent as it is",
           f"{_GONE}.", "smooth", (_reach("How far on each side it looks"),)),
        Op("sharpen", "Sharpen", "Forms", "Strengthens what differs from its surroundings",
           "Finer detail is strengthened by the amount, at most twice.", "sharpen",
           (_amount(1.0, "How much of the difference is added", 0.0, 4.0), _reach("How wide surroundings are"))),
        Op("displace", "Displace", "Forms", "Shifts paint, along an angle or down the slopes of the texture",
           f"{_GONE}.", "displace",
           (Parameter("distance", "Distance", 8.0, "How far paint moves", lo=0.0, hi=SHIFT_CAP,
                      slider=(0.0, SHIFT_CAP), unit="px"),
            Parameter("angle", "Angle", 0.0, "Where it moves to: 0 right, 90 down; turns slopes too",
                      lo=-360.0, hi=360.0, slider=(-180.0, 180.0), unit="degrees"),
            Parameter("by", "By", "angle", "What tells the way", "choice", choices=("angle", "texture"))), lays=True),
        Op("predict", "Continue", "Forms", "Continues what the stroke begins on out of what is painted around it",
           f"{_GONE}.", "predict",
           (Parameter("reach", "Memory", 4.0, "How far back a pixel looks at those before it", "number", 1.0, 8.0,
                      (1.0, 8.0), "px"),
            Parameter("window", "Sample", 64.0, "Width of the square, around where the stroke begins, that is learnt",
                      "number", 16.0, 256.0, (16.0, 256.0), "px", True)), lays=True, whole=True),
        Op("clone", "Clone", "Other", "Copies what lies on a layer, of the same level, from some way off",
           f"{_GONE}; textures of what is copied go on, strokes finer than this level are not copied.", "clone",
           (Parameter("layer", "Layer", None, "The layer that is copied; it may be the one painted on", "layer"),
            Parameter("offset", "Offset", (0, 0), "From here to what is copied, in pixels", "offset", unit="px")),
           lays=True),
        Op("erase", "Erase", "Other", "Takes paint away through the texture", f"{_GONE}.", "erase", lays=True),
    )
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Chosen:
    """What a brush's `op` says: the row (None for a formula), all its parameters by name, the formula's tree."""

    row: Op | None
    parameters: Mapping[str, Any]
    tree: Tree | None = None

    @property
    def by_texture(self) -> bool:
        """Tells whether the texture tells what is done, and not how strongly."""
        return self.parameters.get("by") == "texture"

    @property
    def hides(self) -> bool:
        """Tells whether what it makes at full strength does not go by the colour that was there."""
        return self.row is not None and (self.row.lays or self.by_texture or self.row.kernel == "smooth")


def read(value: Any, place: str) -> OpValue:
    """Returns the checked value of a brush's `op`: a name, or an immutable object.  BrushError names what is wrong."""
    if isinstance(value, str):
        op = _row(value, place)
        _missing(op, {}, place)
        return value
    if not isinstance(value, Mapping) or ("formula" in value) == ("name" in value):
        raise BrushError(place, described(value), 'a name, {"name": NAME, ...} or {"formula": "..."}')
    if "formula" in value:
        _formula(value["formula"], f"{place}.formula")
        formula: OpValue = checks.frozen(value)
        return formula
    op = _row(value["name"], f"{place}.name")
    own = {part.name: part for part in op.parameters}
    _missing(op, value, place)
    given = {name: own[name].read(part, f"{place}.{name}") for name, part in value.items() if name in own}
    kept: OpValue = checks.frozen(value).update(given)  # members that this version does not know are kept
    return kept


def chosen(op: OpValue, place: str = "brush.op") -> Chosen:
    """Returns what the op of a brush says, defaults filled in.  BrushError as `read`."""
    op = read(checks.thawed(op), place)
    if not isinstance(op, str) and "formula" in op:
        return Chosen(None, {}, _formula(op["formula"], f"{place}.formula"))
    row = OPS[op if isinstance(op, str) else op["name"]]
    given = {} if isinstance(op, str) else op
    return Chosen(row, {part.name: given.get(part.name, part.default) for part in row.parameters})


def _row(name: Any, place: str) -> Op:
    return OPS[checks.one_of(name, place, tuple(OPS))]


def _missing(op: Op, given: Mapping[str, Any], place: str) -> None:
    for part in op.parameters:
        if part.default is None and part.name not in given:
            raise BrushError(f"{place}.{part.name}", "none", f"one: {part.tooltip[0].lower()}{part.tooltip[1:]}")


def _formula(value: Any, place: str) -> Tree:
    text = value
    if not isinstance(text, str) or not 0 < len(text) <= FORMULA_CAP:
        raise BrushError(place, described(value), f"a formula, a text of 1 to {FORMULA_CAP} characters")
    try:
        return parse(text)
    except FormulaError as error:
        raise BrushError(f"{place}, column {error.column}", error.found, error.expected) from None


def _ramp(value: Any, place: str) -> tuple[tuple[float, str], ...]:
    if not isinstance(value, list | tuple) or not 2 <= len(value) <= STOPS_CAP:
        raise BrushError(place, described(value), f"a list of 2 to {STOPS_CAP} stops [place, colour]")
    stops: list[tuple[float, str]] = []
    for i, stop in enumerate(value):
        at = f"{place}[{i}]"
        if not isinstance(stop, list | tuple) or len(stop) != 2:
            raise BrushError(at, described(stop), "a stop [place, colour]")
        where = checks.number(stop[0], f"{at}[0]", 0.0, 1.0)
        if stops and where <= stops[-1][0]:
            raise BrushError(f"{at}[0]", described(stop[0]), f"a place above {stops[-1][0]:g}, that before")
        stops.append((where, checks.colour(stop[1], f"{at}[1]")))
    return tuple(stops)


def _offset(value: Any, place: str) -> tuple[int, int]:
    if not isinstance(value, list | tuple) or len(value) != 2:
        raise BrushError(place, described(value), "a pair [dx, dy] of whole numbers")
    for i, part in enumerate(value):
        if checks.number(part, f"{place}[{i}]", -OFFSET_CAP, OFFSET_CAP) % 1:
            raise BrushError(f"{place}[{i}]", described(part), "a whole number")
    return int(value[0]), int(value[1])
