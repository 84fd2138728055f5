"""Meshes of heights: their promised error is one, they fit together, and a body is closed."""

import numpy as np
import pytest
import trimesh

from engine.terrain.right_triangles import closed_block, count_of, errors_of, mesh_of_at_most, mesh_within


def rough(rows, columns, seed=3):
    """Heights whose neighbours differ by a pixel or so."""
    random = np.random.default_rng(seed)
    return np.cumsum(random.normal(0, 0.5, (rows, columns)), axis=1).astype(np.float32)


def error_of(mesh, heights):
    """The worst distance of the mesh, rasterised, to a sample; every sample must lie in a triangle."""
    worst, met = 0.0, np.zeros(heights.shape, bool)
    z = heights[mesh.places[:, 1], mesh.places[:, 0]].astype(float)
    for face in mesh.faces:
        (ax, ay), (bx, by), (cx, cy) = mesh.places[face]
        x, y = np.meshgrid(
            np.arange(min(ax, bx, cx), max(ax, bx, cx) + 1), np.arange(min(ay, by, cy), max(ay, by, cy) + 1)
        )
        area = (by - cy) * (ax - cx) + (cx - bx) * (ay - cy)
        u = ((by - cy) * (x - cx) + (cx - bx) * (y - cy)) / area
        v = ((cy - ay) * (x - cx) + (ax - cx) * (y - cy)) / area
        inside = (u >= 0) & (v >= 0) & (u + v <= 1)
        x, y, u, v = (part[inside] for part in (x, y, u, v))
        seen = u * z[face[0]] + v * z[face[1]] + (1 - u - v) * z[face[2]]
        worst = max(worst, float(np.abs(seen - heights[y, x]).max()))
        met[y, x] = True
    assert met.all()
    return worst


@pytest.mark.parametrize("tolerance", [0.5, 2.0, 6.0])
@pytest.mark.parametrize("size", [(33, 33), (20, 47)])
def test_no_sample_is_farther_than_the_tolerance(size, tolerance):
    heights = rough(*size)
    mesh = mesh_within(errors_of(heights), tolerance)
    assert len(mesh.faces) < 2 * (size[0] - 1) * (size[1] - 1)
    assert error_of(mesh, heights) <= tolerance * (1 + 1e-6)


def test_the_usual_measure_would_not_keep_it():
    """The bound is no smaller than each step, and larger than the worst step of its chain."""
    heights = rough(65, 65)
    whole = mesh_within(errors_of(heights), errors_of(heights).worst())
    assert len(whole.faces) == 2
    assert error_of(whole, heights) <= errors_of(heights).worst()


def test_faces_look_up_and_cover_the_rectangle_once():
    heights = rough(20, 47)
    mesh = mesh_within(errors_of(heights), 3.0)
    places = np.c_[mesh.places[:, 0], -mesh.places[:, 1], np.zeros(len(mesh.places))]
    corners = places[mesh.faces]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2] / 2
    assert (areas > 0).all()
    assert areas.sum() == 19 * 46


@pytest.mark.parametrize("size", [(2, 2), (33, 33), (20, 47), (2, 30)])
@pytest.mark.parametrize("tolerance", [0.0, 2.0, 1e9])
def test_a_block_is_closed(size, tolerance):
    heights = rough(*size)
    bounds = errors_of(heights)
    mesh = mesh_within(bounds, tolerance)
    x, y = mesh.places.T
    place = np.c_[x, -y, heights[y, x]].astype(float)
    vertices, faces = closed_block(mesh, place, (bounds.columns, bounds.rows), heights.min() - 4.0)
    body = trimesh.Trimesh(vertices, faces, process=False)
    assert body.is_watertight
    assert body.is_winding_consistent
    assert body.volume > 4.0 * (size[0] - 1) * (size[1] - 1)
    assert body.body_count == 1
    assert len(faces) == count_of(mesh, bounds, closed=True)


def test_as_fine_as_a_number_of_triangles_lets_it():
    heights = rough(65, 65)
    bounds = errors_of(heights)
    mesh, tolerance = mesh_of_at_most(bounds, 900, closed=False)
    assert 600 < len(mesh.faces) <= 900
    assert error_of(mesh, heights) <= tolerance * (1 + 1e-6)
    whole, none = mesh_of_at_most(bounds, 10**6, closed=True)
    assert (len(whole.faces), none) == (2 * 64 * 64, 0.0)
    with pytest.raises(ValueError, match="expected at least 14"):
        mesh_of_at_most(bounds, 13, closed=True)
