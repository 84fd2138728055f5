"""What the compiled kernels cost to compile, in seconds of a processor: for the first dab of the plain brush, and for
all brushes.

`PYTHONPATH=.:tests python -m bench.compiling` prints every kernel, in the order of compiling, with nothing cached.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from bench import Figure
from bench.display import children

if TYPE_CHECKING:
    from app.desk.presets import Preset

PLAIN = ("first dab", "commit", "view")  # stages of the plain brush
BRUSHES = (*PLAIN, "rock", "smooth", "erase", "brushes")
PATIENCE = 600.0  # seconds


@dataclass(frozen=True, slots=True)
class Compiled:
    """One kernel compiled for one signature: `own` seconds of the thread's processor time, without those of the kernels
    that it calls and that were compiled on the way."""

    stage: str
    kernel: str
    signature: str
    own: float


class Meter:
    """Listens to numba's compiler on one thread."""

    def __init__(self) -> None:
        self.stage = ""
        self.compiled: list[Compiled] = []
        self._began: list[list[float]] = []  # of those being compiled: when, and how long inner ones took

    def on_start(self, event: object) -> None:
        self._began.append([time.thread_time(), 0.0])

    def on_end(self, event: object) -> None:
        start, inner = self._began.pop()
        taken = time.thread_time() - start
        if self._began:
            self._began[-1][1] += taken
        data = event.data  # type: ignore[attr-defined]
        function = data["dispatcher"].py_func
        kernel = f"{function.__module__}.{function.__qualname__}"
        signature = ", ".join(str(kind) for kind in data["args"])
        self.compiled.append(Compiled(self.stage, kernel, signature, taken - inner))


@contextmanager
def metered() -> Iterator[Meter]:
    """Notes what is compiled meanwhile."""
    from numba.core import event

    meter = Meter()

    class Listener(event.Listener):
        on_start, on_end = staticmethod(meter.on_start), staticmethod(meter.on_end)

    with event.install_listener("numba:compile", Listener()):
        yield meter


def measure(small: bool = False) -> Iterator[Figure]:
    stages = PLAIN if small else BRUSHES
    told = fresh(stages)
    plain = sum(row.own for row in told if row.stage in PLAIN)
    every = sum(row.own for row in told)
    empty = fresh(("empty",))[0].own
    bound = f"the {empty * 1e3:.0f} ms of an empty kernel"
    count = sum(row.stage in PLAIN for row in told)
    yield Figure("kernels of the plain brush", plain, "s", bound, plain / empty, 0.0, note=f"{count} kernels")
    if not small:
        yield Figure("kernels of all brushes", every, "s", bound, every / empty, 0.0, note=f"{len(told)} kernels")


def fresh(stages: tuple[str, ...]) -> list[Compiled]:
    """What a new process compiles at each stage when nothing is cached."""
    with tempfile.TemporaryDirectory() as folder:
        environment = {**children(), "NUMBA_CACHE_DIR": folder}
        command = [sys.executable, "-m", "bench.compiling", "--json", *stages]
        done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, timeout=PATIENCE, check=True)
    return [Compiled(**row) for row in json.loads(done.stdout)]


# --- the stages, in a process of their own ---------------------------------------------------------------------------


class Stages:
    """What the window drives, without its thread."""

    def __init__(self) -> None:
        from engine.numeric.address import Rect
        from engine.studio import requests as q
        from engine.studio.studio import Studio

        self.studio = Studio(lambda result: None, lambda request: None)
        self.studio.do(q.New(Rect(0, 0, 512, 512)))
        self.known: dict[str, Callable[[], None]] = {
            "empty": _empty,
            "first dab": self._first_dab,
            "commit": lambda: self.studio.do(q.Finish()),
            "view": self._view,
            "rock": lambda: self._stroke("Rock", ("rock",)),
            "smooth": lambda: self._stroke("Smoother"),
            "erase": lambda: self._stroke("Eraser"),
            "brushes": self._brushes,
            "files": self._files,
            "warming": self._warming,
        }

    def _look(self, level: int = 0) -> None:
        from engine.studio import requests as q

        self.studio.look(q.Look(tuple((level, x, y, -1) for y in (0, 1) for x in (0, 1))))
        while self.studio.step():
            pass

    def _begin(self, brush: object) -> None:
        from engine.studio import requests as q

        self.studio.do(q.Begin(0, (0, 0), brush))  # type: ignore[arg-type]
        points = np.zeros((2, 6))
        points[:, :3] = ((60.0, 60.0, 0.6), (200.0, 90.0, 1.0))
        for row in points:
            self.studio.do(q.Points(row[None]))
            self._look()

    def _first_dab(self) -> None:
        from app.desk.presets import DEFAULT

        self._look()
        self._begin(DEFAULT.brush)

    def _view(self) -> None:
        for level in (0, -1, 1, -3, 3):
            self._look(level)

    def _stroke(self, name: str, ink: tuple[str, ...] = ()) -> None:
        from app.desk.presets import DEFAULT
        from engine.brush.settings import Component
        from engine.studio import requests as q

        brush = _preset(name).brush if not ink else DEFAULT.brush
        if ink:
            brush = replace(brush, radius=24.0, ink=tuple(Component(n, 0.8, "#c8b496") for n in ink))
        self._begin(brush)
        self.studio.do(q.Finish())
        self._view()

    def _brushes(self) -> None:
        from engine.studio import requests as q

        for preset in _presets():
            self.studio.do(q.Swatch(preset.name, preset.brush, (96, 48), textures=preset.textures))

    def _files(self) -> None:
        from engine.archive.opening import open_painting
        from engine.archive.saving import Snapshot, save

        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "p.ora"
            save(path, Snapshot(self.studio.easel.session.painting))
            open_painting(path)

    def _warming(self) -> None:
        from engine.studio.warming import paint_once

        paint_once()


def _empty() -> None:
    from numba import njit

    njit(cache=True, nogil=True)(lambda values: values[0])(np.zeros(1))


def _presets() -> list[Preset]:
    from app.desk.presets import bundled_folder, load_brushes

    found, _ = load_brushes(bundled_folder())
    return found


def _preset(name: str) -> Preset:
    return next(preset for preset in _presets() if preset.name == name)


def run(stages: tuple[str, ...]) -> list[Compiled]:
    """What this process compiles at each stage; nothing has been compiled in it so far."""
    with metered() as meter:
        work = Stages()
        for meter.stage in stages:
            work.known[meter.stage]()
    return meter.compiled


def table(rows: list[Compiled]) -> str:
    """The kernels in the order of compiling, then the sums."""
    lines = [f"{row.own:7.3f}  {row.stage:<10} {row.kernel}({row.signature})" for row in rows]
    sums: Counter[str] = Counter()
    counts: Counter[str] = Counter()
    for row in rows:
        sums[row.stage] += row.own  # type: ignore[assignment]
        counts[row.stage] += 1
    lines += [f"{total:7.2f}  {stage:<10} {counts[stage]} kernels" for stage, total in sums.items()]
    return "\n".join([*lines, f"{sum(r.own for r in rows):7.2f}  all        {len(rows)} kernels"])


def main(words: list[str]) -> None:
    told = "--json" in words
    stages = tuple(word for word in words if word != "--json") or (*BRUSHES, "files", "warming")
    print(json.dumps([asdict(row) for row in run(stages)]) if told else table(fresh(stages)))


if __name__ == "__main__":
    main(sys.argv[1:])
