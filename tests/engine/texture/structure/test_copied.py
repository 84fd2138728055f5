"""How much is copied: all of a copy, nothing of noise, half where half is."""

import numpy as np
import pytest

from engine.texture.structure.copied import copied_share


def noise(seed, size=(60, 80)):
    return np.random.default_rng(seed).random((3, *size)).astype(np.float32)


def test_what_is_copied_is_counted():
    example = noise(0)
    assert copied_share(example, example[:, 5:50, 10:70]) == 1.0
    assert copied_share(example, noise(1)) == 0.0
    half = np.concatenate([example[:, :40], noise(2)[:, :40]], axis=1)
    assert copied_share(example, half) == pytest.approx(34 / 74, abs=0.06)


def test_what_has_no_patches_has_no_copies():
    assert copied_share(noise(0)[:, :3], noise(1)) == 0.0
    assert copied_share(np.full((1, 20, 20), 0.5, np.float32), noise(1)) == 0.0
