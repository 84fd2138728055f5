"""Pictures between their rows."""

import numpy as np

from engine.numeric.resample import rows_at


def test_rows_between_rows():
    x = np.random.default_rng(1).random((2, 9, 4), np.float32)
    assert np.array_equal(rows_at(x, np.arange(9.0)), x)
    ramp = np.broadcast_to(np.arange(9.0, dtype=np.float32)[None, :, None], (1, 9, 3))
    places = np.array([1.0, 1.25, 3.5, 6.75])
    assert np.abs(rows_at(ramp, places)[0, :, 0] - places).max() < 1e-5
    assert rows_at(x[:, :1], np.array([0.0])).shape == (2, 1, 4)
    assert np.abs(rows_at(np.full((1, 3, 2), 0.5, np.float32), np.array([0.0, 1.4, 2.0])) - 0.5).max() < 1e-6
