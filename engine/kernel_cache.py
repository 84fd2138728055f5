"""The cache of compiled kernels: a file for each kernel and signature, in the place of numba's own files.

numba keeps an index and numbered files for each function.  Two processes that compile at once can mix these up, and a
damaged file raises whatever pickle does.  Here a file's name tells all that its content depends on, so there is no
index; a file begins with the hash of the rest, and one that is damaged counts as missing; a folder that cannot be
written to is done without.  numba loads this module by the name in NUMBA_CACHE_LOCATOR_CLASSES, which
`engine/__init__` sets, as the first kernel is declared.

What counts references for kernels is kept as well: numba compiles it at every start, which brings 20 MB of LLVM into
memory.

A thread may forbid itself to compile (`refusing`): a kernel that is not in the cache then raises NotCompiled.
"""

from __future__ import annotations

import hashlib
import os
import pickle
import re
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import llvmlite
import numba
from numba.core import caching
from numba.core.runtime import nrtdynmod
from numba.core.serialize import dumps

ENDING = ".kernel"
_DIGEST = 32  # bytes of a hash at the head of a file
_PACKAGE = Path(__file__).resolve().parent
_IMPORTED = re.compile(r"^\s*from (engine[\w.]*) import ([^#\n(]+|\([^)]*\))", re.MULTILINE)


class NotCompiled(Exception):
    """A kernel is not in the cache, and this thread may not compile it.  `name`: of its file."""

    def __init__(self, name: str) -> None:
        super().__init__(f"kernel {name}: found no compiled code, expected it in the cache")
        self.name = name


@dataclass(slots=True)
class Watch:
    """What a thread wants to know of the kernels that it calls.

    `missing`: called with the name of a kernel's file before it is compiled, unless that is for the sake of another
    kernel that is; what it raises goes to the caller of the kernel.  `saved`: called when it is in the cache.
    """

    missing: Callable[[str], None]
    saved: Callable[[str], None] = lambda name: None


class _Local(threading.local):
    watch: Watch | None = None
    compiling = ""  # the name of the outermost kernel that the thread compiles


_local = _Local()


@contextmanager
def watched(watch: Watch | None) -> Iterator[None]:
    """Within it, `watch` is told of this thread's kernels."""
    before, _local.watch, _local.compiling = _local.watch, watch, ""
    try:
        yield
    finally:
        _local.watch = before


def _refuse(name: str) -> None:
    raise NotCompiled(name)


def refusing(whether: bool = True) -> Any:
    """Within it, this thread compiles nothing: NotCompiled where it would have to."""
    return watched(Watch(_refuse) if whether else None)


class KernelFile:
    """The compiled signatures of one function, each in a file of its own; numba's `IndexDataCacheFile` otherwise.

    Neither reading nor writing fails: what cannot be read is not there, what cannot be written is not kept.
    """

    def __init__(self, cache_path: str, filename_base: str, source_stamp: object) -> None:
        self._folder, self._base = Path(cache_path), filename_base
        self._stamp = f"{numba.__version__} {source_stamp!r}"

    def flush(self) -> None:
        """Takes all of the function's files away."""
        for path in self._folder.glob(f"{self._base}.*{ENDING}"):
            with suppress(OSError):
                path.unlink()

    def path(self, key: tuple[Any, ...]) -> Path:
        """Tells where the code for `key` is kept: signature, processor, and hashes of the function's code."""
        told = re.sub(r" at 0x[0-9a-fA-F]+", "", f"{self._stamp} {key!r}")
        return self._folder / f"{self._base}.{hashlib.sha256(told.encode()).hexdigest()[:20]}{ENDING}"

    def load(self, key: tuple[Any, ...]) -> object | None:
        """Returns what was saved for `key`; None if there is nothing, or it is damaged."""
        path = self.path(key)
        found = _read(path)
        if found is None and _local.watch is not None and not _local.compiling:
            _local.watch.missing(path.name)
            _local.compiling = path.name
        return found

    def save(self, key: tuple[Any, ...], data: object) -> None:
        """Keeps `data` for `key`, in one step."""
        path = self.path(key)
        _keep(path, data)
        if _local.compiling == path.name:
            _local.compiling = ""
            if _local.watch is not None:
                _local.watch.saved(path.name)


def _read(path: Path) -> object | None:
    try:
        content = path.read_bytes()
    except OSError:
        return None
    if hashlib.sha256(content[_DIGEST:]).digest() != content[:_DIGEST]:
        with suppress(OSError):
            path.unlink()
        return None
    data: object = pickle.loads(content[_DIGEST:])
    return data


def _write(path: Path, content: bytes) -> None:
    beside = path.with_name(f"{path.name}.{os.getpid()}.{threading.get_ident()}.tmp")
    try:
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        beside.write_bytes(content)
        os.replace(beside, path)
    finally:
        beside.unlink(missing_ok=True)


class Locator(caching.UserProvidedCacheLocator):  # type: ignore[misc]
    """Where a kernel of the engine is kept, and what its code depends on: its module and those imported there."""

    def get_cache_path(self) -> str:
        """Tells the folder: that of a kernel of the engine is the same wherever the engine lies, as nothing of its code
        tells that."""
        folder = Path(self._py_file).resolve().parent
        if not folder.is_relative_to(_PACKAGE):
            return str(super().get_cache_path())
        return os.path.join(numba.config.CACHE_DIR, ".".join(("engine", *folder.relative_to(_PACKAGE).parts)))

    def ensure_cache_path(self) -> None:
        """Nothing: a folder that cannot be made is found out when a kernel is saved, and does no harm."""

    def get_source_stamp(self) -> str:
        """Gives what the text of a kernel's module, and all that it imports, hash to."""
        return stamp(Path(self._py_file))


@cache
def stamp(path: Path) -> str:
    """Returns a hash of a module's source and of those modules of the engine that it imports: their constants and
    inlined functions are part of its kernels."""
    seen: set[Path] = set()
    _gather(path.resolve(), seen)
    total = hashlib.sha256()
    for each in sorted(seen):
        total.update(_source(each))
    return total.hexdigest()[:20]


def _gather(path: Path, seen: set[Path]) -> None:
    if path not in seen:
        seen.add(path)
        for other in _imported(path):
            _gather(other, seen)


@cache
def _imported(path: Path) -> tuple[Path, ...]:
    """Returns the modules of the engine that one imports."""
    found: list[Path] = []
    for module, names in _IMPORTED.findall(_source(path).decode()):
        whole = _PACKAGE.joinpath(*module.split(".")[1:])
        listed = [name.split()[0] for name in names.strip("()").split(",") if name.split()]
        files = (target.with_suffix(".py") for target in (whole, *(whole / name for name in listed)))
        found += [file for file in files if file.is_file()]
    return tuple(found)


@cache
def _source(path: Path) -> bytes:
    return path.read_bytes()


def _runtime(context: Any) -> object:
    """Returns the library that counts references, from its file if there is one."""
    codegen = context.codegen()
    told = f"{numba.__version__} {llvmlite.__version__} {codegen.magic_tuple()!r} {numba.config.DEBUG_NRT}"
    path = Path(numba.config.CACHE_DIR) / f"references.{hashlib.sha256(told.encode()).hexdigest()[:20]}"
    found = _read(path)
    if found is not None:
        return codegen.unserialize_library(found)
    module, library = nrtdynmod.create_nrt_module(context)
    library.enable_object_caching()
    library.add_ir_module(module)
    library.finalize()
    _keep(path, library.serialize_using_object_code())
    return library


def _keep(path: Path, data: object) -> None:
    content = dumps(data)
    with suppress(OSError):
        _write(path, hashlib.sha256(content).digest() + content)


caching.IndexDataCacheFile = KernelFile
nrtdynmod.compile_nrt_functions = _runtime
