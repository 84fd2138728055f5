"""All records of a level by pages, line by line of 8 tiles: as files have them, and so that few are in memory."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import groupby
from operator import itemgetter
from typing import Protocol, TypeVar

from engine.canvas.rising.page_places import LEAST_SIDE, PageKey, TilePlace

_AT_ONCE = 4096  # records of wide pages that are gone through together, at least
T_co = TypeVar("T_co", covariant=True)
Line = list[tuple[TilePlace, T_co]]


class _Page(Protocol[T_co]):
    """Records of a page."""

    def items(self) -> Iterator[tuple[TilePlace, T_co]]:
        """Yields them with their places."""
        ...

    def places(self) -> Iterator[TilePlace]:
        """Yields their places alone."""
        ...


def in_lines(pages: Mapping[PageKey, _Page[T_co]], axis: int) -> Iterator[Line[T_co]]:
    """Yields all records with their places, those of a line together, or of some lines one beside the other; `axis`: 0
    for columns, 1 for rows."""
    if any(side > LEAST_SIDE for _, _, side in pages):
        yield from _in_wide_lines(pages, axis)
        return
    lines: dict[int, list[_Page[T_co]]] = {}
    for at, page in pages.items():
        lines.setdefault(at[axis], []).append(page)
    for number in sorted(lines):
        yield [item for page in lines[number] for item in page.items()]


def _in_wide_lines(pages: Mapping[PageKey, _Page[T_co]], axis: int) -> Iterator[Line[T_co]]:
    """Yields lines together where they have few records, as each page that they meet is read for it."""
    placed = ((place[axis] >> LEAST_SIDE, place, page) for page in pages.values() for place in page.places())
    some: list[tuple[TilePlace, _Page[T_co]]] = []
    for _, line in groupby(sorted(placed, key=itemgetter(0)), key=itemgetter(0)):
        some += ((place, page) for _, place, page in line)
        if len(some) >= _AT_ONCE:
            yield _of_places(some)
            some = []
    if some:
        yield _of_places(some)


def _of_places(found: Iterable[tuple[TilePlace, _Page[T_co]]]) -> Line[T_co]:
    """Returns records with their places, page by page."""
    by_page: dict[_Page[T_co], set[TilePlace]] = {}
    for place, page in found:
        by_page.setdefault(page, set()).add(place)
    return [item for page, wanted in by_page.items() for item in page.items() if item[0] in wanted]
