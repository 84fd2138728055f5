"""A flight through 12 levels of the demo at 1920 x 1080, 60 frames a second: against libx264 on the same frames."""

from __future__ import annotations

import json
import shutil
import subprocess
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from bench import Figure, Skipped
from bench.display import ROOT
from engine.film.aim import Aim, aim_at
from engine.film.formats import write_film
from engine.film.shooting import Film, Shooting
from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.painting.recording import read
from engine.session.apply import Painting, apply
from engine.session.replay import replay

DEMO = ROOT / "palettes" / "demo"
SIZE, FPS, SECONDS = (1920, 1080), 60.0, 12.0
MEDIUM = ("-c:v", "libx264", "-preset", "medium", "-crf", "18", "-threads", "2")


def measure(small: bool = False) -> Iterator[Figure | Skipped]:
    name = "film, a flight of 12 levels"
    if shutil.which("ffmpeg") is None:
        yield Skipped(name, "needs ffmpeg")
        return
    size = (64, 36) if small else SIZE
    painting, places = _simple(size) if small else _demo(size)
    shooting = Shooting(Film(places, size, FPS, 1.0 if small else SECONDS), painting)
    with tempfile.TemporaryDirectory() as folder:
        raw, film = Path(folder) / "frames", Path(folder) / "film.mp4"
        _encode(shooting, raw)
        start = time.perf_counter()
        _x264(raw, size, Path(folder) / "bound.mp4")
        alone = time.perf_counter() - start
        raw.unlink()
        start = time.perf_counter()
        write_film(film, shooting)
        taken = time.perf_counter() - start
    note = f"{shooting.count} frames; libx264 alone took {alone:.1f} s"
    yield Figure(name, taken, "s", "libx264, medium, crf 18, two threads", taken / alone, 2.0, note=note)


def _demo(size: tuple[int, int]) -> tuple[Painting, tuple[Aim, ...]]:
    level, *rect = json.loads((DEMO / "demo.json").read_text())["zoom"][-1]
    painting = replay(read(DEMO / "demo.jsonl")).painting
    return painting, (aim_at(0, painting.frame, size), aim_at(level, Rect.at(*rect), size))


def _simple(size: tuple[int, int]) -> tuple[Painting, tuple[Aim, ...]]:
    painting = apply(Painting(), parse({"do": "stroke", "points": [[0, 0], [64, 36]], "brush": {"radius": 12}}))
    return painting, (aim_at(0, Rect.at(0, 0, 64, 36), size), aim_at(2, Rect.at(100, 60, 64, 36), size))


def _raw(size: tuple[int, int], kind: str) -> tuple[str, ...]:
    return ("-f", "rawvideo", "-pix_fmt", kind, "-s", f"{size[0]}x{size[1]}", "-r", f"{FPS:g}")


def _encode(shooting: Shooting, path: Path) -> None:
    """Keeps the frames as libx264 takes them."""
    size = shooting.film.size
    words = [
        "ffmpeg",
        "-v",
        "error",
        *_raw(size, "rgb24"),
        "-i",
        "-",
        "-pix_fmt",
        "yuv420p",
        "-f",
        "rawvideo",
        str(path),
    ]
    process = subprocess.Popen(words, stdin=subprocess.PIPE)
    assert process.stdin is not None
    for frame in shooting.frames():
        process.stdin.write(frame.data)
    process.stdin.close()
    assert process.wait() == 0


def _x264(raw: Path, size: tuple[int, int], out: Path) -> None:
    words = ["ffmpeg", "-v", "error", *_raw(size, "yuv420p"), "-i", str(raw), *MEDIUM, str(out)]
    subprocess.run(words, check=True)
