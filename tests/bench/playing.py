"""A recording of the gallery replayed, against its commands applied one after the other: what a session adds to them.

Processor time of all threads; in turns, the best of some.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from bench import Figure
from bench.clock import processor
from bench.display import ROOT
from engine.canvas.tile_cache import TileCache
from engine.painting.recording import Recording, read
from engine.session.apply import apply
from engine.session.replay import opened, replay

RECORDING = ROOT / "palettes" / "gallery" / "orange.jsonl"
REPEATS = 4
CACHE = 256 << 20  # bytes of evaluated tiles, for both


def measure(small: bool = False) -> Iterator[Figure]:
    recording = read(RECORDING)
    if small:
        recording = replace(recording, commands=recording.commands[:12])
    _chain(recording)  # kernels and textures are loaded
    pairs = [
        (processor(lambda: replay(recording, TileCache(CACHE))), processor(lambda: _chain(recording)))
        for _ in range(1 if small else REPEATS)
    ]
    played, applied = (min(times) for times in zip(*pairs, strict=True))
    name, bound = f"{RECORDING.stem} replayed", f"its {len(recording.commands)} commands applied"
    note = f"applied they take {applied:.2f} s of the processor"
    yield Figure(name, played, "s", bound, played / applied, 1.3, note=note)


def _chain(recording: Recording) -> None:
    session = opened(recording, TileCache(CACHE))
    painting = session.painting
    for command in recording.commands:
        painting = apply(painting, command, session.around())
