"""Directions spread evenly, and frames on planes across them."""

import numpy as np
import pytest

from engine.numeric.directions import frame, frames


@pytest.mark.parametrize("seed", range(5))
def test_frames_are_orthonormal(seed):
    found = frames(40, np.random.default_rng(seed).random(3))
    assert np.allclose(found @ found.transpose(0, 2, 1), np.eye(3))


def test_no_direction_is_far_from_all():
    """Nor are two of them close together."""
    normals = frames(128, np.array([0.3, 0.7, 0.1]))[:, 0]
    any_ = np.random.default_rng(0).normal(size=(2000, 3))
    any_ /= np.linalg.norm(any_, axis=1)[:, None]
    nearest = np.arccos(np.clip(np.abs(any_ @ normals.T).max(axis=1), 0.0, 1.0))
    assert nearest.max() < np.radians(13.0)
    apart = np.abs(normals @ normals.T) - np.eye(128)
    assert np.arccos(apart.max()) > np.radians(6.0)


def test_turned_at_random():
    """All axes are as often near a normal."""
    rng = np.random.default_rng(1)
    normals = np.concatenate([frames(5, rng.random(3))[:, 0] for _ in range(400)])
    assert np.allclose((normals**2).mean(axis=0), 1.0 / 3.0, atol=0.02)


def test_rows_and_columns_across_axes_are_those_of_slices():
    for axis in range(3):
        down, across = (k for k in range(3) if k != axis)
        assert np.array_equal(frame(np.eye(3)[axis]), np.eye(3)[[axis, down, across]])
