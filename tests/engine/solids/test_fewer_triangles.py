"""A mesh with fewer triangles, between points of its own: it looks like the whole from any side."""

import numpy as np
import pytest

from engine.solids.depth import draw_triangles
from engine.solids.fewer_triangles import fewer_triangles
from engine.solids.objects import object_named


@pytest.mark.parametrize(("name", "most"), [("knot", 8000), ("teapot", 4000)])
def test_fewer_triangles_cover_the_same(name, most):
    mesh = object_named(name)
    fewer = fewer_triangles(mesh, most)
    assert 0.4 * most < len(fewer) <= most
    assert np.array_equal(fewer_triangles(mesh, len(mesh.faces)), mesh.faces)
    for axis in range(3):
        seen = []
        for faces in (mesh.faces, fewer):
            nearest, names = np.zeros((100, 100), np.float32), np.full((100, 100), -1, np.int32)
            corners = np.roll(mesh.points, axis, axis=1) * (45.0, 45.0, 1.0) + (50.0, 50.0, 3.0)
            draw_triangles(np.ascontiguousarray(corners), faces, 0, nearest, names, 0)
            seen.append(nearest)
        far = np.abs(seen[0] - seen[1]) > 0.1
        assert far.mean() < 0.03


def test_a_crowd_of_points_in_one_place_is_no_endless_work():
    mesh = object_named("knot")
    assert len(fewer_triangles(mesh, 1)) <= 1
