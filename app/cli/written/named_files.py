"""`--texture NAME=FILE` of `inkfall texture expression`: what a text may name besides all that comes along."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from app.cli.outcome import Refused

if TYPE_CHECKING:
    from engine.painting.commands import DefineTexture
    from engine.painting.textures import Texture

_TEXT = ".txt"
_BYTES_MOST = 1 << 20


def textures_named(words: Sequence[str]) -> dict[str, Texture]:
    """Returns the textures of pictures, and of texts, each of which may name those before it."""
    from immutables import Map

    from engine.checks.field_error import FieldError
    from engine.painting.commands import DefineTexture

    found: dict[str, Texture] = {}
    for word in words:
        name, sign, file = word.partition("=")
        if not sign or not name or not file:
            raise Refused(f"--texture: found {word[:40]!a}, expected NAME=FILE, a picture or a {_TEXT}")
        written = Path(file).suffix.lower() == _TEXT
        told = Map({"text": text_of_file(file)} if written else {"path": file})
        try:
            found[name] = defined_among(found, DefineTexture(name, "expression" if written else "image", told))
        except FieldError as error:
            place = f", {error.place.removeprefix('text, ')}" if error.place.startswith("text, ") else ""
            raise Refused(f"{file}{place}: found {error.found}, expected {error.expected}") from None
    return found


def defined_among(textures: dict[str, Texture], command: DefineTexture) -> Texture:
    """Returns a texture whose text may name some others."""
    from immutables import Map

    from engine.canvas import layers
    from engine.makers.makers import define
    from engine.numeric.arithmetic import EVERYWHERE
    from engine.painting.textures import Around

    around = Around(arithmetic=EVERYWHERE, textures=Map(textures))
    return define(command, layers.EMPTY, around)


def text_of_file(file: str) -> str:
    """Returns the text that a file holds."""
    try:
        return Path(file).read_bytes()[: _BYTES_MOST + 1].decode("utf-8-sig")
    except OSError as error:
        raise Refused(f"{file}: {error.strerror or error}") from None
    except UnicodeDecodeError:
        raise Refused(f"{file}: found bytes that are no UTF-8, expected a text") from None
