"""A display of their own for tests that open the real window, and the program under a test's hand."""

import ctypes
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import moderngl
import numpy as np
import pytest
from PIL import ImageGrab
from xserver import lacking, need, started_server

ROOT = Path(__file__).parents[2]
PATIENCE = 90.0  # seconds; the first start compiles kernels


class Program:
    """`python -m app` on a display, moved by xdotool, seen through pictures of its screen."""

    def __init__(self, display: str, folder: Path, *words: str) -> None:

        self.display, self.folder = display, folder
        environment = {
            **os.environ,
            "DISPLAY": display,
            "PYTHONPATH": str(ROOT),
            "XDG_CONFIG_HOME": str(folder / "config"),
            "XDG_DATA_HOME": str(folder / "data"),
            "INKFALL_TRACE": "1",
            "INKFALL_TRACEBACK": "1",
        }
        self.log = folder / f"log-{time.monotonic_ns()}"
        with self.log.open("w") as log:
            command = [sys.executable, "-W", "error::RuntimeWarning", "-m", "app", *words]
            self.process = subprocess.Popen(command, cwd=folder, env=environment, stderr=log, stdout=log)
        self.wait_for("engine ready")

    def wait_for(self, words: str) -> None:
        end = time.monotonic() + PATIENCE
        while words not in self.log.read_text():
            assert self.process.poll() is None, self.log.read_text()
            assert time.monotonic() < end, f"no {words!r}: {self.log.read_text()}"
            time.sleep(0.05)

    def do(self, *words: object) -> None:
        """xdotool's words."""
        subprocess.run(
            ["xdotool", *map(str, words)], check=True, env={**os.environ, "DISPLAY": self.display}, timeout=30
        )

    def keys(self, *chords: str) -> None:
        for chord in chords:
            self.do("key", chord)
            time.sleep(0.08)

    def type(self, text: str) -> None:
        self.do("type", "--delay", "20", text)

    def stroke(self, *points: tuple[int, int]) -> None:
        """The left button drawn through screen points."""
        self.do("mousemove", *points[0], "mousedown", 1)
        for point in points[1:]:
            self.do("mousemove", *point)
            time.sleep(0.02)
        self.do("mouseup", 1)

    def wheel(self, notches: int) -> None:
        self.do("click", "--repeat", abs(notches), "--delay", 15, 4 if notches > 0 else 5)

    def screen(self) -> np.ndarray:
        """What the screen shows, uint8 (800, 1280, 3)."""
        return np.asarray(ImageGrab.grab(xdisplay=self.display).convert("RGB"))

    def settled(self, seconds: float = 20.0, calm: int = 4) -> np.ndarray:
        """The screen when it has not changed for a while: `calm` looks, 0.15 s apart."""
        end = time.monotonic() + seconds
        last, same = self.screen(), 0
        while same < calm:
            time.sleep(0.15)
            now = self.screen()
            same = same + 1 if np.array_equal(now, last) else 0
            last = now
            assert time.monotonic() < end, "the screen does not come to rest"
        return last

    def canvas(self, calm: int = 4) -> np.ndarray:
        """The middle of the settled screen, with the pointer parked so that no cursor or tooltip covers it."""
        self.do("mousemove", 700, 790)
        time.sleep(0.2)
        return self.settled(calm=calm)[60:740, 270:970].astype(int)

    def comes_to(self, picture: np.ndarray, seconds: float = 30.0) -> bool:
        """Whether the canvas shows exactly this, at once or when slow work is done: kernels may still be compiled."""
        end = time.monotonic() + seconds
        while not np.array_equal(self.canvas(), picture):
            if time.monotonic() > end:
                return False
        return True

    def canvas_unlike(self, picture: np.ndarray, seconds: float = 60.0) -> np.ndarray:
        """The canvas when it shows something else than this and has come to rest: kernels may still be compiled."""
        end = time.monotonic() + seconds
        while np.array_equal(now := self.canvas(calm=8), picture):
            assert time.monotonic() < end, "the canvas stays as it was"
        return now

    def until(self, good: Callable[[np.ndarray], bool], pointer: tuple[int, int], seconds: float = 60.0) -> np.ndarray:
        """The settled screen, int (800, 1280, 3), once it is good, with the pointer there: kernels may be compiled."""
        end = time.monotonic() + seconds
        while not good(screen := self.parked(pointer)):
            assert time.monotonic() < end
        return screen

    def parked(self, pointer: tuple[int, int]) -> np.ndarray:
        """The settled screen, int (800, 1280, 3), with the pointer there, so that no cursor or tooltip covers it."""
        self.do("mousemove", *pointer)
        time.sleep(0.3)
        return self.settled(calm=2).astype(int)

    def click(self, at: tuple[int, int]) -> None:
        self.do("mousemove", *at)
        time.sleep(0.25)
        self.do("click", 1)

    def save_as(self, path: Path, seconds: float = 30.0) -> None:
        """Saves under a name, in the dialog that comes up, and waits for the file."""
        end = time.monotonic() + seconds
        light = self.screen()[60:760, 1000:1270].mean()
        self.keys("ctrl+s")
        while self.screen()[60:760, 1000:1270].mean() > 0.85 * light:  # a dialog darkens what is behind it
            assert time.monotonic() < end, "no dialog"
            time.sleep(0.05)
        self.keys("ctrl+a")
        self.type(str(path))
        self.keys("Return")
        while not path.exists():
            assert time.monotonic() < end, f"no {path}"
            time.sleep(0.05)

    def close(self) -> None:
        self.process.terminate()
        self.process.wait(10)


@pytest.fixture(scope="session")
def display():
    need("Xvfb", "xdotool")
    process, name = started_server(["Xvfb", "-screen", "0", "1280x800x24", "-noreset", "-nolisten", "tcp"])
    yield name
    process.terminate()
    process.wait(10)


@pytest.fixture
def program(display, tmp_path):
    opened = []

    def start(*words: str, on: str = display) -> Program:
        opened.append(Program(on, tmp_path, *words))
        return opened[-1]

    yield start
    for one in opened:
        one.close()


@pytest.fixture(scope="module")
def context():
    """OpenGL without a display."""
    try:
        made = moderngl.create_context(standalone=True, backend="egl")
    except Exception as error:  # whatever the driver says: no GL here
        lacking(f"EGL: {error}")
    yield made
    made.release()
    ctypes.CDLL("libEGL.so.1").eglReleaseThread()  # X refuses windows of a thread that has a context of EGL's
