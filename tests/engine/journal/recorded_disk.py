"""What a program does to files below a folder, recorded, and every state in which a power cut may leave them.

The model is weak: what was written to a file since its last sync may be there or not, write by write, in any
combination, with zeros where it is not; what happened to the names in a folder since its last sync may have reached the
disk up to any point, or not at all.
"""

from __future__ import annotations

import itertools
import os
import random
import stat
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

MOST = 5  # writes of which all subsets are tried


@dataclass
class File:
    """`sure`: its bytes at the last sync; `since`: (offset, bytes) written after it."""

    sure: bytes = b""
    since: list[tuple[int, bytes]] = field(default_factory=list)

    @property
    def now(self) -> bytes:
        return laid(self.sure, self.since)


@dataclass
class Folder:
    """`sure`: what its names stood for at the last sync; `since`: changes (name, what or None) after it, in order;
    those of one step together."""

    sure: dict[str, File | Folder] = field(default_factory=dict)
    since: list[list[tuple[str, File | Folder | None]]] = field(default_factory=list)

    def at(self, count: int) -> dict[str, File | Folder]:
        """Its names after so many of the changes."""
        out = dict(self.sure)
        for step in self.since[:count]:
            for name, what in step:
                if what is None:
                    out.pop(name, None)
                else:
                    out[name] = what
        return out

    @property
    def now(self) -> dict[str, File | Folder]:
        return self.at(len(self.since))


def laid(sure: bytes, writes: list[tuple[int, bytes]]) -> bytes:
    """Bytes with writes over them, zeros where nothing is."""
    out = bytearray(sure)
    for at, data in writes:
        out.extend(bytes(max(0, at + len(data) - len(out))))
        out[at : at + len(data)] = data
    return bytes(out)


@dataclass
class Operation:
    """When, by the monotonic clock, and what: its name, the path, and more."""

    when: float
    what: str
    path: Path
    more: object = None


class Recorder:
    """Takes the place of the functions of `os` that change files; `operations` below `root`, in order, and when each
    sync ended, with the seconds that it took."""

    def __init__(self, root: Path, monkeypatch) -> None:
        self.syncs: list[tuple[float, float]] = []
        self.root, self.operations, self._files = root, list[Operation](), dict[int, Path]()
        self.real = {name: getattr(os, name) for name in ("open", "close", "write", "fsync", "fdatasync", "ftruncate")}
        self.real |= {name: getattr(os, name) for name in ("rename", "replace", "mkdir", "unlink", "rmdir")}
        for name in self.real:
            monkeypatch.setattr(os, name, getattr(self, f"_{name}"))

    def _note(self, what: str, path: object, more: object = None) -> None:
        place = Path(os.fsdecode(path))
        if place.is_relative_to(self.root):
            self.operations.append(Operation(time.monotonic(), what, place, more))

    def _open(self, path, flags, *more, **named):
        there = os.path.lexists(path)
        descriptor = self.real["open"](path, flags, *more, **named)
        self._files[descriptor] = Path(os.fsdecode(path))
        if flags & os.O_CREAT and not there:
            self._note("make", path)
        return descriptor

    def _close(self, descriptor):
        self._files.pop(descriptor, None)
        self.real["close"](descriptor)

    def _write(self, descriptor, data):
        count = self.real["write"](descriptor, data)
        if descriptor in self._files:
            self._note("write", self._files[descriptor], bytes(data[:count]))
        return count

    def _ftruncate(self, descriptor, size):
        raise AssertionError("nothing was torn")

    def _sync(self, real, descriptor):
        path = self._files.get(descriptor)
        folder = stat.S_ISDIR(os.fstat(descriptor).st_mode)
        held = None if path is None or folder else os.pread(descriptor, os.fstat(descriptor).st_size, 0)
        begun = time.monotonic()
        real(descriptor)
        self.syncs.append((time.monotonic(), time.monotonic() - begun))
        if path is not None:
            self._note("sync names" if folder else "sync", path, held)

    def _fsync(self, descriptor):
        self._sync(self.real["fsync"], descriptor)

    def _fdatasync(self, descriptor):
        self._sync(self.real["fdatasync"], descriptor)

    def _rename(self, old, new, **named):
        self.real["rename"](old, new, **named)
        self._note("move", old, Path(os.fsdecode(new)))

    def _replace(self, old, new, **named):
        self.real["replace"](old, new, **named)
        self._note("move", old, Path(os.fsdecode(new)))

    def _mkdir(self, path, *more, **named):
        self.real["mkdir"](path, *more, **named)
        self._note("mkdir", path)

    def _unlink(self, path, **named):
        self.real["unlink"](path, **named)
        if "dir_fd" not in named:
            self._note("unlink", path)

    def _rmdir(self, path, **named):
        self.real["rmdir"](path, **named)


class Disk:
    """What operations make of a disk, one after another."""

    def __init__(self, root: Path) -> None:
        self.root, self.top = root, Folder()
        self.renamed: dict[Path, Path] = {}

    def folder(self, path: Path) -> Folder:
        found = self.top
        for name in path.relative_to(self.root).parts:
            found = found.now[name]
        return found

    def take(self, one: Operation) -> None:
        """Lets an operation happen."""
        parent = None if one.path == self.root else self.folder(self.called(one.path.parent))
        name = one.path.name
        match one.what:
            case "make":
                parent.since.append([(name, File())])
            case "mkdir":
                parent.since.append([(name, Folder())])
            case "write":
                file = self.folder(self.called(one.path.parent)).now[name]
                file.since.append((len(file.now), one.more))
            case "sync":
                file = parent.now.get(name)
                if file is not None:
                    file.sure, file.since = one.more, []
            case "sync names":
                folder = self.folder(self.called(one.path))
                folder.sure, folder.since = folder.now, []
            case "move":
                what = parent.now[name]
                if isinstance(what, Folder):
                    self.renamed[one.path] = one.more
                assert one.more.parent == one.path.parent
                parent.since.append([(name, None), (one.more.name, what)])
            case "unlink":
                parent.since.append([(name, None)])

    def called(self, path: Path) -> Path:
        """The name that a path goes by, after folders were moved."""
        for old, new in self.renamed.items():
            if path.is_relative_to(old):
                path = new / path.relative_to(old)
        return path

    def states(self, told: random.Random, most: int) -> Iterator[dict[str, bytes]]:
        """Yields what a power cut may leave now: the files there are, by their paths below the root; at most so many,
        drawn from all."""
        folders = list(_folders(self.top))
        counts = list(itertools.product(*(range(len(folder.since) + 1) for folder in folders)))
        if len(counts) > most:
            counts = [counts[0], counts[-1], *told.sample(counts, most - 2)]
        for chosen in counts:
            tree = {id(folder): folder.at(count) for folder, count in zip(folders, chosen, strict=True)}
            files = dict(_files(self.top, tree, ""))
            choices = [list(_subsets(len(file.since), told)) for file in files.values()]
            for subset in _draws(choices, told, most):
                pairs = zip(files.items(), subset, strict=True)
                yield {name: laid(file.sure, [file.since[i] for i in kept]) for (name, file), kept in pairs}


def _folders(top: Folder) -> Iterator[Folder]:
    yield top
    for what in {id(w): w for w in [*top.sure.values(), *top.now.values()]}.values():
        if isinstance(what, Folder):
            yield from _folders(what)


def _files(top: Folder, tree: dict[int, dict[str, File | Folder]], before: str) -> Iterator[tuple[str, File]]:
    for name, what in tree.get(id(top), top.now).items():
        if isinstance(what, Folder):
            yield from _files(what, tree, f"{before}{name}/")
        else:
            yield before + name, what


def _subsets(count: int, told: random.Random) -> Iterator[tuple[int, ...]]:
    """Which of so many writes are there: all subsets of a few; of more, all beginnings, all but one, and some."""
    if count <= MOST:
        yield from itertools.chain.from_iterable(itertools.combinations(range(count), n) for n in range(count + 1))
        return
    for n in range(count + 1):
        yield tuple(range(n))
        yield tuple(i for i in range(count) if i != n)
    for _ in range(8):
        yield tuple(i for i in range(count) if told.random() < 0.5)


def _draws(
    choices: list[list[tuple[int, ...]]], told: random.Random, most: int
) -> Iterator[tuple[tuple[int, ...], ...]]:
    """All combinations, or so many of them."""
    total = 1
    for one in choices:
        total *= len(one)
    if total <= most:
        yield from itertools.product(*choices)
    else:
        for _ in range(most):
            yield tuple(told.choice(one) for one in choices)
