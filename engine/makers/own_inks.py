"""The brushes of the artist's own, whose inks written textures may name: files of one folder, one JSON object each."""

from __future__ import annotations

import json
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path

import platformdirs

from engine.brush import settings
from engine.brush.settings import Brush
from engine.makers import definitions
from engine.painting.commands import DefineTexture

_LARGEST_FILE = 1 << 20  # bytes
_KEPT = 512

Inked = tuple[Brush, tuple[DefineTexture, ...]]


def own_brushes_folder() -> Path:
    """Tells where the artist's own brushes are kept."""
    return platformdirs.user_config_path("inkfall") / "brushes"


def inked(told: dict[str, object], folder: Path) -> Inked | None:
    """Returns a brush that an object tells, with what defines the textures of its ink; None if it lays no ink of
    textures.  FieldError names what is wrong."""
    plain = {
        name: value for name, value in told.items() if name not in ("name", "group", "tags", "coloured", "textures")
    }
    brush = settings.from_json(told.get("brush", plain))
    textures = definitions.used(brush, definitions.read(told.get("textures", []), "textures", folder))
    return (brush, textures) if brush.ink and brush.row.lays_ink else None


def own_inks() -> dict[str, Path]:
    """Returns the files of the artist's own brushes that lay ink of textures, by the names of the brushes."""
    return {name: path for path, name, _ in _all() if name}


def own_ink(name: str) -> tuple[Inked, tuple[object, ...]] | None:
    """Returns the brush of a name, and what changes when its file does; None if there is none that lays ink of
    textures."""
    for path, own, changes in _all():
        if own == name:
            found = _read(path, changes)[1]
            return None if found is None else (found, (path, changes))
    return None


def _all() -> Iterator[tuple[Path, str, tuple[int, int]]]:
    for path in sorted(own_brushes_folder().glob("*.json")):
        try:
            told = path.stat()
            changes = told.st_mtime_ns, told.st_size
            yield path, _read(path, changes)[0], changes
        except OSError:
            continue


@lru_cache(_KEPT)
def _read(path: Path, changes: tuple[int, int]) -> tuple[str, Inked | None]:
    """Returns the name of a brush and what it paints with; no name where a file is no such brush."""
    try:
        told = json.loads(path.read_text("utf-8")) if changes[1] <= _LARGEST_FILE else None
        if not isinstance(told, dict):
            return "", None
        found = inked(told, path.parent)
        return ("", None) if found is None else (str(told.get("name") or path.stem), found)
    except (OSError, ValueError):
        return "", None
