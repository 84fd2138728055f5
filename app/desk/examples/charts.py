"""Maps of examples: which way one runs, how wide its rim is, and others that its parameter file names."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from immutables import Map

Chart = Map[str, object]  # of one map, as a definition tells it


def absolute(maps: Mapping[str, object], folder: Path) -> Map[str, object]:
    """Returns maps whose pictures have absolute paths."""
    return Map({name: _absolute(chart_of(told), folder) for name, told in maps.items()})


def chart_of(told: object) -> Chart:
    """Returns what is told of a map, as members."""
    if isinstance(told, str):
        return Map({"path": told})
    return told if isinstance(told, Map) else Map()


def _absolute(chart: Chart, folder: Path) -> Chart:
    path = chart.get("path")
    return chart.set("path", str(folder / path)) if isinstance(path, str) else chart
