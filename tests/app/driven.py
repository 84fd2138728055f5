"""The program under a test's hand, on a display of its own."""

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from forked import ROOT, Forked, Server
from PIL import ImageGrab

from app.faults.file_guard import TOLD

Point = tuple[int, int]
Box = tuple[int, int, int, int]  # left, top, right, bottom, pixels of the screen
PATIENCE = 90.0  # seconds; the first start compiles kernels
REST = (640, 790)  # on the status line: there the pointer covers nothing that is looked at


def welcome(config: Path) -> None:
    """Has the start page been seen by whoever has this configuration folder."""
    path = config / "inkfall" / "window.json"
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text('{"welcomed": true}')


class Program:
    """`python -m app` on a display, moved by xdotool, seen through pictures of its screen.  `module`: one beside this
    file that starts the program in place of `app`; `ready`: what the program has told when it is handed over;
    `server`: what it is forked off, and does not load for itself; `first`: it is the first start of all."""

    def __init__(
        self,
        display: str,
        folder: Path,
        *words: str,
        trace: str = "1",
        module: str = "app",
        ready: str = "engine ready",
        server: Server | None = None,
        first: bool = False,
    ) -> None:
        self.display, self.folder = display, folder
        if not first:
            welcome(folder / "config")
        self.do("mouseup", 1)  # what held it before has ended
        environment = {
            **os.environ,
            "DISPLAY": display,
            "PYTHONPATH": str(ROOT) if module == "app" else os.pathsep.join((str(ROOT), str(Path(__file__).parent))),
            "XDG_CONFIG_HOME": str(folder / "config"),
            "XDG_DATA_HOME": str(folder / "data"),
            "XDG_STATE_HOME": str(folder / "state"),
            "XDG_PICTURES_DIR": str(folder),
            "INKFALL_TRACE": trace,
            "INKFALL_TRACEBACK": "1",
        }
        self._boxes: dict[tuple[str, str], Box] = {}  # by window and name, as far as the log is read
        self._read = 0
        self.log = folder / f"log-{time.monotonic_ns()}"
        self.process: Forked | subprocess.Popen[bytes]
        if server is not None:
            self.log.touch()
            self.process = server.start(module, words, folder, self.log, environment)
        else:
            with self.log.open("w") as log:
                command = [sys.executable, "-W", "error::RuntimeWarning", "-m", module, *words]
                self.process = subprocess.Popen(command, cwd=folder, env=environment, stderr=log, stdout=log)
        self.wait_for(ready)

    def wait_for(self, words: str) -> None:
        end = time.monotonic() + PATIENCE
        while words not in self.log.read_text():
            assert self.process.poll() is None, self.log.read_text()
            assert time.monotonic() < end, f"no {words!r}: {self.log.read_text()}"
            time.sleep(0.05)

    def until_rest(self, at: Point) -> None:
        """Waits until the program has taken the pointer there, and all that was asked for is done and drawn."""
        self.wait_until(lambda: self._told_at().startswith(f"rest {at[0]},{at[1]}\n"), f"not at rest at {at}")

    def move_to(self, at: Point) -> None:
        """Moves the pointer, and again until the program has taken it: it hears of none before its window is there."""
        end = time.monotonic() + PATIENCE
        self.do("mousemove", *at)
        while f" {at[0]},{at[1]}\n" not in self._told_at():
            assert self.process.poll() is None, self.log.read_text()
            assert time.monotonic() < end, f"the pointer is not at {at}: {self.log.read_text()[-2000:]}"
            time.sleep(0.1)
            self.do("mousemove", at[0] - 1, at[1], "mousemove", *at)

    def _told_at(self) -> str:
        """What the log tells since the program last said whether it is at rest or at work, and where the pointer is."""
        return f"\n{self.log.read_text()}".rpartition("\nat ")[2]

    def boxes(self) -> dict[tuple[str, str], Box]:
        """Where the controls that are in sight lie, by their windows' names and their own."""
        lines = self.log.read_bytes()[self._read :].rpartition(b"\n")[0]
        self._read += len(lines) + bool(lines)
        for line in lines.decode().splitlines():
            if line.startswith("box "):
                window, name, *box = json.loads(line[4:])
                self._boxes[window, name] = (box[0], box[1], box[2], box[3])
            elif line.startswith("gone "):
                window, name = json.loads(line[5:])
                self._boxes.pop((window, name), None)
        return self._boxes

    def box(self, name: str, window: str = "", seconds: float = PATIENCE) -> Box:
        """Where the control of this name lies, when it is in sight and at rest; `window`: the one it is in, which only
        names that several windows have need."""
        end, before = time.monotonic() + seconds, None
        while True:
            found = [box for key, box in self.boxes().items() if key[1] == name and window in ("", key[0])]
            if len(found) == 1 and found[0] == before:
                return found[0]
            before = found[0] if len(found) == 1 else None
            assert self.process.poll() is None, self.log.read_text()
            assert time.monotonic() < end, f"{name!r}: found {len(found)} in {sorted(self.boxes())}"
            time.sleep(0.1)

    def at(self, name: str, across: float = 0.5, down: float = 0.5, window: str = "") -> Point:
        """A point of a control, by its parts of the width and of the height: the middle, unless told."""
        left, top, right, bottom = self.box(name, window)
        return round(left + across * (right - left)), round(top + down * (bottom - top))

    def part(self, name: str, window: str = "") -> tuple[slice, slice]:
        """What of the screen a control takes: rows, columns."""
        left, top, right, bottom = self.box(name, window)
        return slice(top, bottom), slice(left, right)

    def until_gone(self, name: str, seconds: float = PATIENCE) -> None:
        """Waits until no control in sight has this name."""
        end = time.monotonic() + seconds
        while any(key[1] == name for key in self.boxes()):
            assert time.monotonic() < end, f"{name!r} is still there"
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
        """Types into the field that has the focus, as soon as one has."""
        self.wait_until(self._typing, "no field takes what is typed")
        self.do("type", "--delay", "20", text)

    def fill(self, text: str) -> None:
        """Types into the field that has the focus, instead of what is in it; again until that stands there: a key
        may be lost on a busy machine, where a long name takes many seconds to come in."""
        end = time.monotonic() + PATIENCE
        while True:
            self.wait_until(self._typing, "no field takes what is typed")
            self.keys("ctrl+a")
            self.type(text)
            stands, soon = "", time.monotonic() + 3.0
            while time.monotonic() < soon:
                told = f"\n{self.log.read_text()}".rpartition("\ntyping ")[2].partition("\n")[0]
                if told == f"on {json.dumps(text)}":
                    return
                if told != stands:
                    stands, soon = told, time.monotonic() + 3.0
                time.sleep(0.05)
            assert time.monotonic() < end, f"{text!r} does not stand there: {self.log.read_text()[-2000:]}"

    def _typing(self) -> bool:
        """Whether the log told last that a text field has the focus."""
        return f"\n{self.log.read_text()}".rpartition("\ntyping ")[2].startswith("on ")

    def wait_until(self, so: Callable[[], bool], otherwise: str, seconds: float = PATIENCE) -> None:
        """Waits until something is so, while the program runs."""
        end = time.monotonic() + seconds
        while not so():
            assert self.process.poll() is None, self.log.read_text()
            assert time.monotonic() < end, f"{otherwise}: {self.log.read_text()[-2000:]}"
            time.sleep(0.05)

    def stroke(self, *points: tuple[int, int]) -> None:
        """The left button drawn through screen points."""
        self.do("mousemove", *points[0], "mousedown", 1)
        for point in points[1:]:
            self.do("mousemove", *point)
            time.sleep(0.02)
        self.do("mouseup", 1)

    def drag(self, start: tuple[int, int], end: tuple[int, int], steps: int = 6) -> None:
        """The left button held from one point of the screen to another, as slowly as by hand; it stays down."""
        self.move_to(start)
        self.do("mousedown", 1)
        for i in range(1, steps + 1):
            self.do("mousemove", *(round(a + (b - a) * i / steps) for a, b in zip(start, end, strict=True)))
            time.sleep(0.03)

    def wheel(self, notches: int) -> None:
        self.do("click", "--repeat", abs(notches), "--delay", 15, 4 if notches > 0 else 5)

    def screen(self) -> np.ndarray:
        """What the screen shows, uint8 (800, 1280, 3)."""
        return np.asarray(ImageGrab.grab(xdisplay=self.display).convert("RGB"))

    def settled(self, seconds: float = PATIENCE, calm: int = 4) -> np.ndarray:
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
        self.move_to(REST)
        return self.settled(calm=calm)[60:740, 270:970].astype(int)

    def comes_to(self, picture: np.ndarray, seconds: float = 60.0) -> bool:
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
            assert time.monotonic() < end, f"the canvas stays as it was: {self.log.read_text()[-2000:]}"
        return now

    def until(self, good: Callable[[np.ndarray], bool], pointer: Point = REST, seconds: float = 60.0) -> np.ndarray:
        """The settled screen, int (800, 1280, 3), once it is good, with the pointer there: kernels may be compiled."""
        end = time.monotonic() + seconds
        while not good(screen := self.parked(pointer)):
            assert time.monotonic() < end, f"not so within {seconds:g} s: {self.log.read_text()[-2000:]}"
        return screen

    def park(self) -> None:
        self.do("mousemove", *REST)

    def parked(self, pointer: Point = REST) -> np.ndarray:
        """The settled screen, int (800, 1280, 3), with the pointer there, so that no cursor or tooltip covers it."""
        self.do("mousemove", *pointer)
        time.sleep(0.3)
        return self.settled(calm=2).astype(int)

    def click(self, at: str | Point, window: str = "") -> None:
        """A click as slow as a hand's, on a control or on a point: some look where the pointer is a frame before."""
        self.move_to(self.at(at, window=window) if isinstance(at, str) else at)
        time.sleep(0.2)  # two clicks on one thing are not a double click
        self.do("mousedown", 1)
        time.sleep(0.1)
        self.do("mouseup", 1)

    def save_as(self, path: Path, seconds: float = PATIENCE) -> None:
        """Saves under a name, in the dialog that comes up, and waits for the file."""
        end = time.monotonic() + seconds
        self.keys("ctrl+s")
        self.box("name", "Save as")
        self.fill(str(path))
        self.keys("Return")
        while not path.exists():
            assert time.monotonic() < end, f"no {path}"
            time.sleep(0.05)

    def close(self) -> None:
        """Ends it; fails if it has told a fault, which a test that provokes one takes out of `log`."""
        self.process.terminate()
        self.process.wait(30)
        words = self.log.read_text(errors="replace")
        assert "Traceback (most recent call last)" not in words, words
        told = [line for line in self.log.read_text(errors="replace").splitlines() if line.startswith(TOLD)]
        assert not told, "\n".join(told)
