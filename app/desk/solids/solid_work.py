"""Carving what the panel of solids shows, beside the window's thread."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.desk.desk import Desk, FileWork
from app.desk.solids.solid_state import USUAL_OBJECT, Carved, Made

MOST_TURNING = 24_000  # triangles that are drawn while it turns


@dataclass(frozen=True, slots=True)
class Carve(FileWork):
    """A cube of `side` voxels of a material, and an object, one of ours or the file of a mesh; what `before` has of
    both is kept."""

    made: Made
    name: str
    side: int
    before: Carved | None

    def carry_out(self) -> Carved:
        """Returns both."""
        from engine.solids.fewer_triangles import fewer_triangles
        from engine.solids.mesh_files import read_mesh
        from engine.solids.objects import OBJECTS, object_named
        from engine.solids.solid_lookup import Procedural

        held = self.before
        if held is not None and held.made == self.made and len(held.cube) == self.side:
            cube = held.cube
        else:
            material, seed, values = self.made
            middles = (np.arange(self.side) + 0.5) / self.side
            z, y, x = np.meshgrid(middles, middles, middles, indexing="ij")
            places = np.stack([x, y, z], axis=-1).reshape(-1, 3)
            colours = Procedural(material, seed, dict(values)).colours(places, 1.0 / self.side)
            cube = np.rint(255.0 * np.clip(colours, 0.0, 1.0)).astype(np.uint8).reshape((self.side,) * 3 + (3,))
        if held is not None and held.name == self.name:
            return Carved(self.made, cube, self.name, held.corners, held.faces, held.fewer)
        mesh = object_named(self.name) if self.name in OBJECTS else read_mesh(self.name)
        corners = np.concatenate([mesh.points, mesh.normals], axis=1).astype(np.float32)
        return Carved(self.made, cube, self.name, corners, mesh.faces, fewer_triangles(mesh, MOST_TURNING))

    def arrive(self, desk: Desk, found: Carved) -> None:
        """Shows it."""
        desk.solid.busy, desk.solid.carved = False, found

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells why; the object that was there stays."""
        desk.solid.busy = False
        if self.name == desk.solid.name:
            desk.solid.name = USUAL_OBJECT if self.before is None else self.before.name
        desk.say(fault, bad=True)
