"""What commits leave of finer detail: the same packed, and small where it only waits in the history."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from strokes import fill

from engine.canvas.commit import commit
from engine.canvas.evaluate import evaluate
from engine.canvas.rising.lasting import Lasting
from engine.canvas.store import Pyramid
from engine.numeric.address import Rect


@given(st.integers(1, 40), st.integers(1, 40), st.integers(0, 1 << 32))
def test_packed_values_are_the_same_bit_for_bit(height, width, seed):
    data = np.random.default_rng(seed).integers(0, 1 << 32, (height, width), np.uint32).view(np.float32)
    kept = Lasting(Rect.at(-5, 7, width, height), data)
    kept.pack()
    kept.pack()
    assert kept.data.view(np.uint32).tolist() == data.view(np.uint32).tolist()


def test_what_was_applied_takes_few_bytes_and_old_states_look_as_they_did():
    pyramid = commit(Pyramid(), fill(4, 0, 0, 60, 60))
    view, states = Rect(-10, -10, 80, 80), []
    for n in range(36):
        pyramid = commit(pyramid, fill(2, n % 5, n % 3, 12, 9, alpha=0.25))
        states.append((pyramid, evaluate(pyramid, 4, view).data))
    old, seen = states[2]
    first = list(old.waiting())[-1]
    assert first not in pyramid.waiting()
    assert [kept.rect for kept in first.keep.values()] == [Rect(0, 0, 12, 9)]
    newest = next(pyramid.waiting())
    assert first.nbytes < newest.nbytes - 200
    assert np.array_equal(evaluate(old, 4, view).data, seen)
