"""Tables of fixed size, made by functions of our own in both arithmetics: they are what the C library made of them."""

import hashlib

import numpy as np

from engine.numeric.neighbourhood import weights
from engine.numeric.shaping import table
from engine.texture.rock import octave_variance


def test_tables_are_as_ever():
    digest = hashlib.sha256()
    for made in (table("bands"), table("double", "edge"), *(weights(side) for side in (3, 5, 7))):
        digest.update(made.tobytes())
    digest.update(np.array([octave_variance(age) for age in range(14)]).tobytes())
    assert digest.hexdigest()[:24] == "b9d5647cbd3f5498e23d119a"
