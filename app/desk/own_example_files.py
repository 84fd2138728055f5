"""The files of the artist's own examples: a picture, its region, and its parameters, each whole or not there."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

import numpy as np

from app.desk import example_state
from app.desk.example_state import MASK, NAME_CAP, PARAMETERS, PICTURE, Entry
from app.desk.region_mask import Mask
from engine.files.atomic import replacing
from engine.files.fault import FileError, WriteError
from engine.texture.example.parameters import Parameters

SIDE = 1024  # pixels along an example, at most
FAULTS = (FileError, WriteError, OSError)  # that any of these functions may raise


def opened(entry: Entry) -> Mask:
    """An example's region, to be painted."""
    from engine.strokes.example_files import read_mask  # here: the engine is loaded by now

    pixels = pixels_of(entry.picture)
    inside = pixels[..., 3] > 0 if entry.mask is None else read_mask(entry.mask)
    if inside.shape != pixels.shape[:2]:
        inside = pixels[..., 3] > 0
    return Mask(pixels, inside, radius=max(2.0, round(max(inside.shape) / 20)))


def pixels_of(path: Path) -> np.ndarray:
    """Uint8 RGBA (h, w, 4), not premultiplied."""
    from engine.files.images import read_image

    pixels, _ = read_image(path)
    return pixels if pixels.dtype == np.uint8 else (pixels >> 8).astype(np.uint8)


def add(path: Path) -> tuple[str, bool]:
    """Makes an example of a picture file: its name, and whether it had to be made smaller."""
    pixels, smaller = fitting(pixels_of(path))
    name = free_name(path.stem)
    _write(_place(name, PICTURE), pixels)
    write_region(name, pixels[..., 3] > 0)
    write_parameters(name, Parameters())
    return name, smaller


def copy(entry: Entry, parameters: Parameters) -> str:
    """Makes an example of the artist's own of any, with other parameters: its name."""
    mask, name = opened(entry), free_name(entry.given or entry.name)
    _write(_place(name, PICTURE), mask.pixels)
    write_region(name, mask.inside)
    write_parameters(name, parameters)
    return name


def write_region(name: str, inside: np.ndarray) -> None:
    """`inside`: bool (h, w); it is white in the file."""
    _write(_place(name, MASK), (inside * 255).astype(np.uint8)[..., None])


def write_parameters(name: str, parameters: Parameters, title: str = "") -> None:
    """Those that are not as usual, and what it is called if not as its files are."""
    usual, lines = asdict(Parameters()), [f'group = "{example_state.OWN}"']
    if title:
        lines.append(f"title = {json.dumps(title, ensure_ascii=False)}")
    for field, value in asdict(parameters).items():
        if value != usual[field]:
            told = str(value).lower() if isinstance(value, bool) else f'"{value}"' if isinstance(value, str) else value
            lines.append(f"{field} = {told}")
    with replacing(_place(name, PARAMETERS)) as file:
        file.write(("\n".join(lines) + "\n").encode())


def delete(name: str) -> None:
    """Takes the files of one of the artist's own away."""
    for ending in (PARAMETERS, MASK, PICTURE):
        _place(name, ending).unlink(missing_ok=True)


def free_name(stem: str) -> str:
    """A file name that no example of the artist's own has yet."""
    plain = "".join(c if c.isalnum() or c in " -_" else "-" for c in stem).strip(" -")[:NAME_CAP].strip() or "example"
    taken = {path.name.lower() for path in example_state.own_folder().glob("*")}
    name, number = plain, 1
    while any(f"{name}{ending}".lower() in taken for ending in (PICTURE, MASK, PARAMETERS)):
        number += 1
        name = f"{plain} {number}"
    return name


def fitting(pixels: np.ndarray) -> tuple[np.ndarray, bool]:
    """A picture, uint8 RGBA (h, w, 4), no larger than an example may be; whether it was made smaller."""
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
