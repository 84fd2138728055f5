"""Run the benchmarks: each row has a figure and its ratio to a bound measured in the same run."""

from __future__ import annotations

import argparse
import importlib
import json
from collections.abc import Iterator
from dataclasses import asdict

from app.bench import BENCHES, Figure
from app.cli.outcome import DONE, Refused
from app.cli.progress import Progress


def declare(parser: argparse.ArgumentParser) -> None:
    listed = "; ".join(f"{name}: {about}" for name, about in BENCHES.items())
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"which (default: all).  {listed}")
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def run(options: argparse.Namespace) -> int:
    for name in options.names:
        if name not in BENCHES:
            raise Refused(f"bench: found {name!r}, expected any of {', '.join(BENCHES)}")
    figures = []
    for figure in measured(options.names or list(BENCHES)):
        figures.append(figure)
        if not options.json:
            print(_line(figure), flush=True)
    if options.json:
        print(json.dumps({"figures": [{**asdict(figure), "within": figure.within} for figure in figures]}))
    return DONE


def measured(names: list[str]) -> Iterator[Figure]:
    with Progress("measuring", len(names)) as tell:
        for i, name in enumerate(names):
            tell(i)
            yield from importlib.import_module(f"app.bench.{name}").measure()


def _line(figure: Figure) -> str:
    sign = ">=" if figure.more_is_better else "<="
    mark = "ok" if figure.within else "MISSED"
    return (
        f"{figure.name:<28} {figure.value:>12,.4g} {figure.unit:<10} {figure.ratio:>8.2f} x {figure.bound} "
        f"(bound {sign} {figure.limit:g})  {mark}"
    )
