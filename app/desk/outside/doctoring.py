"""The texture doctor's advice is taken: the maker that suits a picture gets it, which is set straight first if that is
asked for."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path

import platformdirs
from immutables import Map

from app.desk.desk import Desk, FileWork
from app.desk.examples import example_work
from app.desk.outside.pictured import free_texture_name
from engine.painting.commands import DefineTexture
from engine.studio.requests import Do
from engine.studio.textures.texture_requests import DoctorAsk

_STRUCTURES = {"histograms": "none"} | {name: name for name in ("statistics", "objects", "full", "pieces")}


def ask_doctor(desk: Desk, path: Path) -> None:
    """Opens the doctor's dialog over a picture file."""
    desk.asked.doctor, desk.match.doctored = path, None
    desk.asked.show("texture doctor")
    look_at(desk, False)


def look_at(desk: Desk, flat: bool) -> None:
    """Has the picture examined, as it is or set straight."""
    assert desk.asked.doctor is not None
    desk.match.doctored = None
    desk.post(DoctorAsk(str(desk.asked.doctor.absolute()), flat))


def follow_advice(desk: Desk, way: str, flat: bool) -> None:
    """Takes the picture of the dialog in one of the ways that were tried, or as "paper"."""
    path = desk.asked.doctor
    assert path is not None
    if flat:
        desk.work(_Straighten(path, way))
    else:
        _take(desk, path, way)


def _take(desk: Desk, path: Path, way: str) -> None:
    if way in _STRUCTURES:
        desk.match.examples = [None, None]
        desk.match.show_file(0, path)
        desk.match.structure = _STRUCTURES[way]
        desk.strip, desk.panels = "match", True
        desk.match.use(desk.post, "ink", free_texture_name(desk, path.stem))
    elif way == "grown":
        desk.strip, desk.panels, desk.examples.tab = "examples", True, "palette"
        example_work.add(desk, path, shown=False)
    else:
        name = free_texture_name(desk, path.stem)
        maker = "image" if way == "paper" else "impulse"
        desk.post(Do(DefineTexture(name, maker, Map({"path": str(path.absolute())}))))
        desk.strip, desk.panels = "match", True  # its panel gives it to the brush
        desk.match.awaited = "grain" if way == "paper" else "ink", name
    desk.say(f"Paint with “{path.stem}”")


@dataclass(frozen=True, slots=True)
class _Straighten(FileWork):
    path: Path
    way: str

    def carry_out(self) -> Path:
        from engine.files.atomic import replacing  # here: they take their time to load
        from engine.files.png_writer import write_png
        from engine.makers.doctor.flattening import evened, gradients
        from engine.makers.doctor.trying import rgba_of
        from engine.makers.heeger_bergen import part_looked_at
        from engine.numeric.colour import to_rgba16
        from engine.painting.capture import read_picture

        given = part_looked_at(read_picture(str(self.path), None))
        planes = rgba_of(evened(given, gradients(given)))
        pixels = to_rgba16(planes)
        digest = hashlib.sha256(pixels.tobytes()).hexdigest()[
            :12
        ]  # a folder, so that the texture is called as the file
        path = platformdirs.user_data_path("inkfall") / "straightened" / digest / f"{self.path.stem}.png"
        path.parent.mkdir(parents=True, exist_ok=True)
        with replacing(path) as file:
            write_png(file, pixels)
        return path

    def arrive(self, desk: Desk, found: Path) -> None:
        _take(desk, found, self.way)
