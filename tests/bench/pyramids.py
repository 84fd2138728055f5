"""A Zarr pyramid of painted strokes by a Dask cluster of two processes, against one process with a thread a core."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from bench import Figure, Skipped
from bench.clock import seconds
from engine.archive.export import Picture
from engine.archive.ladder.ladder_files import FOLDERS, ladder_of, write_folder
from engine.archive.saving import Snapshot, save
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.session.apply import Painting
from engine.session.session import Session

REPEATS = 2
FRAME = Rect(0, 0, 1000, 1000)
_LEVEL = 3


def measure(small: bool = False) -> Iterator[Figure | Skipped]:
    name = "pyramid, by two processes"
    try:
        from engine.archive.ladder.cluster import LOCAL, connected, write_on_cluster
    except ImportError:
        yield Skipped(name, "needs pip install inkfall[cluster]")
        return
    painting = _painted(4 if small else 40)
    picture = Picture(painting, 0 if small else _LEVEL)
    with tempfile.TemporaryDirectory() as folder, connected(folder, LOCAL) as client:
        file, out = Path(folder) / "a.ora", Path(folder) / "a.zarr"
        save(file, Snapshot(painting))
        data, address = file.read_bytes(), client.scheduler.address

        def processes() -> float:
            """Seconds of the processor's time that all of them have taken so far."""
            return time.process_time() + sum(client.run(time.process_time).values())

        taken: dict[str, list[tuple[float, float]]] = {"threads": [], "processes": []}
        for _ in range(1 if small else 1 + REPEATS):  # the first compiles
            for key, work in (
                ("threads", lambda: write_folder(out, picture)),
                ("processes", lambda: write_on_cluster(out, picture, data, address)),
            ):
                before = processes()
                wall = seconds(work)
                taken[key].append((wall, processes() - before))
        pixels = ladder_of(out, picture, FOLDERS[".zarr"]).pixels
        told = sum(path.stat().st_size for path in out.rglob("*") if path.is_file())
    note = f"{pixels / 1e6:.0f} Mpx in all levels, {told / pixels:.2f} bytes each; opening the painting included"
    for n, (what, limit) in enumerate((("", 1.25), (", processor", 1.5))):
        threads, many = (min(times[n] for times in taken[key]) for key in ("threads", "processes"))
        yield Figure(name + what, many, "s", "one process, a thread a core", many / threads, limit, note=note)


def _painted(count: int) -> Painting:
    """Three layers of rock, opened in a moment: what is measured is the writing."""
    session = Session(Painting(FRAME, 3), TileCache(64 << 20))
    rng = np.random.default_rng(0)
    for layer in range(3):
        session.do(parse({"do": "layer", "add": str(layer)}))
        ink = [{"texture": "rock", "amount": 0.5, "colour": "#e0d0b0", "period": 60 << layer}]
        for _ in range(count):
            colour = f"#{int(rng.integers(1 << 24)):06x}"
            brush = {"radius": 30, "hardness": 0.5, "colour": colour, "ink": ink}
            points = (rng.random((4, 2)) * FRAME.width).round(1).tolist()
            session.do(parse({"do": "stroke", "points": points, "brush": brush}))
    return session.painting
