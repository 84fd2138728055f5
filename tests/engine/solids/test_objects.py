"""Objects: closed, seen from outside, with normals that point away, of one size."""

import numpy as np
import pytest

from engine.solids.isosurface import zero_surface
from engine.solids.mesh import face_normals, meshed, open_edges, unit_sized, volume
from engine.solids.objects import OBJECTS, object_named
from engine.solids.teapot import patches

# Handle and spout of the teapot are open where they are within the pot, and the spout is at its mouth.
OPEN = {"teapot": 112}


@pytest.mark.parametrize("name", OBJECTS)
def test_an_object_is_closed_and_looks_outwards(name):
    mesh = object_named(name)
    assert open_edges(mesh) == OPEN.get(name, 0)
    assert 0.3 < volume(mesh) < 8.0
    assert np.ptp(mesh.points, axis=0).max() == pytest.approx(2.0)
    assert np.abs(mesh.points.max(axis=0) + mesh.points.min(axis=0)).max() < 1e-9
    assert np.abs((mesh.normals**2).sum(axis=1) - 1.0).max() < 1e-9
    turned = (face_normals(mesh.points, mesh.faces)[:, None] * mesh.normals[mesh.faces]).sum(axis=-1)
    assert (turned > 0.0).all()


def test_the_normals_of_a_ball_are_its_radii_at_poles_and_seam_too():
    mesh = object_named("sphere")
    assert (mesh.normals * mesh.points).sum(axis=1).min() > 0.999999
    assert volume(mesh) == pytest.approx(4.0 / 3.0 * np.pi, rel=2e-3)


def test_sharp_edges_stay_sharp_and_soft_ones_smooth():
    box = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
    squares = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    faces = np.array([corner for a, b, c, d in squares for corner in ((a, b, c), (a, c, d))])
    sharp = meshed(box, faces)
    assert volume(sharp) == pytest.approx(1.0)
    assert len(sharp.points) == 24
    assert np.abs(sharp.normals).max(axis=1).min() > 1.0 - 1e-9
    assert len(meshed(box, faces, 100.0).points) == 8
    low = unit_sized(box * 7.0 + 3.0)
    assert (low.min(), low.max()) == (-1.0, 1.0)


def test_the_teapot_is_newells():
    """32 patches that share their edges: 290 control points by place; the handle meets the body at (-2, 0, 0.9)."""
    found = patches()
    assert len(found) == 32
    points = {tuple(np.round(point, 5) + 0.0) for patch in found for point in patch.reshape(-1, 3)}
    assert {(1.4, -0.784, 2.4), (-2.0, 0.0, 0.9), (3.525, 0.25, 2.49375), (0.0, 0.0, 3.15)} <= points


@pytest.mark.parametrize("middle", [(8.2, 7.9, 8.4), (7.5, 8.0, 8.25)])
def test_the_surface_of_a_ball_is_found_where_it_is(middle):
    z, y, x = np.mgrid[0:18, 0:18, 0:18].astype(float)
    far = np.sqrt((x - middle[0]) ** 2 + (y - middle[1]) ** 2 + (z - middle[2]) ** 2)
    points, faces = zero_surface(far - 6.0)
    mesh = meshed(points, faces)
    assert open_edges(mesh) == 0
    assert volume(mesh) == pytest.approx(4.0 / 3.0 * np.pi * 6.0**3, rel=0.05)
    assert np.abs(np.sqrt(((points - middle) ** 2).sum(axis=1)) - 6.0).max() < 0.15
