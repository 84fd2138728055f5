"""A painting's files on the disk: what this window last saw of them, and which of them it has claimed.

One record goes with each painting that is open; its files are saved one at a time, on a writer's thread.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from engine.files.fault import FileError, system_words
from engine.keeping.claim import Claim, claim, turn
from engine.keeping.fingerprint import Fingerprint, fingerprint
from engine.keeping.preferences import Preferences
from engine.keeping.unfinished import unfinished
from engine.keeping.versions import keep_version


class Overtaken(Exception):
    """A file is not to be replaced without asking.  `elsewhere`: it is open in another window, too; else another
    program changed it."""

    def __init__(self, elsewhere: bool) -> None:
        super().__init__("open in another window" if elsewhere else "changed by another program")
        self.elsewhere = elsewhere


class Replacement:
    """A file that is to be replaced.  `missing`: it was there, and is no more; `linked`: it has other names (hard
    links), which keep what is replaced; `lost`: why its old version was not kept, "" if it was; `written`: what takes
    its place."""

    def __init__(self, target: Path, seen: Fingerprint | None, asks: bool, preferences: Preferences) -> None:
        self._target, self._seen, self._asks, self._preferences = target, seen, asks, preferences
        self.missing, self.linked, self.lost = False, False, ""
        self.written: Fingerprint | None = None
        self.stack = ExitStack()  # of what ends after it is in its place

    def compare(self) -> Fingerprint | None:
        """Returns what is there now; Overtaken if that is not what was seen last, where one `asks` about that."""
        there = fingerprint(self._target)
        self.missing = there is None and self._seen is not None
        same = there is None or (self._seen is not None and there.same_file(self._seen))
        if self._asks and not same:
            raise Overtaken(elsewhere=False)
        return there

    def ready(self, part: Path) -> None:
        """Compares once more, just before `part` takes the file's place, and keeps what is there as a version."""
        self.written = fingerprint(part)
        self.stack.enter_context(turn(self._target))
        there = self.compare()
        with suppress(OSError):
            self.linked = there is not None and os.stat(self._target).st_nlink > 1
        if there is None or self.written is None or there.same_bytes(self.written):
            return
        try:
            keep_version(self._target, self._preferences.versions)
        except FileError as error:
            self.lost = str(error)
        except OSError as error:
            self.lost = system_words(error)


class OnDisk:
    """What is known of one painting's files.  Its calls may come from any thread."""

    def __init__(self, preferences: Preferences) -> None:
        self._preferences = preferences
        self._lock = threading.Lock()
        self._targets: dict[Path, Path] = {}  # where paths led to: a link may lead somewhere else by now
        self._seen: dict[Path, Fingerprint] = {}  # by real paths, as what follows
        self._claims: dict[Path, Claim] = {}
        self._shared: set[Path] = set()  # open elsewhere, and the artist knows
        self._released = False

    def opened(self, path: Path, seen: Fingerprint | None) -> bool:
        """Takes over what a file was as it was opened; False if it is open in another window, too."""
        self._targets[path] = target = Path(os.path.realpath(path))
        if seen is not None:
            self._seen[target] = seen
        return self._claim(target)

    def release(self) -> None:
        """Gives up its files: the painting is not open any more."""
        with self._lock:
            self._released = True
            self._drop(set())

    @contextmanager
    def saving(self, path: Path, sure: bool) -> Iterator[Replacement]:
        """Within it a file is written, and `ready` of what it yields is called before that is put into its place.

        Overtaken if it is open elsewhere, or not what was seen of it last; never if the artist is `sure`.  Once it is
        written, it is the painting's only file.
        """
        target = Path(os.path.realpath(path))
        with self._lock:
            before = set(self._claims)
        if not self._claim(target) and target not in self._shared:
            if not sure:
                raise Overtaken(elsewhere=True)
            self._shared.add(target)
        asks = not sure and (path in self._targets or target in self._seen)  # else another name was chosen for it
        one = Replacement(target, self._seen.get(target), asks, self._preferences)
        stays = before
        try:
            with one.stack, unfinished(target):
                one.compare()
                yield one
                if one.written is not None:
                    self._targets[path], self._seen[target] = target, one.written
            stays = {target}
        finally:
            with self._lock:
                self._drop(set() if self._released else stays)

    def _claim(self, target: Path) -> bool:
        with self._lock:
            if target not in self._claims:
                one = claim(target)
                if one is None:
                    return False
                self._claims[target] = one
            return True

    def _drop(self, stays: set[Path]) -> None:
        for target in [target for target in self._claims if target not in stays]:
            self._claims.pop(target).release()
