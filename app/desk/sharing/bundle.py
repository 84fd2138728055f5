"""A brush as one file, `.inkbrush`: a ZIP archive of `brush.json`, as a preset's own file has it, and of the pictures
that its textures name, `files/0.png` and so on.

It comes from strangers: nothing in it is believed before it is checked, and no path leads out of it.
"""

from __future__ import annotations

import io
import json
import re
import shutil
import tempfile
from pathlib import Path

from app.desk import presets
from app.desk.presets import Preset
from engine.checks.field_error import FieldError
from engine.files import strict_json
from engine.files.atomic import replacing
from engine.files.fault import FileError, shown
from engine.files.images import picture_size
from engine.files.limits import Limits
from engine.files.zip_reader import ZipArchive
from engine.files.zip_writer import ZipWriter
from engine.makers.definitions import named_files, with_files

_TOLD = "brush.json"
_LIMITS = Limits(file=256 << 20, entries=64, name=64, directory=1 << 16)
_FILE_CAP = 64 << 20  # bytes of one picture
_PICTURES = (".png", ".jpg", ".jpeg", ".tif", ".tiff")
_MEMBER = re.compile(r"files/\d{1,2}\.(png|jpe?g|tiff?|toml|json)")


def write_bundle(preset: Preset, path: Path) -> None:
    """Writes a brush with all that it needs.  FileError or OSError where something of it cannot be read."""
    names: dict[str, str] = {}
    for texture in preset.textures:
        for file in named_files(texture):
            names.setdefault(file, f"files/{len(names)}{Path(file).suffix.lower()}")
    told = presets.preset_json(preset)
    told["textures"] = with_files(told.get("textures", []), lambda file: names[file])
    held = io.BytesIO()
    writer = ZipWriter(held)
    writer.add(_TOLD, json.dumps(told, indent=1, ensure_ascii=False).encode("utf-8"), deflate=True)
    for file, name in names.items():
        if not _MEMBER.fullmatch(name):
            raise FileError(path.name, f"the brush needs {shown(Path(file).name)}; a picture was expected")
        if Path(file).stat().st_size > _FILE_CAP:
            raise FileError(path.name, f"{shown(Path(file).name)} has more than {_FILE_CAP >> 20} MiB")
        writer.add(name, Path(file).read_bytes())
    writer.close()
    with replacing(path) as out:
        out.write(held.getvalue())


def read_bundle(path: Path, folder: Path, taken: set[str]) -> Preset:
    """Returns the brush that a file holds, written into a folder of presets under a name that is not `taken`.
    FileError, FieldError or OSError where it holds none; nothing is left of it then."""
    with path.open("rb") as file:
        archive = ZipArchive(file, path.name, _LIMITS)
        data = strict_json.loads(archive.read(_TOLD, presets.BYTES_CAP))
        if not isinstance(data, dict):
            raise FileError(path.name, f"{_TOLD} holds no object; a brush was expected")
        files = {name: archive.read(name, _FILE_CAP) for name in _named(data, archive)}
    return keep_brush(data, files, path.stem, folder, taken)


def keep_brush(data: dict[str, object], files: dict[str, bytes], name: str, folder: Path, taken: set[str]) -> Preset:
    """Writes the brush that an object tells, called `name` if it has no name of its own, and the pictures that it
    names into a folder of presets, under a name that is not `taken`; returns it.  FieldError, FileError or OSError;
    nothing is left of it then."""
    preset = presets.preset_of({**data, "group": data.get("group", presets.OWN)}, name, folder)
    name = presets.free_among(preset.name, taken)
    beside = folder / f"{presets.stem_of(name)}-files"
    folder.mkdir(parents=True, exist_ok=True)
    part = Path(tempfile.mkdtemp(prefix=".part-", dir=folder))
    try:
        (part / "files").mkdir()
        for member, body in files.items():
            (part / member).write_bytes(body)
            if Path(member).suffix in _PICTURES:
                picture_size(part / member)
        if files:
            beside = _placed(part, beside)
        kept = presets.preset_of({**data, "name": name}, name, beside)
        return presets.written(kept, folder)
    except BaseException:
        if files:
            shutil.rmtree(beside, ignore_errors=True)
        raise
    finally:
        shutil.rmtree(part, ignore_errors=True)


def _named(data: dict[str, object], archive: ZipArchive) -> list[str]:
    """Returns the members that the brush's textures name, each once.  FieldError for a path that is none."""
    found: dict[str, None] = {}

    def note(file: str) -> str:
        if not _MEMBER.fullmatch(file) or file not in archive:
            raise FieldError("textures", shown(file), "a picture that the file holds")
        found[file] = None
        return file

    with_files(data.get("textures", []), note)
    return [*found]


def _placed(part: Path, wanted: Path) -> Path:
    """Gives a folder its name, or the next that is free; returns it."""
    place, number = wanted, 1
    while place.exists():
        number += 1
        place = wanted.with_name(f"{wanted.name}-{number}")
    part.rename(place)
    return place
