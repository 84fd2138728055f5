"""What is allocated next comes in large pages, until that is forgone."""

import subprocess
import sys
from pathlib import Path

import pytest

LARGE = Path("/sys/kernel/mm/transparent_hugepage/enabled")
SCRIPT = """
import numpy as np
import engine
from engine.keeping import large_pages, memory

def told_large(array):
    at, inside = array.__array_interface__["data"][0] + array.nbytes // 2, False
    for line in open("/proc/self/smaps"):
        bounds = line.split()[0].split("-")
        if len(bounds) == 2:
            inside = int(bounds[0], 16) <= at < int(bounds[1], 16)
        elif inside and line.startswith("VmFlags"):
            return "hg" in line.split()
    raise AssertionError("the array is nowhere")

large_pages.ask_ahead(64 << 20)
held = [np.ones(1 << 16, np.float32) for _ in range(100)]
assert all(map(told_large, held))
large_pages.ask_ahead(65 << 20)
assert len(large_pages._ASKED.pieces) == 2
large_pages.ask_ahead(96 << 20)
assert len(large_pages._ASKED.pieces) == 4
large_pages.forgo()
assert not any(map(told_large, held))
assert all((array == 1.0).all() for array in held)
"""


@pytest.mark.skipif(not LARGE.exists(), reason="the system has no large pages")
def test_what_is_allocated_next_comes_in_large_pages_until_that_is_forgone():
    subprocess.run([sys.executable, "-c", SCRIPT], check=True)
