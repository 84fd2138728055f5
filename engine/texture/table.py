"""The table of texture kinds: their parameters, and the instances they make.

One row makes the sliders, the entries of a brush's ink, the checks and the form in files.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from engine.checks.field_error import FieldError
from engine.checks.values import described, is_within
from engine.numeric.arithmetic import LIBRARY
from engine.numeric.curves import CURVES, KNOTS_CAP, Shape
from engine.texture.expression.defined import expression, expression_of_key
from engine.texture.expression.placing.generated import ALPHA_OF, COLOURS_OF, COVER_OF, generated_of_key
from engine.texture.gradient import gradient, gradient_of_key
from engine.texture.image import Cover, Image, ImageSource
from engine.texture.learnt.inks import REFINABLE, learnt
from engine.texture.learnt.refinement import OCTAVES, Learning
from engine.texture.matched import Matched, MatchedCover, series, series_cover
from engine.texture.placed import PlacedInk, similarity_of
from engine.texture.procedural import Sawtooth, Squares, Stripes, White
from engine.texture.record import LEARNT, Instance, kind_of_key
from engine.texture.rock import Rock
from engine.texture.shaped import Shaped
from engine.texture.spectral import Sparse, Tiled

DEEPEST = 1 << 16  # |level| up to which textures are made: a claim in a file beyond it is refused
SHAPED_CAP = 4  # curves, one after another


class TextureError(FieldError):
    """A texture that cannot be made: `place` names the field.  `str()` is one line."""


@dataclass(frozen=True, slots=True)
class Parameter:
    """A number of a texture: `lo` <= value <= `hi`; `whole` ones are integers."""

    name: str
    default: float
    lo: float
    hi: float
    unit: str
    tooltip: str
    whole: bool = False

    def checked(self, value: Any) -> float | int:
        """Returns the value as a float (or int); TextureError if it is no number or out of range."""
        if is_within(value, self.lo, self.hi, self.whole):
            return int(value) if self.whole else float(value) + 0.0  # -0.0 becomes 0.0: one key for one texture
        kind = "an integer" if self.whole else "a number"
        raise TextureError(self.name, described(value), f"{kind} from {self.lo:g} to {self.hi:g}")


@dataclass(frozen=True, slots=True)
class Kind:
    """A row: the texture's name, its parameters in the order of its key, and what makes it of (base, *parameters).

    `pictured`: whether it needs a picture, as the last argument of `make`; `endless`: whether each level adds an octave
    of its own, so that there is a choice whether the older ones are renewed (the parameter `renew`)."""

    name: str
    parameters: tuple[Parameter, ...]
    make: Callable[..., Instance]
    tooltip: str
    pictured: bool = False
    endless: bool = False


_WAVE = (
    Parameter("period", 32.0, 2.0, 65536.0, "px", "Length of one repeat, in pixels of the level painted on"),
    Parameter("angle", 0.0, -360.0, 360.0, "degrees", "Direction across the bands, clockwise from rightwards"),
    Parameter("phase", 0.0, 0.0, 1.0, "periods", "Shift along that direction, in repeats"),
)
_ROCK = (
    Parameter("period", 32.0, 2.0, 4096.0, "px", "Size of the largest features, in pixels of the level painted on"),
    Parameter("roughness", 0.5, 0.0, 1.0, "", "H: 0 is the roughest, 1 the smoothest"),
    Parameter("seed", 0, -(1 << 63), (1 << 64) - 1, "", "Another seed, another rock", whole=True),
)
_IMAGE = (
    Parameter("period", 256, 1, 65536, "px", "Width of the picture, in pixels of the level painted on", whole=True),
)
_SAMPLE = (
    Parameter("period", 256, 4, 65536, "px", "Width of the sample, in pixels of the level painted on", whole=True),
    Parameter("roughness", 0.5, 0.0, 1.0, "", "Strength of each octave of detail that zooming in adds; 0 is smooth"),
)
_SERIES = (
    *_SAMPLE,
    Parameter("stages", 5, 2, 9, "", "How many textures of the series are stored", whole=True),
    Parameter(
        "weight", 0.0, 0.0, 1.0, "", "From the first example, 0, to the second, 1; the pen's pressure may set it"
    ),
)
_SPARSE = (
    *_SAMPLE,
    Parameter("density", 10.0, 0.5, 100.0, "", "Copies of the sample per area of it: few stay apart, many merge"),
    Parameter("mean", 0.0, -1.0, 1.0, "", "Brightness around which the texture varies"),
    Parameter("spread", 1.0, 0.0, 4.0, "", "Contrast"),
    Parameter("quantise", 0, 0, 256, "", "How many different strengths the copies have; 0 is any", whole=True),
    _ROCK[-1],
    Parameter("turn", 0.0, 0.0, 1.0, "turns", "How far copies are turned at random: 1 is any way round"),
)

LEARNING = (
    Parameter("strength", 1.0, 0.0, 1.0, "", "How strong learnt detail below a picture's own pixels is"),
    Parameter("octaves", OCTAVES, 1, OCTAVES, "", "How many times finer, by halves, learnt detail goes", whole=True),
)

_ROWS = (
    Kind("white", (), White, "Plain paint of the ink's colour"),
    Kind("rock", _ROCK, Rock, "Noise like rock, finer and finer however far you zoom in", endless=True),
    Kind("stripes", _WAVE, Stripes, "Bands with edges that stay sharp at every depth"),
    Kind("sawtooth", _WAVE, Sawtooth, "Ramps, each ending in an edge that stays sharp"),
    Kind("squares", _WAVE, Squares, "A checkerboard whose edges stay sharp at every depth"),
    Kind("image", _IMAGE, Image, "A picture, tiled; it shows its own detail as you zoom in", pictured=True),
    Kind("canvas", _IMAGE, Image, "A piece of the painting, tiled like a picture", pictured=True),
    Kind("spectrum", _SAMPLE, Tiled, "A painted spectrum as texture, tiled", pictured=True, endless=True),
    Kind(
        "matched",
        _SAMPLE,
        Matched,
        "Noise matched to an example, tiled; zooming in adds more of its kind",
        pictured=True,
        endless=True,
    ),
    Kind("series", _SERIES, series, "Textures between two examples, tiled", pictured=True, endless=True),
    Kind("sparse", _SPARSE, Sparse, "An endless field of scattered copies of a sample", pictured=True, endless=True),
    Kind("example", _IMAGE, Image, "An example that brushes grow; as ink, its picture, tiled", pictured=True),
)
# Not for the brush to name: the alpha that a texture brings along where it is translucent.
_COVERS: dict[str, Kind] = {
    "cover": Kind("cover", _IMAGE, Cover, "", pictured=True),
    "matched-cover": Kind("matched-cover", _SAMPLE, MatchedCover, "", pictured=True, endless=True),
    "series-cover": Kind("series-cover", _SERIES, series_cover, "", pictured=True, endless=True),
}
# Not for the brush to name, either, but for definitions: their parameters are no numbers.
GRADIENT, EXPRESSION, EXPRESSION_COVER = "gradient", "expression", "expression-cover"
NAMED_CAP = 1 << 16  # characters of the key of a texture that another one names
DEFINED: dict[str, Callable[..., Instance]] = {GRADIENT: gradient, EXPRESSION: expression}
_OF_KEYS: dict[str, Callable[..., Instance]] = {
    **dict.fromkeys((GRADIENT, "gradient-cover"), gradient_of_key),
    **dict.fromkeys((COLOURS_OF, COVER_OF, ALPHA_OF), generated_of_key),
}
KINDS: dict[str, Kind] = {row.name: row for row in _ROWS}


def instance(
    kind: str,
    parameters: Mapping[str, Any],
    level: int,
    seed: int,
    source: ImageSource | None = None,
    arithmetic: int = LIBRARY,
    maps: ImageSource | None = None,
) -> Instance:
    """Returns a texture bound to its base level `level`.

    Parameters that are missing take the row's default, those of other kinds are ignored; `seed` is for textures
    whose parameters name none; `source` is the picture of an image or the sample of a spectral texture, its width the
    default period; `arithmetic`: that of the painting.  TextureError names the field.
    """
    if isinstance(kind, str) and kind in DEFINED:
        _check_level(level)
        return _told(DEFINED[kind], parameters, level)
    row = _row(kind)
    _check_level(level)
    values = []
    for p in row.parameters:
        value = parameters.get(p.name)
        if value is None:
            value = seed if p.name == "seed" else p.default
            if row.pictured and p.name == "period" and source is not None and source.width:
                value = min(max(source.width, int(p.lo)), int(p.hi))
        values.append(p.checked(value))
    renew = _renewed(row, parameters)
    if not row.pictured:
        return _worked_out(row.make(level, *values), arithmetic, renew)
    if source is None:
        raise TextureError("source", "none", f"a picture for the texture {kind!r}")
    made = _worked_out(row.make(level, *values, source), arithmetic, renew)
    return _refined(made, parameters, maps)


def refinement(parameters: Mapping[str, object]) -> tuple[float, int] | None:
    """Returns how strong learnt detail is, and how many octaves, as parameters tell; None where they ask for none.
    TextureError names the field."""
    told = parameters.get("detail")
    if isinstance(told, int):  # of a piece of the canvas: so many levels of its own
        told = None
    if told is not None and told != LEARNT:
        raise TextureError("detail", described(told), f'"{LEARNT}", or nothing')
    values = tuple(p.checked(parameters.get(p.name, p.default)) for p in LEARNING)
    return None if told is None else (float(values[0]), int(values[1]))


def _refined(made: Instance, parameters: Mapping[str, object], maps: ImageSource | None) -> Instance:
    """Returns a texture refined by what was learnt of it, if there is that."""
    how = refinement(parameters)
    return made if how is None or maps is None else learnt(made, Learning(maps, *how))


def _renewed(row: Kind, parameters: Mapping[str, object]) -> bool:
    """Returns the parameter `renew`, of textures that go on for ever."""
    renew = parameters.get("renew", True) if row.endless else True
    if not isinstance(renew, bool):
        raise TextureError("renew", described(renew), "true or false")
    return renew


def _worked_out(made: Instance, arithmetic: int, renew: bool) -> Instance:
    """Returns a texture in an arithmetic, its octaves renewed or not; the same one where that makes no difference."""
    if not renew:
        assert isinstance(made, Rock | Tiled | Sparse)
        made = replace(made, renew=False)
    if arithmetic == LIBRARY or not isinstance(made, Rock | Stripes | Sawtooth | Squares | Tiled | Sparse):
        return made
    return replace(made, arithmetic=arithmetic)


def from_key(key: Sequence[Any], images: Mapping[str, ImageSource]) -> Instance:
    """Returns the instance whose key this is, as read back from JSON (lists for tuples); `images` by their sha.

    An image that is not among them keeps its key and is transparent.  TextureError names the part of the key.
    """
    if not isinstance(key, list | tuple) or len(key) < 2:
        raise TextureError("key", described(key), "[kind, base level, parameters ...]")
    if key[0] == "shaped":
        return _shaped_from_key(key, images)
    if key[0] == "placed":
        return _placed_from_key(key, images)
    if key[0] == LEARNT:
        return _learnt_from_key(key, images)
    if key[0] in (EXPRESSION, EXPRESSION_COVER):
        _check_level(key[1])
        return _told(expression_of_key, key, partial(_named_in_key, images=images))
    if isinstance(key[0], str) and key[0] in _OF_KEYS:
        _check_level(key[1])
        return _told(_OF_KEYS[key[0]], key)
    kind, arithmetic, renew = kind_of_key(key[0]) if isinstance(key[0], str) else (key[0], LIBRARY, True)
    row = (_COVERS.get(kind) if isinstance(kind, str) else None) or _row(kind)
    if not (renew or row.endless):
        raise TextureError("texture", described(key[0]), "one of " + ", ".join(KINDS))
    _check_level(key[1])
    count = 2 + len(row.parameters) + (2 if row.pictured else 0)
    if len(key) == count - 1 and row.parameters and row.parameters[-1].name == "turn":  # none is told where none is
        key = (*key[:-2], 0.0, *key[-2:])
    if len(key) != count:
        raise TextureError("key", f"{len(key)} parts", f"{count} parts for {row.name!r}")
    values = [p.checked(value) for p, value in zip(row.parameters, key[2:], strict=False)]
    if not row.pictured:
        return _worked_out(row.make(key[1], *values), arithmetic, renew)
    name, sha = key[-2:]
    for field, text in (("name", name), ("sha", sha)):
        if not isinstance(text, str):
            raise TextureError(field, described(text), "a string")
    known = images.get(sha)
    made = row.make(key[1], *values, ImageSource(name, sha, known.data if known else None))
    return _worked_out(made, arithmetic, renew)


def of_keys(named: object, images: Mapping[str, ImageSource]) -> dict[str, Instance]:
    """Returns textures whose keys are told, by name."""
    if not isinstance(named, Mapping):
        raise TextureError("named", described(named), "{name: the key of a texture, ...}")
    return {str(name): _named_in_key(key, images) for name, key in named.items()}


def _named_in_key(key: object, images: Mapping[str, ImageSource]) -> Instance:
    """Returns a texture that another one names."""
    if len(str(key)) > NAMED_CAP or not isinstance(key, list | tuple):
        raise TextureError("named", described(key), f"the key of a texture, of at most {NAMED_CAP} characters")
    return from_key(key, images)


def _told(make: Callable[..., Instance], *about: object) -> Instance:
    """Returns what a maker makes; what it finds wrong is a TextureError."""
    try:
        return make(*about)
    except FieldError as error:
        raise TextureError(error.place, error.found, error.expected) from None


def _shaped_from_key(key: Sequence[Any], images: Mapping[str, ImageSource]) -> Instance:
    """Returns a texture sent through a curve: ["shaped", base level, curve, key of the texture itself]."""
    inner, deep = key, 0
    while isinstance(inner, list | tuple) and len(inner) == 4 and inner[0] == "shaped":
        inner, deep = inner[3], deep + 1
    if not 0 < deep <= SHAPED_CAP:
        raise TextureError(
            "key", described(key), f'["shaped", base level, curve, key], nested {SHAPED_CAP} times at most'
        )
    made = from_key(key[3], images)
    _check_level(key[1])
    if made.base != key[1]:
        raise TextureError("level", described(key[1]), f"{made.base}, that of the texture itself")
    return Shaped(made, _curve(key[2]))


def _placed_from_key(key: Sequence[Any], images: Mapping[str, ImageSource]) -> Instance:
    """Returns a texture shown elsewhere: ["placed", base level, similarity, key of the texture itself]."""
    similarity = similarity_of(key[2]) if len(key) == 4 else None
    inner = key[3] if similarity is not None else None
    if similarity is None or not isinstance(inner, list | tuple) or inner[:1] in (["placed"], ("placed",)):
        raise TextureError("key", described(key), '["placed", base level, similarity of quarter turns, key]')
    _check_level(key[1])
    made, aligned = from_key(inner, images), similarity.aligned_from
    shown = PlacedInk(made, similarity, key[1])
    if (aligned is not None and key[1] < aligned) or key[1] < made.base - shown.levels:
        raise TextureError("level", described(key[1]), "one at which it has whole pixels, not above the texture's own")
    return shown


def _learnt_from_key(key: Sequence[Any], images: Mapping[str, ImageSource]) -> Instance:
    """Returns a texture with learnt detail: ["learnt", base level, octaves, strength, maps, sha, key]."""
    inner = key[-1]
    plain = isinstance(inner, list | tuple) and bool(inner) and isinstance(inner[0], str)
    if len(key) != 7 or not plain or kind_of_key(inner[0])[0] not in REFINABLE:
        raise TextureError("key", described(key), '["learnt", base level, octaves, strength, maps, sha, key]')
    octaves, strength, name, sha = key[2:6]
    if not (isinstance(name, str) and isinstance(sha, str)):
        raise TextureError("maps", described(name), "a name, and a sha")
    made, (strong, many) = from_key(inner, images), LEARNING
    _check_level(key[1])
    if made.base != key[1]:
        raise TextureError("level", described(key[1]), f"{made.base}, that of the texture itself")
    known = images.get(sha)
    maps = ImageSource(name, sha, known.pixels if known else None)
    return learnt(made, Learning(maps, strong.checked(strength), int(many.checked(octaves))))


def _curve(value: Any) -> Shape:
    """Returns a curve's name, or knots as a brush has them."""
    if isinstance(value, str) and value in CURVES:
        return value
    pairs = value if isinstance(value, list | tuple) and 1 <= len(value) <= KNOTS_CAP else ()
    knots = tuple((float(k[0]), float(k[1])) for k in pairs if _is_knot(k))
    rising = all(a[0] < b[0] for a, b in itertools.pairwise(knots))
    if not knots or len(knots) < len(pairs) or not rising:
        raise TextureError("curve", described(value), f"1 to {KNOTS_CAP} knots [in, out] of 0..1, or a curve's name")
    return knots


def _is_knot(value: Any) -> bool:
    return isinstance(value, list | tuple) and len(value) == 2 and all(is_within(v, 0.0, 1.0) for v in value)


def _row(kind: object) -> Kind:
    row = KINDS.get(kind) if isinstance(kind, str) else None
    if row is None:
        raise TextureError("texture", described(kind), "one of " + ", ".join(KINDS))
    return row


def _check_level(level: object) -> None:
    if not isinstance(level, int) or isinstance(level, bool) or abs(level) > DEEPEST:
        raise TextureError("level", described(level), f"an integer from -{DEEPEST} to {DEEPEST}")
