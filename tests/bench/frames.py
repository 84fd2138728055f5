"""A real window, 1280 x 800, that pans while an example grows, and over the same painting when it has; and one that is
painted in, with the journal and without."""

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
STROKES = 12  # with the journal, and as many without
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
    yield from journalled(1 if small else STROKES)


def journalled(strokes: int) -> Iterator[Figure]:
    """What the journal costs a frame while one paints: the two are measured stroke by stroke in turns."""
    with tempfile.TemporaryDirectory() as folder:
        told = _window("bench.journalled", str(strokes), f"{folder}/paintings", folder=folder)
    frames, spent = ({name: sorted(frame[n] for frame in told[name]) for name in ("with", "without")} for n in range(2))
    late = {name: sum(taken > FRAME for taken in times) for name, times in frames.items()}
    count = len(frames["with"])
    note = f"of {count} frames each, {late['with']} and {late['without']} over 1/60 s; 99 % within "
    note += " and ".join(f"{1e3 * times[int(0.99 * (count - 1))]:.1f} ms" for times in frames.values())
    note += f"; {told['journal'] >> 10} KiB of journal"
    for name, values, unit in (("later", frames, "seen"), ("longer", spent, "processor time")):
        kept, without = (values[which][count // 2] for which in ("with", "without"))
        bound = f"{1e3 * without:.2f} ms without it"
        row = f"a frame with the journal, {name} ({unit})"
        yield Figure(row, 1e3 * kept, "ms", bound, kept / without, 1.1, note=note if values is frames else "median")


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
    with tempfile.TemporaryDirectory() as folder:
        return _window("bench.panning", str(blocks), folder=folder, more=more)


def _window(module: str, *words: str, folder: str, more: Mapping[str, str] = MappingProxyType({})) -> dict[str, Any]:
    """Returns what a module tells that opens the window; `folder`: of its settings."""
    with display() as environment:
        done = subprocess.run(
            python("-m", module, *words),
            env={**environment, **more, "XDG_CONFIG_HOME": folder, "XDG_DATA_HOME": folder},
            capture_output=True,
            text=True,
        )
    if done.returncode != 0:
        raise OSError(f"the window of {module}: {(done.stderr.strip().splitlines() or ['ended'])[-1]}")
    return json.loads(done.stdout.splitlines()[-1])
