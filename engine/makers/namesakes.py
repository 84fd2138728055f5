"""What the names in a written texture stand for: kinds of texture, inks of brushes and examples that come along, the
textures of a painting, and the inks of the artist's own brushes.

What comes along wins, and the painting over brushes of one's own.  A name is looked up where the texture is defined,
and what it stands for is kept with the definition: nothing that is defined later changes it, so no name leads to
itself.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

from immutables import Map

from engine.brush.checks import frozen
from engine.brush.ink import named as of_component
from engine.brush.parts import Component
from engine.brush.settings import Brush
from engine.checks.field_error import FieldError
from engine.checks.values import described
from engine.makers import definitions
from engine.makers.own_inks import Inked, inked, own_ink, own_inks
from engine.numeric.reader import quoted
from engine.painting.capture import read_straight
from engine.painting.commands import DefineTexture
from engine.painting.textures import Texture
from engine.texture.expression.defined import expression
from engine.texture.expression.language import read
from engine.texture.expression.library.bundled_texts import written_library
from engine.texture.expression.naming.bound import bound_anew
from engine.texture.expression.written import OWN_WAY, WrittenError, WrittenText, close_to
from engine.texture.expression.written_ink import Expression, woven_line
from engine.texture.gradient import Gradient
from engine.texture.image import Image, ImageSource
from engine.texture.record import Instance, pictures_of
from engine.texture.shaped import shaped
from engine.texture.table import EXPRESSION, KINDS, instance, of_keys

NAMES_MOST = 16  # of one text
_PALETTES = Path(__file__).resolve().parents[2] / "palettes"
_SLOW = (*definitions.MATCHED, definitions.LEARN, "example", "canvas")  # makers that take long, or need a painting
_USUAL_PERIOD = 32.0

_INKS_KEPT = 64
_INKS: dict[tuple[object, ...], Instance] = {}  # by name, or file and when it changed, seed and arithmetic

Define = Callable[[DefineTexture], Texture]


@dataclass(frozen=True, eq=False, slots=True)
class Namesakes:
    """Where names are looked up: a painting's `textures`; `seed`: of those that tell none; `define` makes the textures
    that a brush brings along, in an `arithmetic`; `pictures`: those that are known by their sha."""

    textures: Mapping[str, Texture]
    define: Define
    arithmetic: int
    pictures: Mapping[str, ImageSource] = Map()
    seed: int = 0

    def of_text(self, text: str, told: Mapping[str, object] = Map()) -> dict[str, Instance]:
        """Returns the textures that a text names and that are not written ones that come along, by name; those whose
        keys are `told` as they were then.  WrittenError tells of a name that there is not."""
        written, found = read(text), dict[str, Instance]()
        for term in written.named:
            name = term.told.strip('"')
            if name in written_library() or name in found:
                continue
            if len(found) == NAMES_MOST:
                raise _refused(written, term.token.at, "one name more", f"{NAMES_MOST} names of textures at most")
            try:
                made = self._as_told(name, told[name]) if name in told else self._of_name(name)
            except FieldError as error:
                raise _refused(written, term.token.at, error.found, error.expected) from None
            if made is None:
                raise _refused(written, term.token.at, quoted(name), self._expected(name))
            if isinstance(made, Expression) and (read(made.text).follows or made.ways > 1):
                raise _refused(written, term.token.at, f"{quoted(name)}, made for a stroke", "a texture that is not")
            found[name] = made
        return found

    def _as_told(self, name: str, key: object) -> Instance:
        """Returns what a name stood for when its text was defined; where a picture is not there, as now, if that is
        the same."""
        made = of_keys({name: key}, self.pictures)[name]
        if all(one.there for one in pictures_of(made)):
            return made
        now = self._of_name(name)
        if now is None or now.key != made.key:
            raise FieldError("named", f"{name!a} as another texture", "what it was when this was recorded")
        return now

    def _of_name(self, name: str) -> Instance | None:
        kind = KINDS.get(name)
        if kind is not None and not kind.pictured and kind.parameters:
            return bound_anew(instance(name, {}, 0, self.seed, arithmetic=self.arithmetic))
        if name in bundled_inks():
            return self._of_brush(name, bundled_inks()[name], (name,))
        found = bundled_picture(name) if name in bundled_pictures() else self._of_painting(name)
        own = own_ink(name) if found is None else None
        return found if own is None else self._of_brush(name, *own)

    def _of_painting(self, name: str) -> Instance | None:
        texture = self.textures.get(name)
        if texture is None:
            return None
        own = {} if "seed" in texture.parameters or texture.kind != EXPRESSION else {"seed": self.seed}
        return bound_anew(texture.instance(own, 0, self.seed))

    def _of_brush(self, name: str, brush: Inked, known: tuple[object, ...]) -> Instance:
        """Returns what the ink of a brush looks like, as a written texture of that."""
        about = *known, self.seed, self.arithmetic
        if about not in _INKS:
            if len(_INKS) >= _INKS_KEPT:
                _INKS.clear()
            _INKS[about] = self._ink(name, *brush)
        return _INKS[about]

    def _ink(self, name: str, brush: Brush, textures: tuple[DefineTexture, ...]) -> Instance:
        if any(command.maker in _SLOW for command in textures):
            found = f"{quoted(name)}, whose ink is made from an example or the canvas"
            raise FieldError(
                "ink", found, "a brush whose ink is not: that texture may be named once the painting has it"
            )
        defined = {command.name: self.define(command) for command in textures}
        named, parts, periods = dict[str, Instance](), list[str](), list[float]()
        for number, component in enumerate(brush.ink, 1):
            own = of_component(component, defined, 0, self.seed, name)
            if getattr(own, "ways", 1) > 1:
                raise FieldError("ink", f"{quoted(name)}, made for a stroke", "a texture that is not")
            periods.append(_period(own))
            named[str(number)] = bound_anew(shaped(own, component.shaping, brush.shaping))
            often = periods[0] / periods[-1]
            parts.append(_part(number, component, often, _shows_colours(own), getattr(own, "cover", None) is not None))
        text = "\n".join((f"ground = {brush.colour}", " + ".join(("ground", *parts))))
        return expression({"text": text, "named": named, "seed": self.seed}, 0)

    def _expected(self, name: str) -> str:
        kinds = [row.name for row in KINDS.values() if row.parameters and not row.pictured]
        every = [*written_library(), *kinds, *bundled_inks(), *bundled_pictures(), *self.textures, *own_inks()]
        like = close_to(name, every)
        about = "the name of a texture that comes along, that the painting has, or of a brush of your own"
        return about + (f", such as {like}" if like else "")


def texture_names(textures: Mapping[str, Texture]) -> tuple[tuple[str, str], ...]:
    """Returns all names that a text may call textures by over a painting with some `textures`, in the order of the
    alphabet, each with what it is; as short as the kind of it where nothing else is told."""
    found = dict.fromkeys(own_inks(), "the ink of a brush of your own")
    found |= {name: f"a texture of the painting: {texture.kind}" for name, texture in textures.items()}
    found |= dict.fromkeys(bundled_pictures(), "the picture of an example")
    found |= dict.fromkeys(bundled_inks(), "the ink of a brush")
    found |= {row.name: row.tooltip for row in KINDS.values() if row.parameters and not row.pictured}
    found |= {name: told.about for name, told in written_library().items() if OWN_WAY not in read(told.text).felt}
    return tuple(sorted(found.items()))


def with_names(told: Map[str, Any], known: Namesakes) -> Texture:
    """Returns a written texture with all that its text names: as it is told, else as names are looked up now."""
    text, seed, kept = told.get("text"), told.get("seed", 0), told.get("named", Map())
    if not isinstance(kept, Mapping):
        raise FieldError("named", described(kept), "{name: the key of a texture, ...}")
    if not isinstance(text, str) or not isinstance(seed, int):  # which is told where it is checked
        return Texture(EXPRESSION, told)
    try:
        made = replace(known, seed=seed).of_text(text, kept) if '"' in text else {}
    except WrittenError as error:
        raise FieldError(f"text, line {error.line}, column {error.column}", error.found, error.expected) from None
    keys = Map({name: frozen(one.key) for name, one in made.items()})
    pictures = {one.sha: one for each in made.values() for one in pictures_of(each)}
    told = told.set("named", keys) if keys or "named" in told else told
    return Texture(EXPRESSION, told, named=tuple(pictures.values()))


def _refused(written: WrittenText, at: int, found: str, expected: str) -> WrittenError:
    return WrittenError(written.place(at), found, expected)


def _period(made: Instance) -> float:
    """Returns how many pixels a texture that a brush names calls 1."""
    found = getattr(made, "period", _USUAL_PERIOD)
    return float(found) if isinstance(found, int | float) else _USUAL_PERIOD


def _shows_colours(made: Instance) -> bool:
    if isinstance(made, Expression):
        return woven_line(made.text, made.values, made.named, made.seed, 0, made.period).value.coloured
    return bool(getattr(made, "coloured", False) or isinstance(made, Image | Gradient))


def _part(number: int, component: Component, often: float, coloured: bool, clear: bool) -> str:
    """Returns what a component adds to the brush's colour, as `engine.brush.ink` mixes it."""
    place = "x, y" if often == 1.0 else f"x*{often:.9g}, y*{often:.9g}"
    seen = f'"{number}"({place})'
    if clear:
        return f"({component.colour}*{seen} - ground*alpha({seen}))*{component.amount:.9g}"
    if coloured:
        return f"({component.colour}*{seen} - ground)*{component.amount:.9g}"
    return f"({component.colour} - ground)*({component.amount:.9g}*{seen})"


@lru_cache(1)
def bundled_inks() -> Mapping[str, Inked]:
    """Returns the brushes that come along and have textures in their ink, with what defines these, by name."""
    found = {}
    for path in sorted((_PALETTES / "brushes").glob("*.json")):
        brush = inked(json.loads(path.read_text("utf-8")), path.parent)
        if brush is not None and not any(command.maker in _SLOW for command in brush[1]):
            found[path.stem] = brush
    return Map(found)


@lru_cache(1)
def bundled_pictures() -> Mapping[str, Path]:
    """Returns the pictures of examples that come along, by name."""
    paths = sorted((_PALETTES / "examples").glob("*.png"))
    return Map({path.stem: path for path in paths if "." not in path.stem})


@lru_cache(8)
def bundled_picture(name: str) -> Instance:
    """Returns the picture of an example that comes along as a texture."""
    return bound_anew(Image(0, 1, ImageSource.of_raster(name, read_straight(str(bundled_pictures()[name]), None))))
