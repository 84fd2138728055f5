"""The program under a test's hand, on a display of its own."""

import itertools
import json
import math
import os
import signal
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
LOOK = 0.02  # seconds from one look at what the program tells to the next
APART = 0.7  # seconds from one click on a point to the next, which are no double click then
STANDS = 4.0  # seconds after which what does not go on to come into a field has been lost
PRESSES = "mousedown", "mouseup", "click", "keydown", "keyup", "key"  # words of xdotool's, each before one other
WHEEL = "4", "5", "6", "7"  # buttons that are notches of it
SAME = 0.6  # seconds after which a control that lies where it lay is at rest, while the program is not
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
        self.display, self.folder, self.waits = display, folder, True
        self.log = folder / f"log-{time.monotonic_ns()}"
        self.log.touch()
        self._boxes: dict[tuple[str, str], Box] = {}  # by window and name, as far as the log is read
        self._read = self._changes = 0  # bytes of it, and how often it told anything of rest
        self._rests, self._kept, self._at, self._took, self._typed = False, False, "", [0, 0], ""  # what it told last
        self._sent, self._goal = [0, 0], ""  # keys and presses that it is to take, and where the pointer is to be
        self._down: set[str] = set()  # buttons of the mouse
        self._again = 0.0  # when the pointer is moved again, if it is not there
        self._clicked: tuple[Point, float] = (0, 0), -APART
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
        self.process: Forked | subprocess.Popen[bytes]
        if server is not None:
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

    def until_rest(self, at: Point | None = None) -> None:
        """Waits until the program has taken all that was done, the pointer there, and all that was asked for is done
        and drawn."""
        self._goal = self._goal if at is None else f"{at[0]},{at[1]}"
        self.wait_until(self.at_rest, f"not at rest at {self._goal}")

    def at_rest(self) -> bool:
        """Whether the program told last that it is at rest, and has taken all that was done."""
        self._hear()
        self._move_again()
        return self._rests and self._has_taken()

    def until_kept(self) -> None:
        """Waits until all that was painted is on disk, too, whatever ends the program then."""
        self.wait_until(lambda: self.at_rest() and self._kept, "it is not on disk")

    def taken(self) -> None:
        """Waits until the program has taken what was pressed and let go, and the pointer, if it lives that long."""
        end = time.monotonic() + PATIENCE
        while self.waits and not self._has_taken() and self.process.poll() is None:
            told = f"at {self._at}, taken {self._took}"
            assert time.monotonic() < end, f"at {self._goal}, sent {self._sent}; {told}: {self.log.read_text()[-2000:]}"
            self._move_again()
            time.sleep(LOOK)
            self._hear()

    def _move_again(self) -> None:
        """Moves the pointer where it is to be once a second while it is elsewhere and no button is down: the program
        hears of no move before its window is there, and another client of the display may have moved it since."""
        if self._goal not in ("", self._at) and not self._down and time.monotonic() > self._again:
            x, y = self._goal.split(",")
            self.do("mousemove", int(x) - 1, y, "mousemove", x, y)

    def _has_taken(self) -> bool:
        there = self._goal in ("", self._at)
        return not self.waits or (there and all(map(int.__ge__, self._took, self._sent)))

    def move_to(self, at: Point) -> None:
        """Moves the pointer, and waits until the program has taken it."""
        self.do("mousemove", *at)
        self.taken()

    def _hear(self) -> None:
        """Takes in what the log tells by now."""
        with self.log.open("rb") as log:
            log.seek(self._read)
            lines = log.read().rpartition(b"\n")[0]
        self._read += len(lines) + bool(lines)
        for line in lines.decode().splitlines():
            if line.startswith("box "):
                window, name, *box = json.loads(line[4:])
                self._boxes[window, name] = (box[0], box[1], box[2], box[3])
            elif line.startswith("gone "):
                window, name = json.loads(line[5:])
                self._boxes.pop((window, name), None)
            elif line.startswith("typing "):
                self._typed = line[7:]
            elif line.startswith("at "):
                before = self._rests, self._at, self._took
                _, what, kept, self._at, keys, presses = line.split()
                self._rests, self._kept, self._took = what == "rest", kept == "kept", [int(keys), int(presses)]
                self._changes += (self._rests, self._at, self._took) != before

    def boxes(self) -> dict[tuple[str, str], Box]:
        """Where the controls that are in sight lie, by their windows' names and their own."""
        self._hear()
        return self._boxes

    def box(self, name: str, window: str = "", seconds: float = PATIENCE) -> Box:
        """Where the control of this name lies, when it is in sight and at rest; `window`: the one it is in, which only
        names that several windows have need."""
        self.taken()
        begun = since = time.monotonic()
        before = None
        while True:
            found = [box for key, box in self.boxes().items() if key[1] == name and window in ("", key[0])]
            now = time.monotonic()
            since = since if found == before else now
            if len(found) == 1 and (self.at_rest() or now - since > SAME):
                return found[0]
            before = found
            assert self.process.poll() is None, self.log.read_text()
            assert now - begun < seconds, f"{name!r}: found {len(found)} in {sorted(self.boxes())}"
            time.sleep(LOOK)

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
            assert self.process.poll() is None, self.log.read_text()
            assert time.monotonic() < end, f"{name!r} is still there"
            time.sleep(LOOK)

    def do(self, *words: object) -> None:
        """xdotool's words, which the program has taken then; moves alone, and keys that are repeated or delayed, it has
        taken when it has taken what follows."""
        told = [str(word) for word in words]
        self._hear()
        self._sent = before = list(map(max, self._sent, self._took))
        for n, (word, what) in enumerate(itertools.pairwise(told)):
            if word.startswith("mousemove"):
                self._goal = ",".join(told[n + 1 : n + 3]) if word == "mousemove" else ""
            elif word in PRESSES and not what.startswith("--"):
                self._send(word, what)
        subprocess.run(["xdotool", *told], check=True, env={**os.environ, "DISPLAY": self.display}, timeout=PATIENCE)
        self._again = time.monotonic() + 1.0
        if self._sent != before:
            self.taken()

    def _send(self, word: str, what: str) -> None:
        """Counts what the program hears: nothing of a button that is pressed already, or let go."""
        keys, presses = self._sent
        if word in ("key", "keydown", "keyup"):
            keys += (1 + (word == "key")) * len(what.split("+"))
        elif word == "click":
            presses += 1 if what in WHEEL else 2
        elif (word == "mousedown") is not (what in self._down):
            presses += 1
            self._down ^= {what}
        self._sent = [keys, presses]

    def keys(self, *chords: str) -> None:
        """Presses keys, each when the program has taken the one before."""
        for chord in chords:
            self.do("key", chord)

    def type(self, text: str) -> None:
        """Types into the field that has the focus, as soon as one has, until it stands there: of what comes all at once
        on a busy machine, a key that is the same as the one before may be lost."""
        self.wait_until(self.typing, "no field takes what is typed")
        self.do("type", "--delay", "20", text)
        if not self._comes_to_stand(lambda stands: stands.endswith(text)):
            self.fill(text)

    def _comes_to_stand(self, good: Callable[[str], bool]) -> bool:
        """Whether what is typed becomes good in the field that has the focus, before it stays as it is for a while."""
        stands, soon = "", time.monotonic() + STANDS
        while time.monotonic() < soon:
            self._hear()
            now = json.loads(self._typed.removeprefix("on ")) if self._typed.startswith("on ") else ""
            if now is None or good(now):  # it is not told what stands in an editor
                return True
            if now != stands:
                stands, soon = now, time.monotonic() + STANDS
            time.sleep(LOOK)
        return False

    def fill(self, text: str) -> None:
        """Types into the field that has the focus, instead of what is in it; again until that stands there: a key
        may be lost on a busy machine, where a long name takes many seconds to come in."""
        end = time.monotonic() + PATIENCE
        while True:
            self.wait_until(self.typing, "no field takes what is typed")
            self.keys("ctrl+a")
            self.do("type", "--delay", "20", text)
            if self._comes_to_stand(lambda stands: stands == text):
                return
            assert time.monotonic() < end, f"{text!r} does not stand there: {self.log.read_text()[-2000:]}"

    def typing(self) -> bool:
        """Whether the log told last that a text field has the focus."""
        self._hear()
        return self._typed.startswith("on ")

    def wait_until(self, so: Callable[[], bool], otherwise: str, seconds: float = PATIENCE) -> None:
        """Waits until something is so, while the program runs."""
        end = time.monotonic() + seconds
        while not so():
            assert self.process.poll() is None, self.log.read_text()
            assert time.monotonic() < end, f"{otherwise}: {self.log.read_text()[-2000:]}"
            time.sleep(LOOK)

    def stroke(self, *points: tuple[int, int]) -> None:
        """The left button drawn through screen points, and all of it taken."""
        self.move_to(points[0])
        self.do("mousedown", 1)
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
        self.move_to(end)

    def wheel(self, notches: int) -> None:
        """So many notches, taken."""
        self.do("click", "--repeat", abs(notches), "--delay", 15, 4 if notches > 0 else 5)
        self._sent[1] += abs(notches)
        self.taken()

    def screen(self) -> np.ndarray:
        """What the screen shows, uint8 (800, 1280, 3)."""
        return np.asarray(ImageGrab.grab(xdisplay=self.display).convert("RGB"))

    def settled(self, seconds: float = PATIENCE) -> np.ndarray:
        """The screen when the program is at rest, and shows what it has drawn: two looks at it are alike, and it has
        told of nothing between them."""
        end = time.monotonic() + seconds
        while True:
            if self.at_rest():
                changes, first = self._changes, self.screen()
                if np.array_equal(self.screen(), first) and self.at_rest() and self._changes == changes:
                    return first
            assert self.process.poll() is None, self.log.read_text()
            assert time.monotonic() < end, f"the screen does not come to rest: {self.log.read_text()[-2000:]}"
            time.sleep(LOOK)

    def canvas(self) -> np.ndarray:
        """The middle of the settled screen, with the pointer parked so that no cursor or tooltip covers it."""
        self.move_to(REST)
        return self.settled()[60:740, 270:970].astype(int)

    def comes_to(self, picture: np.ndarray, seconds: float = PATIENCE) -> bool:
        """Whether the canvas shows exactly this, at once or when slow work is done: kernels may still be compiled."""
        end = time.monotonic() + seconds
        while not np.array_equal(self.canvas(), picture):
            if time.monotonic() > end:
                return False
            time.sleep(0.2)
        return True

    def canvas_unlike(self, picture: np.ndarray, seconds: float = PATIENCE) -> np.ndarray:
        """The canvas when it shows something else than this and has come to rest: kernels may still be compiled."""
        end = time.monotonic() + seconds
        while np.array_equal(now := self.canvas(), picture):
            assert time.monotonic() < end, f"the canvas stays as it was: {self.log.read_text()[-2000:]}"
            time.sleep(0.2)
        return now

    def until(self, good: Callable[[np.ndarray], bool], pointer: Point = REST, seconds: float = PATIENCE) -> np.ndarray:
        """The settled screen, int (800, 1280, 3), once it is good, with the pointer there: kernels may be compiled."""
        end = time.monotonic() + seconds
        while not good(screen := self.parked(pointer)):
            assert time.monotonic() < end, f"not so within {seconds:g} s: {self.log.read_text()[-2000:]}"
            time.sleep(0.2)
        return screen

    def park(self) -> None:
        self.move_to(REST)

    def parked(self, pointer: Point = REST) -> np.ndarray:
        """The settled screen, int (800, 1280, 3), with the pointer there, so that no cursor or tooltip covers it."""
        self.move_to(pointer)
        return self.settled().astype(int)

    def click(self, at: str | Point, window: str = "") -> None:
        """A click on a control or on a point, as slow as a hand's, and taken: no second one on it is a double click."""
        point = self.at(at, window=window) if isinstance(at, str) else at
        self.move_to(point)
        before, when = self._clicked
        if math.dist(before, point) < 10:
            time.sleep(max(0.0, when + APART - time.monotonic()))
        self.do("mousedown", 1)
        self.do("mouseup", 1)
        self._clicked = point, time.monotonic()

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
        """Ends it; fails if it has told a fault."""
        words = self._ended()
        assert "Traceback (most recent call last)" not in words, words
        told = [line for line in words.splitlines() if line.startswith(TOLD)]
        assert not told, "\n".join(told)

    def close_excused(self) -> None:
        """Ends it, whatever faults it told: they were provoked, and one may be told again until it has ended."""
        self._ended()
        self.log.write_text("")

    def _ended(self) -> str:
        self.process.terminate()
        self.process.wait(90)
        return self.log.read_text(errors="replace")


class Stalled:
    """A program that stands still while things are done to it, and takes them afterwards."""

    def __init__(self, app: Program) -> None:
        self._app = app

    def __enter__(self) -> None:
        self._app.waits = False
        self._app.process.send_signal(signal.SIGSTOP)

    def __exit__(self, *_: object) -> None:
        self._app.process.send_signal(signal.SIGCONT)
        self._app.waits = True
