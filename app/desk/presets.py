"""Brush presets and papers: files of palettes/brushes, palettes/grains and the user's own folder, one JSON object each
(feature A5)."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from engine.brush import parts, settings
from engine.brush.parts import Surface
from engine.brush.settings import Brush
from engine.checks.field_error import FieldError
from engine.checks.values import described
from engine.files.atomic import replacing
from engine.makers import definitions, own_inks
from engine.painting.commands import DefineTexture

BYTES_CAP = 1 << 20
NAME_CAP = 40  # characters
TAGS_CAP = 32
OWN = "Own"  # the group of brushes that name none
_GROUP_RANK = {"Basic": 0, OWN: 2}  # others lie between, by name


@dataclass(frozen=True, slots=True)
class Preset:
    """A brush under a name; presets of one `group` are listed together.  `textures`: definitions that it needs;
    `coloured`: it is about its colour, which is painted with once it is chosen;
    `tags`: words that it is found by, besides its name and group."""

    name: str
    brush: Brush
    path: Path | None = None
    group: str = OWN
    textures: tuple[DefineTexture, ...] = ()
    coloured: bool = False
    tags: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Paper:
    """A surface to paint on, under a name: what a brush's grain becomes when it is chosen."""

    name: str
    grain: Surface
    textures: tuple[DefineTexture, ...]


DEFAULT = Preset("Round", Brush(radius=12.0))


def bundled_folder() -> Path:
    """Returns the presets that come with the program; the folder lies beside the packages."""
    return Path(__file__).resolve().parents[2] / "palettes" / "brushes"


def papers_folder() -> Path:
    """Returns the papers that come with the program."""
    return bundled_folder().with_name("grains")


def own_folder() -> Path:
    """Tells where the artist's own presets are kept."""
    return own_inks.own_brushes_folder()


def load_brushes(folder: Path) -> tuple[list[Preset], list[str]]:
    """Returns the presets of a folder by file name, and a line for each file that is none."""
    presets, faults = _all(folder, _read)
    presets.sort(key=lambda p: (_GROUP_RANK.get(p.group, 1), p.group, _order(p)))
    return presets, faults


def load_papers(folder: Path) -> tuple[list[Paper], list[str]]:
    """Returns the papers of a folder by file name, and a line for each file that is none."""
    return _all(folder, _read_paper)


def _all(folder: Path, read: Callable[[Path], Any]) -> tuple[list[Any], list[str]]:
    found, faults = [], []
    for path in sorted(folder.glob("*.json")) if folder.is_dir() else []:
        try:
            found.append(read(path))
        except (OSError, ValueError) as error:
            faults.append(f"{path.name}: {error}")
    return found, faults


def _order(preset: Preset) -> tuple[bool, str]:
    """Brushes that paint first, then by name."""
    return not preset.brush.row.lays_ink, preset.name


def _object(path: Path, what: str) -> dict[str, Any]:
    """Returns the JSON object of a file.  ValueError says what was found and expected."""
    if path.stat().st_size > BYTES_CAP:
        raise ValueError(f"found {path.stat().st_size} bytes, expected {what} of at most {BYTES_CAP}")
    data = json.loads(path.read_text("utf-8"))
    if not isinstance(data, dict):
        raise ValueError(f"found no object, expected {what}")
    return data


def _read_paper(path: Path) -> Paper:
    data = _object(path, "a paper")
    textures = definitions.read(data.get("textures", []), "textures", path.parent)
    return Paper(str(data.get("name") or path.stem), parts.surface(data.get("grain"), "grain"), textures)


def _read(path: Path) -> Preset:
    name = path.stem.split("-", 1)[-1].replace("-", " ").replace("_", " ").capitalize()
    return replace(preset_of(_object(path, "a brush"), name, path.parent), path=path)


def preset_of(data: dict[str, object], name: str, folder: Path) -> Preset:
    """Returns the preset that an object tells, called `name` if it has none of its own; paths start from `folder`.
    FieldError names the member."""
    data = dict(data)
    name = str(data.pop("name", None) or name)
    group = str(data.pop("group", OWN))
    tags = data.pop("tags", [])
    if not isinstance(tags, list) or len(tags) > TAGS_CAP or not all(isinstance(tag, str) for tag in tags):
        raise FieldError("tags", described(tags), f"a list of at most {TAGS_CAP} texts")
    textures = definitions.read(data.pop("textures", []), "textures", folder)
    coloured = parts.flag(data.pop("coloured", False), "coloured")
    brush = settings.from_json(data.pop("brush", data))
    return Preset(name, brush, None, group, textures, coloured, tuple(tags))


def preset_json(preset: Preset) -> dict[str, object]:
    """Returns the object that a preset's file holds."""
    told: dict[str, object] = {"name": preset.name, "brush": settings.to_json(preset.brush)}
    told |= {"group": preset.group} if preset.group != OWN else {}
    told |= {"tags": list(preset.tags)} if preset.tags else {}
    told |= {"coloured": True} if preset.coloured else {}
    told |= {"textures": definitions.to_json(preset.textures)} if preset.textures else {}
    return told


def is_own(preset: Preset) -> bool:
    """Tells whether it is one of the artist's own."""
    return preset.path is not None and preset.path.parent != bundled_folder()


def found(presets: Iterable[Preset], group: str, words: str) -> list[tuple[str, list[Preset]]]:
    """Presets by group, in their order: those of a group (all: ""), or those of any group that have each of `words` in
    their names, their group's or their tags."""
    out: dict[str, list[Preset]] = {}
    wanted = words.casefold().split()
    for preset in presets:
        told = " ".join((preset.name, preset.group, *preset.tags)).casefold()
        if all(word in told for word in wanted) if wanted else group in ("", preset.group):
            out.setdefault(preset.group, []).append(preset)
    return list(out.items())


def nearest(presets: Iterable[Preset], words: str) -> Preset | None:
    """Returns the preset that `words` mean: the one of that name comes first, then those whose name begins so, then
    those with all of it in their name."""
    wanted = " ".join(words.casefold().split())
    listed = [preset for _, members in found(presets, "", words) for preset in members]
    names = [(preset.name.casefold(), preset) for preset in listed]
    ranked = sorted(names, key=lambda row: (row[0] != wanted, not row[0].startswith(wanted), wanted not in row[0]))
    return ranked[0][1] if wanted and ranked else None


def free_brush_name(name: str, presets: Iterable[Preset]) -> str:
    """Returns the name itself, or with a number, so that no bundled preset has it; one of the artist's own is
    replaced."""
    return free_among(name, (preset.name for preset in presets if not is_own(preset)))


def free_among(name: str, taken: Iterable[str]) -> str:
    """Returns a name as it may be kept: itself, or with a number, where another brush has it."""
    name = " ".join("".join(ch for ch in name if ch.isprintable()).split())[:NAME_CAP] or "My brush"
    lower, wanted, number = {other.lower() for other in taken}, name, 1
    while wanted.lower() in lower:
        number += 1
        wanted = f"{name} {number}"
    return wanted


def written(preset: Preset, folder: Path) -> Preset:
    """Writes a preset as `save_brush` does; returns it with its file."""
    return replace(preset, path=save_brush(preset, folder))


def save_brush(preset: Preset, folder: Path) -> Path:
    """Writes a preset as a file of the user's folder, in place of the one of that name."""
    folder.mkdir(parents=True, exist_ok=True)
    path = _own_path(preset.name, folder)
    text = json.dumps(preset_json(preset), indent=1, ensure_ascii=False)
    with replacing(path) as file:
        file.write((text + "\n").encode("utf-8"))
    return path


def delete(preset: Preset) -> None:
    """Takes the file of one of the artist's own away."""
    if preset.path is not None:
        preset.path.unlink(missing_ok=True)


def put_back(preset: Preset, told: bytes, taken: Iterable[str]) -> Preset:
    """Writes the file of a brush that was deleted again, as it was; under another name where that is `taken` since."""
    name = free_among(preset.name, taken)
    if preset.path is None or name != preset.name or preset.path.exists():
        return written(replace(preset, name=name), own_folder())
    with replacing(preset.path) as file:
        file.write(told)
    return preset


def stem_of(name: str) -> str:
    """Returns a brush's name as a file may be called."""
    return "".join(ch if ch.isalnum() else "-" for ch in name.lower()).strip("-") or "brush"


def _own_path(name: str, folder: Path) -> Path:
    """Returns the file of a name: another one where a brush of another name has it, such as "a b" and "a-b"."""
    stem = stem_of(name)
    path, number = folder / f"{stem}.json", 1
    while path.exists() and _name_in(path) != name:
        number += 1
        path = folder / f"{stem}-{number}.json"
    return path


def _name_in(path: Path) -> str | None:
    try:
        return _read(path).name
    except (OSError, ValueError):
        return None
