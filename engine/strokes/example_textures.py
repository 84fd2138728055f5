"""Example textures as definitions tell them: a picture, the region of it that is grown, and parameters.

A definition names files, or one of the examples that come with the program.  What it found in them is recorded with it,
so that a painting keeps its examples although files change.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from immutables import Map

from engine.brush.checks import BrushError, thawed
from engine.brush.footprint import Footprint
from engine.checks.field_error import FieldError
from engine.checks.values import described
from engine.files.fault import FileError
from engine.files.strict_json import Fields
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba16
from engine.numeric.memo import remembered
from engine.painting import commands as c
from engine.painting.capture import read_straight
from engine.painting.textures import Around, Texture
from engine.strokes import example_maps
from engine.strokes.example_files import kept, read_map_table, read_mask, read_parameters
from engine.strokes.example_region import STEPS_CAP, followed
from engine.texture.example.control import Channels
from engine.texture.example.controlled import analysed_with
from engine.texture.example.exemplar import EXAMPLE_SIDE, Exemplar, shrunk
from engine.texture.example.parameters import FIELDS, Parameters, with_values
from engine.texture.image import ImageSource
from engine.texture.learnt.refinement import Learning
from engine.texture.table import refinement

KIND = "example"
BUNDLED = Path(__file__).resolve().parents[2] / "palettes" / "examples"
STROKES_CAP = 4096
_ENDINGS = {"path": ".png", "mask": ".mask.png", "params": ".toml"}
_WHITE = 0.5
_SHAS = "sha", "mask_sha", "control_sha"
_CHANGED = "is not what was there when it was recorded"


@dataclass(frozen=True, slots=True)
class Origin:
    """What an exemplar was made of, besides its parameters: its texture's picture and mask, the detail left out, its
    control channels with their planes, and what was learnt of its picture."""

    source: ImageSource
    mask: ImageSource | None
    detail: int
    channels: Channels = ()
    control: ImageSource | None = None
    learning: Learning | None = None


def of_definition(command: c.DefineTexture, around: Around) -> Texture:
    """Returns the texture that a command of the maker "example" defines.

    `path` of a picture or `bundled`, the name of one that comes along; `mask`, a picture that is light where the region
    is (else it is where the picture is not transparent), `mask_strokes`, painted on it, and `region`, steps by which it
    is changed; `params`, a TOML file, and any of its fields; `maps`, as in that file (module `example_maps`).
    FieldError names the member, FileError the file.
    """
    members = Fields(thawed(command.arguments), "")
    paths = _paths(members, around.folder)
    source = _picture(command.name, members, paths["path"], around)
    found = _parameters(members, paths["params"])
    mask = _mask(command.name, members, paths["mask"], source, around)
    if mask is not None:
        found["mask_sha"] = mask.sha
    found |= (told := _control(command, (source, mask), paths["params"], around)).found
    given = {name: value for name, value in command.arguments.items() if name not in (*_SHAS, "controls")}
    parameters = command.arguments.update(found).update(given)
    texture = Texture(KIND, parameters, source, mask, around.arithmetic, control=told.picture)
    exemplar_of(texture)  # what is wrong with it is told where it is defined
    return texture


def _paths(members: Fields, folder: Path | None) -> dict[str, Path | None]:
    """Returns the files that a definition names, absolute or from the current folder."""
    found: dict[str, Path | None] = {"path": None, "mask": None, "params": None}
    if "bundled" in members:
        if "path" in members:
            raise members.fault("bundled", "either path or bundled")
        name = members.text("bundled")
        if name not in bundled():
            raise members.fault("bundled", f"one of {', '.join(bundled())}")
        found = {
            "path": BUNDLED / f"{name}.png",
            "mask": BUNDLED / f"{name}.mask.png",
            "params": BUNDLED / f"{name}.toml",
        }
        found = {what: place if place is not None and place.exists() else None for what, place in found.items()}
    for what in found:
        if what in members:
            path = Path(members.text(what, cap=4096))
            found[what] = path if folder is None else folder / path
    return found


@lru_cache(maxsize=1)
def bundled() -> tuple[str, ...]:
    """Returns the names of the examples that come along."""
    return tuple(sorted(path.stem for path in BUNDLED.glob("*.png") if not path.name.endswith(".mask.png")))


def _picture(name: str, members: Fields, path: Path | None, around: Around) -> ImageSource:
    sha = members.text("sha", None, cap=64)
    if sha is not None and sha in around.pictures:
        return replace(around.pictures[sha], name=name)
    if path is None:
        raise FieldError("path", "nothing", "path, a picture, or bundled, the name of an example")
    source = ImageSource.of_raster(name, read_straight(str(path), None))
    if sha is not None and sha != source.sha:
        raise FileError(path, _CHANGED)
    return source


def _parameters(members: Fields, path: Path | None) -> dict[str, Any]:
    """Returns those of a file, all of which are recorded; none where the definition itself tells all."""
    if path is None or all(name in members for name in FIELDS):
        return {}
    _regular(path)
    return asdict(read_parameters(path))


def _mask(name: str, members: Fields, path: Path | None, source: ImageSource, around: Around) -> ImageSource | None:
    """Returns the region as a picture, white inside; None where it goes by the picture's alpha."""
    sha = members.text("mask_sha", None, cap=64)
    if sha is not None and sha in around.pictures:
        return replace(around.pictures[sha], name=name)
    strokes = members.take("mask_strokes", [])
    if not isinstance(strokes, list) or len(strokes) > STROKES_CAP:
        raise members.fault("mask_strokes", f"a list of at most {STROKES_CAP} strokes")
    steps = members.take("region", [])
    if not isinstance(steps, list) or len(steps) > STEPS_CAP:
        raise members.fault("region", f"a list of at most {STEPS_CAP} steps")
    if path is None and not strokes and not steps:
        return None
    if path is not None:
        _regular(path)
        inside = read_mask(path)
    else:
        inside = source.planes(source.whole)[3] > 0.0
    for i, stroke in enumerate(strokes):
        inside = _with_stroke(inside, stroke, f"mask_strokes[{i}]")
    if steps:
        inside = _with_steps(inside, steps, source, path)
    found = ImageSource.of(name, np.repeat(inside[None].astype(np.float32), 4, axis=0))
    if sha is not None and sha != found.sha:
        raise FileError(path or name, _CHANGED)
    return found


class _Told(NamedTuple):
    """The planes of control channels, as one picture, and what is to be recorded of them."""

    picture: ImageSource | None = None
    found: Map[str, object] = Map()


def _control(
    command: c.DefineTexture, pictures: tuple[ImageSource, ImageSource | None], params: Path | None, around: Around
) -> _Told:
    """Returns the control channels of an example: of the maps that its definition tells, or else its parameter file."""
    members = Fields(command.arguments, "")
    sha = members.text("control_sha", None, cap=64)
    if sha is not None and sha in around.pictures and "controls" in members:
        picture = replace(around.pictures[sha], name=command.name)
        return _Told(picture, Map({"controls": members.take("controls")}))
    value, folder, place = members.take("maps", None), around.folder, "maps"
    told = all(name in members for name in FIELDS) and "bundled" not in members  # by the definition itself
    new = "controls" in members or not told
    if value is None and params is not None and new:
        _regular(params)
        value, folder = read_map_table(params), params.parent
        place = f"{params}: maps"
    maps = () if value is None else example_maps.read_maps(value, place)
    if not maps:
        return _Told()
    channels, picture = example_maps.made(command.name, maps, folder, _inside(*pictures), place)
    if sha is not None and sha != picture.sha:
        raise FileError(command.name, f"maps: what they tell {_CHANGED}")
    return _Told(picture, Map({"controls": example_maps.channels_to_json(channels)}))


def _inside(source: ImageSource, mask: ImageSource | None) -> np.ndarray:
    """Returns the region of an example, bool (h, w)."""
    shown = source.planes(source.whole)[3] > 0.0 if mask is None else mask.planes(mask.whole)[3] > _WHITE
    out: np.ndarray = shown
    return out


def _with_stroke(inside: np.ndarray, value: object, where: str) -> np.ndarray:
    """Returns the region with what a stroke takes, or without it if the stroke erases."""
    if not isinstance(value, Mapping):
        raise FieldError(where, described(value), "a stroke")
    stroke = c.parse({"do": "stroke", **value}, where)
    assert isinstance(stroke, c.Stroke)
    out, whole = inside.copy(), Rect(0, 0, inside.shape[1], inside.shape[0])
    for rect, taken in Footprint(stroke.brush, stroke.origin, copies=stroke.copies).whole(stroke.points):
        part = rect.intersect(whole)
        if not part.empty:
            out[part.slices(whole)][taken[part.slices(rect)]] = not stroke.brush.row.takes_away
    return out


def _with_steps(inside: np.ndarray, steps: list[object], source: ImageSource, path: Path | None) -> np.ndarray:
    if inside.shape != (source.height, source.width):
        size = f"{source.width} x {source.height}"
        raise FileError(path or source.name, f"found a mask of another size, expected {size} pixels")
    return followed(inside, steps, source.planes(source.whole))


def _regular(path: Path) -> None:
    if not os.path.isfile(path):  # also so that no pipe or device is opened
        raise FileError(path, "found no file there")


def parameters_of(texture: Texture) -> Parameters:
    """Gives the parameters by which an example texture is grown.  FieldError names what is wrong."""
    return with_values(Parameters(), {name: texture.parameters[name] for name in FIELDS if name in texture.parameters})


def exemplar_of(texture: Texture, detail: int = 0) -> Exemplar:
    """Returns what is painted with a texture of this kind, whose finest `detail` levels are kept for zooming in.

    FieldError where there is nothing to learn from.
    """
    if texture.kind != KIND or texture.source is None or not texture.source.there:
        raise BrushError("brush.example", f"a texture of the kind {texture.kind}", "one of the maker example")
    channels = channels_of(texture)
    control = texture.control if channels else None
    origin = Origin(texture.source, texture.mask, detail, channels, control, learning_of(texture))
    return _analysed(origin, parameters_of(texture), texture.arithmetic)


def channels_of(texture: Texture) -> Channels:
    """Gives the control channels of an example texture.  FieldError if they are none."""
    if texture.control is None or not texture.control.there:
        return ()
    return example_maps.channels_from_json(texture.parameters.get("controls"))


def learning_of(texture: Texture) -> Learning | None:
    """Tells how an example texture goes on below its own pixels, if by what was learnt of it."""
    how = refinement(texture.parameters)
    if how is None or texture.maps is None or not texture.maps.there:
        return None
    return Learning(texture.maps, *how)


def key_of(texture: Texture, detail: int = 0) -> str:
    """Tells whether two exemplars are the same: by what they are made of."""
    assert texture.source is not None
    mask = "" if texture.mask is None else texture.mask.sha
    about: tuple[object, ...] = (texture.source.sha, mask, asdict(parameters_of(texture)), detail)
    if texture.control is not None:
        about = (*about, texture.control.sha, example_maps.channels_to_json(channels_of(texture)))
    learning = learning_of(texture)
    if learning is not None:
        about = (*about, learning.maps.sha, learning.strength, learning.octaves)
    return hashlib.sha256(repr(about).encode()).hexdigest()


@remembered
def _analysed(origin: Origin, parameters: Parameters, arithmetic: int) -> Exemplar:
    source, mask, detail = origin.source, origin.mask, origin.detail
    if origin.learning is not None:
        plain = _analysed(replace(origin, learning=None), parameters, arithmetic)
        return replace(plain, origin=origin, learning=origin.learning)
    if detail:
        whole = _analysed(replace(origin, detail=0), parameters, arithmetic)
        return replace(shrunk(whole, detail), origin=origin)
    height, width = source.height, source.width
    if max(height, width) > EXAMPLE_SIDE:
        raise FieldError("example", f"{width} x {height} pixels", f"at most {EXAMPLE_SIDE} x {EXAMPLE_SIDE}")
    inside = None if mask is None or not mask.there else mask.planes(mask.whole)[3] > _WHITE
    pixels = to_rgba16(source.planes(source.whole))
    if origin.control is None:
        return replace(kept(pixels, inside, parameters, arithmetic=arithmetic), origin=origin)
    planes = example_maps.control_planes(origin.control, len(origin.channels))
    if planes.shape[1:] != (height, width):
        size = f"{origin.control.width} x {origin.control.height} pixels"
        raise FieldError("maps", size, f"{width} x {height} for each as the example")
    return replace(analysed_with(pixels, inside, parameters, (origin.channels, planes), arithmetic), origin=origin)
