"""A real window, 1280 x 800, that pans while an example grows, and over the same painting when it has."""

from __future__ import annotations

import json
import subprocess
import tempfile
from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import Any

from bench import Figure, Skipped
from bench.display import NEEDED, available, display, python

BLOCKS = 8
FRAME = 1 / 60  # seconds, as in `panning`
LATE = 0.01  # of all frames, at most
WAKES = 0.006  # seconds by which a loop of 60 turns a second may wake late
SOFTWARE = "llvmpipe"
UNDRAWN = {"LP_NO_RAST": "1"}  # llvmpipe takes all calls but fills no pixels: what a card leaves to the processor
ROWS = {"alone": "pan over what has grown", "growing": "pan while an example grows"}


def measure(small: bool = False) -> Iterator[Figure | Skipped]:
    if not available():
        yield Skipped("pan, frames of the window", f"needs {NEEDED}")
        return
    blocks = 1 if small else BLOCKS
    told = window(blocks)
    yield from _rows(told, "")
    if told["renderer"] == SOFTWARE:
        yield from _rows(window(blocks, UNDRAWN), ", pixels left to a card")


def _rows(told: dict[str, Any], how: str) -> Iterator[Figure]:
    for which, name in ROWS.items():
        times, spent = told[which]["times"], told[which]["spent"]
        late, count = sum(t > FRAME for t in times), len(times)
        middle, far = (1e3 * times[int(part * (count - 1))] for part in (0.5, 0.99))
        note = f"median {middle:.1f} ms, 99 % within {far:.1f} ms, slowest {1e3 * times[-1]:.0f} ms; {told['renderer']}"
        bound = f"all {count} frames"
        yield Figure(f"{name}, frames over 1/60 s{how}", late, "frames", bound, late / count, LATE, note=note)
        taken = sum(spent.values())
        note = f"of the window's thread {1e3 * spent['window']:.1f} ms, of a software renderer's, all together, "
        note += f"{1e3 * spent['renderer']:.1f} ms"
        bound = f"{FRAME * 1e3:.1f} ms"
        yield Figure(f"{name}, processor time{how}", taken * 1e3, "ms", bound, taken / FRAME, 1.0, note=note)
        woken = told[which]["late"]
        late = woken[int(0.99 * (len(woken) - 1))]
        note, bound = f"99th percentile of {len(woken)} turns", f"{WAKES * 1e3:.0f} ms"
        name = f"{name}, a 60 Hz loop beside it, late{how}"
        yield Figure(name, late * 1e3, "ms", bound, late / WAKES, 1.0, note=note)


def window(blocks: int, more: Mapping[str, str] = MappingProxyType({})) -> dict[str, Any]:
    """See `panning`; `more`: variables of its environment."""
    with tempfile.TemporaryDirectory() as folder, display() as environment:
        done = subprocess.run(
            python("-m", "bench.panning", str(blocks)),
            env={**environment, **more, "XDG_CONFIG_HOME": folder, "XDG_DATA_HOME": folder},
            capture_output=True,
            text=True,
        )
    if done.returncode != 0:
        raise OSError(f"the window that pans: {(done.stderr.strip().splitlines() or ['ended'])[-1]}")
    return json.loads(done.stdout.splitlines()[-1])
