"""What kernels are compiled of: the modules that declare them, and those of the engine that these import, as constants
and inlined functions are part of a kernel.

Light on purpose: importing it loads no numba.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).resolve().parent
_IMPORTED = re.compile(r"^\s*from (engine[\w.]*) import ([^#\n(]+|\([^)]*\))", re.MULTILINE)
_DECLARES = (b"numba", b"from engine.numeric.kernel import", b"from engine.numeric.abreast import")


def of_all_kernels() -> set[Path]:
    """Returns the modules that any kernel is compiled of."""
    return read_by(path for path in PACKAGE.rglob("*.py") if any(word in source_of(path) for word in _DECLARES))


def read_by(paths: Iterable[Path]) -> set[Path]:
    """Returns some modules and all that they import, from one to the next."""
    seen: set[Path] = set()
    for path in paths:
        _gather(path, seen)
    return seen


def _gather(path: Path, seen: set[Path]) -> None:
    if path not in seen:
        seen.add(path)
        for other in _imported(path):
            _gather(other, seen)


@cache
def _imported(path: Path) -> tuple[Path, ...]:
    """Returns the modules of the engine that one imports."""
    found = []
    for module, names in _IMPORTED.findall(source_of(path).decode()):
        whole = PACKAGE.joinpath(*module.split(".")[1:])
        listed = [name.split()[0] for name in names.strip("()").split(",") if name.split()]
        files = (target.with_suffix(".py") for target in (whole, *(whole / name for name in listed)))
        found += [file for file in files if file.is_file()]
    return tuple(found)


@cache
def source_of(path: Path) -> bytes:
    """Reads a module's text."""
    return path.read_bytes()
