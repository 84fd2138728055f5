"""Painting with example textures: preview and refinement of a dab, a stroke, a fill; beside G'MIC, if it is there.

What one thread does is measured in its own processor time, so that neighbours count for less.
"""

from __future__ import annotations

import resource
import shutil
import statistics
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Event

import numpy as np

from bench import Figure, Skipped
from bench.clock import Work, best, second_core, slowness
from engine.files.atomic import replacing
from engine.files.png_writer import write_png
from engine.numeric.address import Rect
from engine.numeric.arithmetic import EVERYWHERE
from engine.texture.example import scanline, show
from engine.texture.example.control import Channel
from engine.texture.example.controlled import analysed_with
from engine.texture.example.exemplar import Exemplar, analysed
from engine.texture.example.parameters import NEW, Parameters
from engine.texture.example.region import Region, empty, painted, refined, refining
from engine.texture.table import instance

REPEATS = 7
ANALYSIS, PREVIEW, DAB, STROKE, LATE = 0.3, 0.002, 0.010, 0.080, 0.006  # seconds
TOLD = 1.5  # times as long as without maps, at most
TOGETHER = 1.5  # how many times faster two threads are, at least
TIMES_FASTER = {"the paper's scanline order": 3.0, "G'MIC's": 2.0}
DIAMETER, SPACING = 64, 8
FILL = 1024
FRAME = 1.0 / 60.0
BLOCK = 60  # turns


def measure(small: bool = False) -> Iterator[Figure | Skipped]:
    repeats = 1 if small else REPEATS
    slow = max(1.0, slowness(repeats))
    for side in (48,) if small else (200, 400):
        pixels = _rock(side)
        taken = _processor(repeats, lambda pixels=pixels: analysed(pixels))  # type: ignore[misc]
        yield _within(f"analysis, {side} x {side}", taken, ANALYSIS, slow)
        for parameters in (Parameters(), NEW):
            yield from _painting(analysed(pixels, None, parameters), side, repeats, slow)
    exemplar = analysed(pixels)
    yield _told(48 if small else 200, repeats)
    yield _against_scanline(exemplar, 48 if small else 128, repeats)
    yield _threads(exemplar, FILL // 8 if small else FILL, repeats)
    yield _lateness(exemplar, 1 if small else 6)
    yield from _against_gmic(repeats, small)


def _processor(repeats: int, work: Work) -> float:
    """The shortest time, in seconds of this thread."""
    work()
    return min(_spent(work) for _ in range(repeats))


def _spent(work: Work) -> float:
    start = time.thread_time()
    work()
    return time.thread_time() - start


def _within(name: str, taken: float, limit: float, slow: float, note: str = "") -> Figure:
    """`limit`: seconds, where copying takes as long as it did where the limit was set."""
    bound = f"{limit * 1e3:.0f} ms, as copying is {slow:.2f} x as slow"
    return Figure(name, taken * 1e3, "ms", bound, taken / (limit * slow), 1.0, note=note)


def _rock(side: int, rim: bool = True) -> np.ndarray:
    """A rock with a light, half transparent rim, or filling its picture: uint8 RGBA (side, side, 4)."""
    s = 0.5 + 0.5 * instance("rock", {"period": 24, "seed": 4}, 0, 0).appearance(0, Rect.at(0, 0, side, side))[0]
    y, x = np.mgrid[:side, :side] - (side - 1) / 2.0
    depth = side * 0.46 + 6.0 * (s - 0.5) - np.hypot(x, y) if rim else np.full((side, side), 99.0)
    light = np.clip(1.0 - depth / 6.0, 0.0, 1.0)[..., None]
    colours = s[..., None] * (0.8, 0.7, 0.5) * (1.0 - light) + light
    out = np.concatenate([colours, np.clip(0.3 + depth / 4.0, 0.0, 1.0)[..., None] * (depth > 0)[..., None]], axis=-1)
    return (255.0 * np.clip(out, 0.0, 1.0) + 0.5).astype(np.uint8)


def _dab(region: Region, x: int) -> Region:
    r = DIAMETER // 2
    rows, columns = np.mgrid[:DIAMETER, :DIAMETER] - (r - 0.5)
    return painted(region, Rect.at(x - r, -r, DIAMETER, DIAMETER), rows**2 + columns**2 < r * r)


def _painting(exemplar: Exemplar, side: int, repeats: int, slow: float) -> Iterator[Figure]:
    start, coarsest, small = empty(exemplar, 1), len(exemplar.levels) - 1, repeats == 1
    how = ", without seams" if exemplar.seamless else ""
    preview = _processor(3 * repeats, lambda: refined(_dab(start, 5), coarsest))
    note = f"refined wholly: {_processor(repeats, lambda: refined(_dab(start, 5))) * 1e3:.1f} ms"
    yield _within(f"preview of a dab, {side}{how}", preview, PREVIEW, slow, note)
    growing, times = refined(_dab(start, 0)), []
    for x in range(SPACING, 20 if small else 600, SPACING):
        times.append(_processor(2, lambda x=x, growing=growing: refined(_dab(growing, x))))  # type: ignore[misc]
        growing = refined(_dab(growing, x))
    last = float(np.quantile(times, 0.95))
    note = f"median of a stroke of {len(times)} dabs, {SPACING} px apart; 95 % within {last * 1e3:.1f} ms"
    yield _within(f"a dab on a growing stroke, {side}{how}", statistics.median(times), DAB, slow, note)
    mask = _stroke(60 if small else 600)
    rect = Rect.at(0, 0, mask.shape[1], mask.shape[0])
    taken = _processor(repeats, lambda: refined(painted(start, rect, mask)))
    yield _within(f"a stroke at once, {side}{how}", taken, STROKE, slow, f"{int(mask.sum()):,} pixels")


def _told(side: int, repeats: int) -> Figure:
    """Dabs along an arc, of an example that is turned as they go and has a wide rim, and of the same without."""
    channels = Channel("orientation", 1.0, 24), Channel("rim", 1.0, 1, side // 4)
    planes = np.zeros((2, side, side), np.uint8)
    told = analysed_with(_rock(side), None, Parameters(), (channels, planes), EVERYWHERE)
    spent: list[list[float]] = [[], []]
    growing = [refined(_arc_dab(empty(one, 1), 0)) for one in (told, analysed(_rock(side)))]
    for k in range(1, 4 if repeats == 1 else 60):
        for n, old in enumerate(growing):
            spent[n].append(min(_spent(lambda old=old, k=k: refined(_arc_dab(old, k))) for _ in range(2)))  # type: ignore[misc]
        growing = [refined(_arc_dab(old, k)) for old in growing]
    with_maps, without = (statistics.median(times) for times in spent)
    name = f"a dab that follows the pen, with a wide rim, {side}"
    return Figure(name, with_maps * 1e3, "ms", "the same example without maps", with_maps / without, TOLD)


def _arc_dab(region: Region, k: int) -> Region:
    """The dab number `k` of a stroke around a circle; pixels are told to run as that does."""
    r, around = DIAMETER // 2, 200
    turn = k * SPACING / around
    x, y = round(around * np.sin(turn)), round(around - around * np.cos(turn))
    rows, columns = np.mgrid[:DIAMETER, :DIAMETER] - (r - 0.5)
    way = np.arctan2(columns + x, around - rows - y) * (128.0 / np.pi)
    values = (np.rint(way).astype(int) & 255).astype(np.uint8)[None] if region.told else None
    rect = Rect.at(x - r, y - r, DIAMETER, DIAMETER)
    return painted(region, rect, rows**2 + columns**2 < r * r, values=values)


def _stroke(length: int) -> np.ndarray:
    """80 pixels wide, with round ends: bool (80, length)."""
    y, x = np.mgrid[:80, :length] + 0.5
    beyond = np.maximum(np.maximum(40.0 - x, x - length + 40.0), 0.0)
    return (y - 40.0) ** 2 + beyond**2 < 1600.0


def _against_scanline(exemplar: Exemplar, side: int, repeats: int) -> Figure:
    mask, rect = np.ones((side, side), bool), Rect(0, 0, side, side)
    taken = _processor(repeats, lambda: show.pixels(refined(painted(empty(exemplar, 1), rect, mask)), rect))
    other = _processor(min(repeats, 2), lambda: scanline.filled(exemplar, mask, 1))
    bound = "the paper's scanline order"
    name = f"{side} x {side} filled, order"
    return Figure(name, taken * 1e3, "ms", bound, other / taken, TIMES_FASTER[bound], True, "one thread each")


def _threads(exemplar: Exemplar, side: int, repeats: int) -> Figure:
    start = painted(empty(exemplar, 1), Rect(0, 0, side, side), np.ones((side, side), bool))
    with ThreadPoolExecutor(2) as pool:
        one, two = best(repeats, lambda: refined(start), lambda: refined(start, threads=pool))
    name = f"{side} x {side} filled, two threads"
    note = f"plain work is {second_core(repeats):.2f} x as fast with two here"
    return Figure(name, two * 1e3, "ms", "one thread", one / two, TOGETHER, True, note)


def _lateness(exemplar: Exemplar, blocks: int) -> Figure:
    """How late a loop of 60 turns a second wakes while another thread refines: in the best of several seconds."""
    start = painted(empty(exemplar, 1), Rect(0, 0, FILL, FILL), np.ones((FILL, FILL), bool))
    alone, beside = [], []
    with ThreadPoolExecutor(1) as pool:
        for _ in range(blocks):
            alone.append(_late(BLOCK))
            over = Event()
            job = pool.submit(_refine_until, start, over)
            beside.append(_late(BLOCK))
            over.set()
            job.result()
    without, late = (min(float(np.quantile(block, 0.99)) for block in times) for times in (alone, beside))
    note = f"99th percentile of {BLOCK} turns, best of {blocks}; with nothing beside it {without * 1e3:.2f} ms"
    return Figure("a 60 Hz loop beside it, late", late * 1e3, "ms", f"{LATE * 1e3:.0f} ms", late / LATE, 1.0, note=note)


def _refine_until(start: Region, over: Event) -> None:
    while not over.is_set():
        for _ in refining(start):
            if over.is_set():
                break


def _late(frames: int) -> list[float]:
    found, due = [], time.perf_counter()
    for _ in range(frames):
        due += FRAME
        time.sleep(max(0.0, due - time.perf_counter()))
        found.append(time.perf_counter() - due)
        due += FRAME * max(0, int(found[-1] / FRAME))  # what was missed is not made up for
    return found


def _against_gmic(repeats: int, small: bool) -> Iterator[Figure | Skipped]:
    """Pixels for each second of processor time, its start and its files apart."""
    side, filled = (48, 64) if small else (200, 512)
    command = shutil.which("gmic")
    if command is None:
        yield Skipped(f"{side} to {filled} against G'MIC", "gmic is not installed")
        return
    try:
        pictures = photos(side)
    except ImportError as error:
        yield Skipped(f"{side} to {filled} against G'MIC", f"{error.name} is not installed")
        return
    for name, pixels in list(pictures.items())[: 1 if small else None]:
        with tempfile.TemporaryDirectory() as folder:
            with replacing(Path(folder) / "in.png") as file:
                write_png(file, np.ascontiguousarray(pixels[..., :3]))
            words = [command, f"{folder}/in.png"]
            last = ["-o", f"{folder}/out.png"]
            size = ["-syntexturize_matchpatch", f"{filled},{filled}"]
            made = min(_child([*words, *size, *last]) for _ in range(min(repeats, 2)))
            idle = min(_child([*words, *last]) for _ in range(min(repeats, 2)))
        taken = _processor(min(repeats, 3), filling(pixels, filled))
        note = f"syntexturize_matchpatch: {made - idle:.2f} s of processor time; ours with analysis, one thread"
        title = f"{name}, {side} to {filled}"
        yield Figure(title, taken * 1e3, "ms", "G'MIC's", (made - idle) / taken, TIMES_FASTER["G'MIC's"], True, note)


def filling(pixels: np.ndarray, side: int) -> Callable[[], np.ndarray]:
    """The work of filling a square of so many pixels with a picture: RGBA (side, side, 4)."""
    mask, rect = np.ones((side, side), bool), Rect(0, 0, side, side)
    return lambda: show.pixels(refined(painted(empty(analysed(pixels, None, NEW), 1), rect, mask)), rect)


def _child(words: list[str]) -> float:
    """Processor time of another program, in seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(words, check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def photos(side: int) -> dict[str, np.ndarray]:
    """Gravel, grass, brick and a printed page: uint8 RGBA (side, side, 4)."""
    from skimage import data, transform

    cut = {name: getattr(data, name)()[: 2 * side, : 2 * side] for name in ("gravel", "grass", "brick")}
    cut["printed paper"] = data.page()[:side, 180 : 180 + side]
    out = {}
    for name, grey in cut.items():
        values = transform.resize(grey.astype(np.float64) / 255.0, (side, side), anti_aliasing=name != "printed paper")
        plane = (255.0 * np.clip(values, 0.0, 1.0) + 0.5).astype(np.uint8)
        out[name] = np.dstack([plane, plane, plane, np.full_like(plane, 255)])
    return out
