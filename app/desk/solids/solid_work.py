"""Carving what the panel of solids shows, and drawing it as it rests, beside the window's thread."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from app.desk.desk import Desk, FileWork
from app.desk.solids.painted_cube import as_bytes, painted_cube, painted_on, voxel_middles
from app.desk.solids.shown_solid import MAP_SCALE, Aspect, AtRest, Carved, Made, is_wrapped
from app.desk.solids.solid_state import LAST_SIDE, USUAL_MATERIAL, USUAL_OBJECT
from app.desk.solids.working import for_a_while
from engine.solids.material_sliders import MATERIALS

if TYPE_CHECKING:
    from engine.painting.layering.touch_command import Touch
    from engine.solids.solid_lookup import Lookup

BEHIND = 0.115, 0.12, 0.125  # behind the object
_SAMPLES = 1, 3  # a pixel each way, of the first picture at rest and the last
MOST_TURNING = 24_000  # triangles that are drawn while it turns


@dataclass(frozen=True, slots=True)
class Carve(FileWork):
    """A cube of `side` voxels of a material, with `touches` painted on it, and an object, one of ours or the file of a
    mesh; what `before` has of all that is kept."""

    made: Made
    name: str
    side: int
    before: Carved | None
    touches: tuple[Touch, ...] = ()

    def carry_out(self) -> Carved:
        """Returns both."""
        from engine.solids.fewer_triangles import fewer_triangles
        from engine.solids.mesh_files import read_mesh
        from engine.solids.objects import OBJECTS, object_named

        held = self.before
        if held is not None and held.made == self.made and (held.whole or len(held.cube) == self.side):
            solid, plain, whole = held.solid, held.plain, held.whole
        else:
            solid, plain, whole = self._carved()
        solid = painted_on(solid, self.touches)
        cube = painted_cube(solid, plain, self.touches, held)
        if held is not None and held.name == self.name:
            return replace(held, made=self.made, solid=solid, plain=plain, touches=self.touches, cube=cube, whole=whole)
        mesh = object_named(self.name) if self.name in OBJECTS else read_mesh(self.name)
        corners = np.concatenate([mesh.points, mesh.normals], axis=1).astype(np.float32)
        fewer = fewer_triangles(mesh, MOST_TURNING)
        return Carved(self.made, solid, plain, self.touches, cube, whole, self.name, corners, mesh.faces, fewer)

    def _carved(self) -> tuple[Lookup, np.ndarray, bool]:
        """The solid, its voxels, and whether there are no finer ones."""
        from engine.solids.cube_files import read_cube
        from engine.solids.solid_lookup import Cubed, Procedural

        material, seed, values = self.made
        if is_wrapped(self.made):
            return self._coloured(_wrapped(self.made))
        if material not in MATERIALS:
            voxels = read_cube(material)
            return Cubed(voxels, seed=seed), np.rint(255.0 * voxels).astype(np.uint8), True
        return self._coloured(Procedural(material, seed, dict(values)))

    def _coloured(self, solid: Lookup) -> tuple[Lookup, np.ndarray, bool]:
        places = voxel_middles((self.side,) * 3)
        cube = as_bytes(solid.colours(places, 1.0 / self.side)).reshape((self.side,) * 3 + (3,))
        return solid, cube, self.side >= LAST_SIDE

    def arrive(self, desk: Desk, found: Carved) -> None:
        """Shows it."""
        desk.solid.busy, desk.solid.carved = False, found

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells why; the object that was there stays."""
        desk.solid.busy = False
        held = self.before
        if self.name == desk.solid.name:
            desk.solid.name = USUAL_OBJECT if held is None else held.name
        if self.made[0] == desk.solid.material and self.made[0] not in MATERIALS:
            before = USUAL_MATERIAL if held is None else held.made[0]
            desk.solid.material = USUAL_MATERIAL if before == self.made[0] else before
            desk.solid.cubes = None  # the file may be gone
        desk.say(fault, bad=True)


def _wrapped(made: Made) -> Lookup:
    """Returns a picture that goes around an object."""
    from engine.makers.lewis import flattened
    from engine.painting.capture import read_picture
    from engine.solids.object_map import ObjectMap

    path, _, ((name, often),) = made
    return ObjectMap.of(flattened(read_picture(path, None)), name, MAP_SCALE, often)


def pictures_at_rest(seen: Aspect) -> Iterator[AtRest | None]:
    """Yields the object in the studio's light with all that its solid has of detail, a rough picture first, then a
    smooth one; None while one is being made."""
    from engine.solids.mesh import Mesh
    from engine.solids.solid_rendering import Body, afloat, turning

    corners = seen.carved.corners.astype(np.float64)
    mesh = Mesh(corners[:, :3], corners[:, 3:], seen.carved.faces)
    scene = afloat(Body(mesh, seen.carved.solid, turning(*seen.turn), scale=seen.scale), seen.carved.nearness, BEHIND)
    yield None
    for samples in _SAMPLES:
        bands = []
        for _, rows in scene.bands(seen.room, samples):
            bands.append(rows)
            yield None
        yield AtRest(seen, np.concatenate(bands))


@dataclass(frozen=True, slots=True, eq=False)
class Rest(FileWork):
    """Draws what rests, a while at a time; it ends as soon as that is turned."""

    of: Aspect
    steps: Iterator[AtRest | None]

    def carry_out(self) -> tuple[AtRest | None, bool]:
        """Returns a picture that is done, and whether there are more to come."""
        return for_a_while(self.steps)

    def arrive(self, desk: Desk, found: tuple[AtRest | None, bool]) -> None:
        """Shows it and goes on, if that is seen still."""
        state, (rest, more) = desk.solid, found
        wanted = state.seen == self.of and desk.strip == "solid"
        if wanted and rest is not None:
            state.rest = rest
        if wanted and more:
            desk.work(self)
        else:
            state.resting = None

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells why; the card's picture stays."""
        desk.say(fault, bad=True)
