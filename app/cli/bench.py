"""Run the benchmarks: each row has a figure and its ratio to a bound measured in the same run."""

from __future__ import annotations

import argparse
import importlib
import sys
from pathlib import Path
from types import ModuleType

from app.cli.outcome import Failed

TESTS = Path(__file__).resolve().parents[2] / "tests"


def declare(parser: argparse.ArgumentParser) -> None:
    """Declares the command's arguments."""
    _command().declare(parser)


def run(options: argparse.Namespace) -> int:
    """Carries the command out; returns the exit status."""
    status: int = _command().run(options)
    return status


def _command() -> ModuleType:
    """Returns the module that runs the benchmarks; an installed program has none and says so."""
    if not (TESTS / "bench" / "command.py").is_file():
        raise Failed("bench: benchmarks come with the source: run `python -m app bench` in its folder")
    if str(TESTS) not in sys.path:
        sys.path.insert(0, str(TESTS))
    return importlib.import_module("bench.command")
