"""Work in parts: everything is done once, whatever the cores, parts in parts too, and faults are told."""

import threading

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.numeric import in_parts as module
from engine.numeric.in_parts import in_parts
from engine.numeric.matrices import combinations, products
from engine.numeric.real_fourier import irfft2, rfft2

MANY = 1 << 40  # values: as many parts as there may be


@settings(max_examples=40, deadline=None)
@given(count=st.integers(1, 100), step=st.integers(1, 16), cores=st.integers(1, 6))
def test_every_number_is_done_once(count, step, cores):
    done, lock, firsts = np.zeros(count, int), threading.Lock(), []

    def work(first, last):
        with lock:
            done[first:last] += 1
            firsts.append(first)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module.os, "cpu_count", lambda: cores)
        in_parts(work, count, MANY, step)
    assert (done == 1).all()
    assert all(first % step == 0 for first in firsts)


def test_parts_in_parts_do_not_wait_for_one_another(monkeypatch):
    monkeypatch.setattr(module.os, "cpu_count", lambda: 4)
    done = np.zeros((8, 8), int)

    def row(first, last):
        for y in range(first, last):
            in_parts(lambda a, b, y=y: done[y, a:b].__iadd__(1), 8, MANY)

    in_parts(row, 8, MANY)
    assert (done == 1).all()


@pytest.mark.parametrize("bad", [0, 5])
def test_a_fault_in_any_part_is_raised(monkeypatch, bad):
    monkeypatch.setattr(module.os, "cpu_count", lambda: 3)

    def work(first, last):
        if first <= bad < last:
            raise ValueError(f"in {bad}")

    with pytest.raises(ValueError, match=f"in {bad}"):
        in_parts(work, 6, MANY)


def test_what_is_cut_in_parts_keeps_its_bits(monkeypatch):
    rng = np.random.default_rng(1)
    rows, factors = rng.standard_normal((13, 3001), np.float32), rng.standard_normal((6, 13), np.float32)
    pictures = rng.standard_normal((5, 30, 42), np.float32)

    def made():
        half = rfft2(pictures)
        return products(rows, rows), products(factors @ rows, rows), combinations(factors, rows), irfft2(half, (30, 42))

    monkeypatch.setattr(module, "_LEAST", 1)
    found = []
    for cores in (1, 2, 3):
        monkeypatch.setattr(module.os, "cpu_count", lambda cores=cores: cores)
        found.append([part.tobytes() for part in made()])
    assert found[0] == found[1] == found[2]
