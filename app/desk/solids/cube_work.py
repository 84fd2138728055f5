"""Cubes of one's own: grown from a picture or brought from a file, and kept as pictures of their slices."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import platformdirs

from app.desk.desk import Desk, FileWork
from app.desk.presets import stem_of
from app.desk.solids.solid_state import Growth
from app.desk.solids.working import for_a_while

DRAWABLE = (".png", ".jpg", ".jpeg", ".tif", ".tiff")
CUBES = (*DRAWABLE, ".npy")
_ENDING, _SLICE = ".png", "slice-"


def own_cubes() -> Path:
    """Tells where cubes are kept."""
    return platformdirs.user_data_path("inkfall") / "solids"


@dataclass(frozen=True, slots=True)
class ListCubes(FileWork):
    """Looks which cubes are kept."""

    def carry_out(self) -> tuple[str, ...]:
        """Returns their paths, by name."""
        folder = own_cubes()
        return tuple(sorted(map(str, folder.glob(f"*{_ENDING}")))) if folder.is_dir() else ()

    def arrive(self, desk: Desk, found: tuple[str, ...]) -> None:
        """Lists them."""
        desk.solid.cubes = found

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells why; none is listed."""
        desk.solid.cubes = ()
        desk.say(fault, bad=True)


@dataclass(frozen=True, slots=True, eq=False)
class GrowCube(FileWork):
    """Grows a cube from a picture, or reads it, and keeps it, a while at a time."""

    path: Path
    growth: Growth
    steps: Iterator[Path | None] = field(repr=False)

    def carry_out(self) -> tuple[Path | None, bool]:
        """Returns the picture of the cube once that is kept."""
        return for_a_while(self.steps)

    def arrive(self, desk: Desk, found: tuple[Path | None, bool]) -> None:
        """Shows the cube, or goes on if that is still wanted."""
        kept, more = found
        state = desk.solid
        if kept is None and more and state.growing is self.growth:
            desk.work(self)
            return
        if state.growing is self.growth:
            state.growing = None
        if kept is not None:
            state.material = str(kept)
            desk.work(ListCubes())
            desk.say(f"Kept the solid “{kept.stem}”")

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells why there is none."""
        if desk.solid.growing is self.growth:
            desk.solid.growing = None
        desk.say(fault, bad=True)


def bring_cube(desk: Desk, path: Path, drawn: bool = False) -> None:
    """A cube that a file holds, or one that grows from a picture, becomes the solid; `drawn`: or is drawn out of it."""
    growth = Growth()
    desk.solid.growing = growth
    desk.work(GrowCube(path, growth, _steps(path, growth, drawn)))


def _steps(path: Path, growth: Growth, drawn: bool) -> Iterator[Path | None]:
    """Yields None while it is being made; then where it is kept."""
    from engine.makers.heeger_bergen import part_looked_at
    from engine.makers.lewis import flattened
    from engine.painting.capture import read_picture
    from engine.solids.cube_files import is_column, read_cube, write_cube
    from engine.solids.cube_growing import as_fine_as_voxels, drawn_cube, growing_cube

    cube = None
    if path.suffix.lower() == ".npy" or (path.name.startswith(_SLICE) and path.suffix.lower() == _ENDING):
        cube = read_cube(str(path if path.suffix.lower() == ".npy" else path.parent))
    elif is_column(str(path)):
        cube = read_cube(str(path))
    else:
        example = part_looked_at(as_fine_as_voxels(flattened(read_picture(str(path), None))))
        yield None
        for step in (drawn_cube if drawn else growing_cube)(example, 0):
            growth.done, cube = step
            yield None
    assert cube is not None
    folder = own_cubes()
    folder.mkdir(parents=True, exist_ok=True)
    kept = _free(folder, path.parent.name if path.name.startswith(_SLICE) else path.stem)
    write_cube(kept, cube)
    yield kept


def _free(folder: Path, name: str) -> Path:
    """A path that no cube has yet."""
    stem, number = stem_of(name), 1
    found = folder / f"{stem}{_ENDING}"
    while found.exists():
        number += 1
        found = folder / f"{stem}-{number}{_ENDING}"
    return found
