"""From a movement of the pen until its paint is on the screen: the real window on a display of its own, moved through
the X server and seen through it, as from outside.  Looking takes a while itself: half of a look is taken off."""

from __future__ import annotations

import ctypes as ct
import ctypes.util
import statistics
import subprocess
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from bench import Figure, Skipped
from bench.display import NEEDED, available, display, python

MOVES = 40  # measured, of
IN_STROKE = 8  # movements of one stroke each
FRAME = 1 / 60  # seconds
MEDIAN, SLOWEST = 0.030, 0.045  # seconds, at most
STEP = 60  # pixels of a movement
NEAR = 10  # pixels of it after which paint is looked for: the path stays half a movement behind the pen
PATIENCE = 300.0  # seconds
LONGEST = 5.0  # seconds
PAUSE = 0.0005  # seconds between two looks
CALM = 0.35  # seconds between two movements: frames have come to rest


def measure(small: bool = False) -> Iterator[Figure | Skipped]:
    names = "pen to paint, median", "pen to paint, slowest"
    if not available() or ctypes.util.find_library("Xtst") is None:
        for name in names:
            yield Skipped(name, f"needs {NEEDED} and libXtst")
        return
    times = delays(3 if small else MOVES)
    note = f"{len(times)} movements of a mouse, from the X server's taking one to its showing paint; polling taken off"
    for name, value, most in zip(names, (statistics.median(times), max(times)), (MEDIAN, SLOWEST), strict=True):
        yield Figure(
            name, value * 1e3, "ms", f"a frame of {FRAME * 1e3:.1f} ms", value / FRAME, most / FRAME, note=note
        )


def delays(count: int) -> list[float]:
    """Seconds of so many movements."""
    with tempfile.TemporaryDirectory() as folder, display() as environment:
        homes = {f"XDG_{name}_HOME": str(Path(folder) / name.lower()) for name in ("CONFIG", "DATA", "STATE")}
        log = Path(folder) / "log"
        with log.open("w") as out:
            program = subprocess.Popen(
                python("-m", "app"),
                env={**environment, **homes, "INKFALL_TRACE": "1"},
                stdout=subprocess.DEVNULL,
                stderr=out,
            )
        try:
            _wait_for(log, "all brushes ready", program)
            with Outside(environment["DISPLAY"]) as outside:
                return list(_measured(outside, count))
        finally:
            program.kill()
            program.wait(PATIENCE)


def _wait_for(log: Path, words: str, program: subprocess.Popen[bytes]) -> None:
    end = time.monotonic() + PATIENCE
    while words not in log.read_text():
        if program.poll() is not None or time.monotonic() > end:
            raise OSError("the window did not open")
        time.sleep(0.05)
    time.sleep(2.0)  # what comes of it is drawn


def _measured(outside: Outside, count: int) -> Iterator[float]:
    outside.stroke(380, 620, STEP)  # what paint looks like, and kernels are loaded
    for n in range(count):
        row, column = divmod(n, IN_STROKE)
        y, x = 140 + 18 * row, 330 + column * (STEP + 4)
        if column == 0:
            outside.move(x, y)
            outside.button(True)
        time.sleep(CALM)
        yield outside.delay((x + NEAR, y), (x + STEP + 4, y))
        if column == IN_STROKE - 1 or n == count - 1:
            time.sleep(CALM)
            outside.button(False)
            time.sleep(CALM)


class _Image(ct.Structure):
    """The beginning of XImage."""

    _fields_ = (
        ("width", ct.c_int),
        ("height", ct.c_int),
        ("xoffset", ct.c_int),
        ("format", ct.c_int),
        ("data", ct.c_void_p),
    )


class Outside:
    """A client of the X server beside the program: it moves the pointer, and looks at pixels of the screen."""

    def __init__(self, name: str) -> None:
        x, test = (ct.CDLL(ctypes.util.find_library(lib) or lib) for lib in ("X11", "Xtst"))
        p, i, u = ct.c_void_p, ct.c_int, ct.c_ulong
        for function, result, arguments in (
            (x.XOpenDisplay, p, (ct.c_char_p,)),
            (x.XCloseDisplay, i, (p,)),
            (x.XSync, i, (p, i)),
            (x.XDefaultRootWindow, u, (p,)),
            (x.XGetImage, ct.POINTER(_Image), (p, u, i, i, ct.c_uint, ct.c_uint, u, i)),
            (x.XDestroyImage, i, (ct.POINTER(_Image),)),
            (test.XTestFakeMotionEvent, i, (p, i, i, i, u)),
            (test.XTestFakeButtonEvent, i, (p, ct.c_uint, i, u)),
        ):
            function.restype, function.argtypes = result, arguments
        self._x, self._test = x, test
        self._display = x.XOpenDisplay(name.encode())
        if not self._display:
            raise OSError(f"the X server {name} refuses a connection")
        self._root = x.XDefaultRootWindow(self._display)
        self._paper = 0

    def __enter__(self) -> Outside:
        return self

    def __exit__(self, *_: object) -> None:
        self._x.XCloseDisplay(self._display)

    def move(self, x: int, y: int) -> None:
        self._test.XTestFakeMotionEvent(self._display, -1, x, y, 0)
        self._x.XSync(self._display, 0)

    def button(self, pressed: bool) -> None:
        self._test.XTestFakeButtonEvent(self._display, 1, pressed, 0)
        self._x.XSync(self._display, 0)

    def pixel(self, x: int, y: int) -> tuple[int, int, int]:
        """Red, green and blue of a pixel of the screen."""
        image = self._x.XGetImage(self._display, self._root, x, y, 1, 1, 0xFFFFFF, 2)
        b, g, r = ct.string_at(image.contents.data, 3)
        self._x.XDestroyImage(image)
        return r, g, b

    def stroke(self, x: int, y: int, length: int) -> None:
        """Paints a stroke to the right, slowly."""
        self.move(x, y)
        self.button(True)
        for n in range(8):
            self.move(x + length * n // 7, y)
            time.sleep(0.05)
        self.button(False)
        time.sleep(1.0)

    def delay(self, looked_at: tuple[int, int], to: tuple[int, int]) -> float:
        """Moves the pointer; seconds until a pixel beside its way is another one than before."""
        before = self.pixel(*looked_at)
        self.move(*to)
        start = looked = time.perf_counter()
        while looked - start < LONGEST:
            last, seen = looked, self.pixel(*looked_at)
            looked = time.perf_counter()
            if seen != before:
                return (last + looked) / 2 - start
            time.sleep(PAUSE)  # the program and the server need the processor, too
        raise OSError("the movement left no paint")
