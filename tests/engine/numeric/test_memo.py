"""What functions made is kept while nobody wants its room."""

import numpy as np
import pytest

from engine.numeric import memo as module
from engine.numeric.recent import Recent
from engine.session.coding.made_again import forget_made, made_held
from engine.texture.image import Cover, Image, ImageSource


@pytest.fixture(autouse=True)
def own(monkeypatch):
    """Nothing is kept yet, and of that 100 kB stay."""
    kept = Recent(lambda: 1 << 20, 100 << 10)
    monkeypatch.setattr(module, "REMEMBERED", kept)
    monkeypatch.setattr("engine.session.coding.made_again._HOLDERS", (kept,))
    return kept


def counted(made):
    calls = []

    @module.remembered
    def make(*args, **named):
        calls.append((args, named))
        return made

    return make, calls


def test_the_same_is_made_once_until_its_room_is_wanted(own):
    make, calls = counted((np.zeros(50 << 10, np.uint8), [np.zeros(60 << 10, np.uint8)]))
    assert all(make(n, told="a") is make(n, told="a") for n in range(4))
    assert len(calls) == 4
    assert made_held() == own.held > 4 * (110 << 10)
    forget_made(1)
    make(0, told="a")
    assert len(calls) == 5
    forget_made(1 << 30)
    make(0, told="a")
    assert len(calls) == 5  # the newest stays: it is asked for next
    make(1, told="a")
    assert len(calls) == 6


def test_what_is_nothing_is_made_once_too():
    make, calls = counted(None)
    assert make(1) is None
    assert make(1) is None
    assert len(calls) == 1


def test_a_part_counts_as_the_array_that_it_keeps_and_a_shared_one_once():
    whole = np.zeros((10, 1000))
    assert module.bytes_of((whole[1], whole[2:4], {"a": whole}, b"1234")) == whole.nbytes + 4


def test_a_picture_is_known_by_its_name_and_hash_and_not_kept(own):
    make, calls = counted(0)
    data = np.full((4, 200, 200), 0.3, np.float32)
    first, second = (ImageSource.of("a", data + np.float32(0.0)) for _ in range(2))
    make(first)
    make(second)
    make(ImageSource("a", first.sha))  # of which only the name is there
    assert len(calls) == 2
    make(Image(0, 8, first))
    make(Image(0, 8, second))
    make(Cover(0, 8, second))
    assert len(calls) == 4
    assert own.held < 3000
