"""The command `bench`: runs the benchmarks, prints and stores their rows."""

from __future__ import annotations

import argparse
import importlib
import json
import os
import platform
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any

from app.cli.outcome import DONE, FAILED, Failed, Refused
from app.cli.progress import Progress
from bench import BENCHES, Figure, Skipped
from bench.comparison import MOST, worsened


def declare(parser: argparse.ArgumentParser) -> None:
    listed = "; ".join(f"{name}: {about}" for name, about in BENCHES.items())
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"which (default: all).  {listed}")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    parser.add_argument("--store", metavar="FILE", help="write the rows into FILE; rows of others stay in it")
    parser.add_argument("--compare", metavar="FILE", help=f"fail where a ratio is {MOST} x as bad as in FILE")
    parser.add_argument("--small", action="store_true", help="the least work: shows that it runs, ratios mean nothing")


def run(options: argparse.Namespace) -> int:
    for name in options.names:
        if name not in BENCHES:
            raise Refused(f"bench: found {name!r}, expected any of {', '.join(BENCHES)}")
    stored = _held(Path(options.compare)) if options.compare is not None else {}
    names = options.names or list(BENCHES)
    rows: dict[str, list[Figure | Skipped]] = {name: [] for name in names}
    for name, row in measured(names, options.small):
        rows[name].append(row)
        if not options.json:
            print(_line(row), flush=True)
    told = {name: [_told(row) for row in found] for name, found in rows.items()}
    if options.json:
        print(json.dumps({"figures": [{"bench": name, **row} for name, found in told.items() for row in found]}))
    if options.store is not None:
        store(Path(options.store), told)
    worse = worsened(stored, told)
    if not options.json:
        print("".join(f"{line}\n" for line in worse), end="")
    return FAILED if worse else DONE


def measured(names: list[str], small: bool = False) -> Iterator[tuple[str, Figure | Skipped]]:
    with Progress("measuring", len(names)) as tell:
        for i, name in enumerate(names):
            tell(i)
            for row in importlib.import_module(f"bench.{name}").measure(small):
                yield name, row


def store(path: Path, told: dict[str, list[dict[str, Any]]]) -> None:
    """Puts the rows of the benchmarks that ran in place of those that the file has of them."""
    try:
        benches = {**(_held(path) if path.exists() else {}), **told}
        ordered = {name: benches[name] for name in BENCHES if name in benches}
        text = json.dumps({"machine": machine(), "benches": ordered}, indent=1, ensure_ascii=False)
        path.write_text(text + "\n", "utf-8")
    except OSError as error:
        raise Failed(f"{path}: cannot be written: {error.strerror}") from None


def _held(path: Path) -> dict[str, list[dict[str, object]]]:
    """Reads the rows that a file has, by benchmark."""
    try:
        held = json.loads(path.read_text("utf-8"))
    except ValueError as error:
        raise Refused(f"{path}: found no JSON ({error}), expected a file that bench wrote") from None
    except OSError as error:
        raise Refused(f"{path}: cannot be read: {error.strerror}") from None
    if not isinstance(held, dict) or not isinstance(held.get("benches", {}), dict):
        raise Refused(f"{path}: found another kind of file, expected one that bench wrote")
    benches: dict[str, list[dict[str, object]]] = held.get("benches", {})
    return benches


def machine() -> dict[str, object]:
    """What the figures depend on."""
    model = platform.processor() or platform.machine()
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        model = next(line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    return {
        "processor": model,
        "cores": os.cpu_count(),
        "python": platform.python_version(),
        "system": platform.system(),
    }


def _told(row: Figure | Skipped) -> dict[str, object]:
    if isinstance(row, Skipped):
        return {"name": row.name, "skipped": row.reason}
    rounded = {key: float(f"{value:.4g}") if isinstance(value, float) else value for key, value in asdict(row).items()}
    return {**rounded, "within": row.within}


def _line(row: Figure | Skipped) -> str:
    if isinstance(row, Skipped):
        return f"{row.name:<32} not measured: {row.reason}"
    sign = ">=" if row.more_is_better else "<="
    mark = "ok" if row.within else "MISSED"
    line = (
        f"{row.name:<32} {row.value:>10,.4g} {row.unit:<9} {row.ratio:>7.2f} x {row.bound} "
        f"(bound {sign} {row.limit:g})  {mark}"
    )
    return f"{line}\n{'':<32}   {row.note}" if row.note else line
