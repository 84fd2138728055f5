"""The files of the artist's own examples: a picture, its region, and its parameters, each whole or not there.

Any of these functions may raise one of `files.FAULTS`.
"""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from immutables import Map

from app.desk.examples import example_state
from app.desk.examples.example_state import BASE, MASK, NAME_CAP, PARAMETERS, PICTURE, STEPS, Entry, sha_of
from engine.brush.checks import thawed
from engine.files.atomic import replacing
from engine.studio.textures.texture_requests import RegionOpen
from engine.studio.textures.texture_results import RegionScene
from engine.texture.example.parameters import NEW, Parameters

SIDE = 1024  # pixels along an example, at most
STEPS_CAP, STEPS_BYTES = 4096, 1 << 21  # in the definition of a texture, which is one line of a recording
Steps = tuple[Map[str, Any], ...]


def opening_of(entry: Entry) -> RegionOpen:
    """Returns what the engine needs for painting an example's region."""
    from engine.painting.capture import read_picture  # here: the engine is loaded by now

    picture = read_picture(str(entry.picture), None)
    first = _first(entry, picture[3] > 0.0)
    picture.flags.writeable = first.flags.writeable = False
    return RegionOpen(entry.ident, picture, first, entry.steps)


def _first(entry: Entry, opaque: np.ndarray) -> np.ndarray:
    """Returns what the steps of its region begin with, bool (h, w)."""
    base = entry.base if entry.steps else entry.mask
    found = opaque if base is None else _masked(base)
    return found if found.shape == opaque.shape else opaque


def _masked(path: Path) -> np.ndarray:
    from engine.strokes.example_files import read_mask

    return read_mask(path)


def cut_out(entry: Entry) -> tuple[np.ndarray, np.ndarray]:
    """Returns an example's picture, uint8 RGBA (h, w, 4), not premultiplied, and its region, bool (h, w)."""
    pixels = pixels_of(entry.picture)
    inside = pixels[..., 3] > 0 if entry.mask is None else _masked(entry.mask)
    return pixels, inside if inside.shape == pixels.shape[:2] else pixels[..., 3] > 0


def pixels_of(path: Path) -> np.ndarray:
    """Uint8 RGBA (h, w, 4), not premultiplied."""
    from engine.files.images import read_image

    pixels, _ = read_image(path, converted=True)
    return pixels if pixels.dtype == np.uint8 else (pixels >> 8).astype(np.uint8)


def read_only(entry: Entry) -> np.ndarray:
    """As `pixels_of` an example's picture, read-only."""
    pixels = np.ascontiguousarray(pixels_of(entry.picture))
    pixels.flags.writeable = False
    return pixels


def add(path: Path) -> tuple[str, bool]:
    """Makes an example of a picture file: its name, and whether it had to be made smaller."""
    pixels, smaller = fitting(pixels_of(path))
    name = free_file_name(path.stem)
    _write(_place(name, PICTURE), pixels)
    write_region(name, pixels[..., 3] > 0)
    write_parameters(name, NEW)
    return name, smaller


def add_cut(entry: Entry, pixels: np.ndarray, instead: bool) -> list[str]:
    """Makes an example of each thing that was cut out of an example's picture, RGBA (h, w, 4), the largest first: their
    names.  `instead`: the largest takes the place of that example."""
    from engine.texture.mattes.things import cut_apart, grown_region

    names = []
    for n, piece in enumerate(cut_apart(pixels)):
        name = entry.name if instead and n == 0 else free_file_name(entry.given or entry.name)
        _write(_place(name, PICTURE), piece)
        write_region(name, grown_region(piece))
        write_parameters(name, NEW)
        names.append(name)
    return names


def copy(entry: Entry, parameters: Parameters) -> str:
    """Makes an example of the artist's own of any, with other parameters: its name."""
    (pixels, inside), name = cut_out(entry), free_file_name(entry.given or entry.name)
    _write(_place(name, PICTURE), pixels)
    base = None if entry.base is None else _masked(entry.base)
    write_region(name, inside, entry.steps, base)
    write_parameters(name, parameters, maps=entry.maps)
    return name


def save_region(entry: Entry, parameters: Parameters, scene: RegionScene) -> str:
    """Writes the region of an example as it was painted, that of a copy if it is not the artist's own: the name."""
    pixels, _ = cut_out(entry)
    first = _first(entry, pixels[..., 3] > 0)
    base = None if np.array_equal(first, pixels[..., 3] > 0) else first
    name = entry.name if entry.own else copy(entry, parameters)
    write_region(name, scene.inside, scene.steps, base)
    return name


def write_region(name: str, inside: np.ndarray, steps: Steps = (), base: np.ndarray | None = None) -> None:
    """`inside`: bool (h, w); it is white in the file.  `steps`: those that made it of `base`, bool (h, w), or of what
    is not transparent.

    Steps count only with the mask that they made: if some of the files are not written, the mask alone stands.  More of
    them than a definition may have are not kept.
    """
    told = {"mask_sha": sha_of(inside), "base": base is not None, "steps": thawed(steps)}
    data = json.dumps(told, separators=(",", ":")).encode()
    steps = steps if len(steps) <= STEPS_CAP and len(data) <= STEPS_BYTES else ()
    if steps and base is not None:
        _write(_place(name, BASE), (base * 255).astype(np.uint8)[..., None])
    if steps:
        with replacing(_place(name, STEPS)) as file:
            file.write(data)
    _write(_place(name, MASK), (inside * 255).astype(np.uint8)[..., None])
    for ending in (STEPS, BASE) if not steps else (BASE,) if base is None else ():
        _place(name, ending).unlink(missing_ok=True)


def write_parameters(
    name: str,
    parameters: Parameters,
    title: str = "",
    maps: Map[str, object] = Map(),  # noqa: B008
) -> None:
    """Writes those that are not as usual, what it is called if not as its files are, and its maps."""
    usual, lines = asdict(NEW), [f'group = "{example_state.OWN}"']
    if title:
        lines.append(f"title = {json.dumps(title, ensure_ascii=False)}")
    for field, value in asdict(parameters).items():
        if value != usual[field]:
            told = str(value).lower() if isinstance(value, bool) else f'"{value}"' if isinstance(value, str) else value
            lines.append(f"{field} = {told}")
    lines += [f"maps.{json.dumps(one)} = {_toml(chart)}" for one, chart in maps.items()]
    with replacing(_place(name, PARAMETERS)) as file:
        file.write(("\n".join(lines) + "\n").encode())


def _toml(value: object) -> str:
    """Tells a value of a map as TOML does, in one line."""
    if isinstance(value, Map):
        return "{ " + ", ".join(f"{json.dumps(name)} = {_toml(part)}" for name, part in value.items()) + " }"
    if isinstance(value, tuple):
        return "[" + ", ".join(map(_toml, value)) + "]"
    return json.dumps(value, ensure_ascii=False)


def delete(name: str) -> None:
    """Takes the files of one of the artist's own away."""
    for ending in (PARAMETERS, STEPS, MASK, BASE, PICTURE):
        _place(name, ending).unlink(missing_ok=True)


def free_file_name(stem: str) -> str:
    """Returns a file name that no example of the artist's own has yet."""
    plain = "".join(c if c.isalnum() or c in " -_" else "-" for c in stem).strip(" -")[:NAME_CAP].strip() or "example"
    taken = {path.name.lower() for path in example_state.own_folder().glob("*")}
    name, number = plain, 1
    while any(f"{name}{ending}".lower() in taken for ending in (PICTURE, MASK, PARAMETERS, STEPS, BASE)):
        number += 1
        name = f"{plain} {number}"
    return name


def fitting(pixels: np.ndarray) -> tuple[np.ndarray, bool]:
    """Returns a picture, uint8 RGBA (h, w, 4), no larger than an example may be; whether it was made smaller."""
    height, width = pixels.shape[:2]
    if max(height, width) <= SIDE:
        return pixels, False
    from PIL import Image

    scale = SIDE / max(height, width)
    size = max(1, round(width * scale)), max(1, round(height * scale))
    return np.asarray(Image.fromarray(pixels).resize(size, Image.Resampling.BOX)), True


def _place(name: str, ending: str) -> Path:
    folder = example_state.own_folder()
    folder.mkdir(parents=True, exist_ok=True)
    return folder / f"{name}{ending}"


def _write(path: Path, pixels: np.ndarray) -> None:
    from engine.files.png_writer import write_png

    with replacing(path) as file:
        write_png(file, np.ascontiguousarray(pixels))
