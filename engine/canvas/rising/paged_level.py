"""The records of a level where they are many: by pages of 8 x 8 tiles, each of which may be put away on disk.

All states of the history that have a page share it, so that what is put away of one is put away of all.  A state that
changes a tile holds the page's older records, wherever they lie, and the changed one beside them.
"""

from __future__ import annotations

from collections.abc import ItemsView, Iterable, Iterator, Mapping
from typing import Generic, NamedTuple, Protocol, TypeVar

import immutables

from engine.texture.record import Instance

TilePlace = tuple[int, int]  # column and row of a tile, or of a page
R = TypeVar("R")
T_co = TypeVar("T_co", covariant=True)

MANY = 4096  # records from which on a level has pages
_PAGE_SIDE = 3  # a page is 8 tiles along, as a power of two
_IN_PAGE = (1 << _PAGE_SIDE) - 1
_UNTOLD = object()


class PutAwayPage(Protocol[T_co]):
    """Records of one page that are not in memory.  `bits`: where they lie in it (`bit_of`)."""

    @property
    def bits(self) -> int:
        """Tells where they lie."""
        ...

    @property
    def inks(self) -> Iterable[tuple[Instance, ...]]:
        """Gives the stacks of inks that they have."""
        ...

    def records(self) -> Mapping[TilePlace, T_co]:
        """Returns them; they are read, if they were not of late."""
        ...


class Page(Generic[R]):
    """Some records of one page: those `away`, and what has been changed since, None where one was taken away.

    A value; other threads may read it while it is put away.
    """

    __slots__ = ("held",)

    def __init__(self, away: PutAwayPage[R] | None, changed: immutables.Map[TilePlace, R | None]) -> None:
        self.held = away, changed

    def get(self, place: TilePlace) -> R | None:
        """Returns the record of a tile; None if it has none."""
        away, changed = self.held
        found = changed.get(place, _UNTOLD)
        if found is not _UNTOLD:
            return found  # type: ignore[return-value]
        return away.records().get(place) if away is not None and away.bits & bit_of(place) else None

    def has(self, place: TilePlace) -> bool:
        """Tells whether a tile has a record."""
        away, changed = self.held
        found = changed.get(place, _UNTOLD)
        if found is not _UNTOLD:
            return found is not None
        return away is not None and away.bits & bit_of(place) != 0

    def items(self) -> Iterator[tuple[TilePlace, R]]:
        """Yields all records with their places."""
        away, changed = self.held
        if away is not None:
            yield from ((place, record) for place, record in away.records().items() if place not in changed)
        yield from ((place, record) for place, record in changed.items() if record is not None)

    def places(self, page: TilePlace) -> Iterator[TilePlace]:
        """Yields the places of all records of the page at a place."""
        away, changed = self.held
        bits = 0 if away is None else away.bits
        while bits:
            place = place_in(page, (bits & -bits).bit_length() - 1)
            bits &= bits - 1
            if place not in changed:
                yield place
        yield from (place for place, record in changed.items() if record is not None)

    def put_away(self, away: PutAwayPage[R], left: immutables.Map[TilePlace, R | None]) -> None:
        """Holds the same records elsewhere, but for those that are `left`."""
        self.held = away, left


class PagedLevel(Mapping[TilePlace, R]):
    """The records of a level by their places, as an `immutables.Map` has them.  `pages`: by their places."""

    __slots__ = ("_count", "pages")

    def __init__(self, pages: immutables.Map[TilePlace, Page[R]], count: int) -> None:
        self.pages, self._count = pages, count

    @classmethod
    def of(cls, stored: Mapping[TilePlace, R]) -> PagedLevel[R]:
        """Lays out all records in pages."""
        found: dict[TilePlace, dict[TilePlace, R | None]] = {}
        for place, record in stored.items():
            found.setdefault(page_of(place), {})[place] = record
        pages = {at: Page(None, immutables.Map(records)) for at, records in found.items()}
        return cls(immutables.Map(pages), len(stored))

    def get(self, place: TilePlace, default: R | None = None) -> R | None:  # type: ignore[override]
        """Returns the record of a tile."""
        page = self.pages.get((place[0] >> _PAGE_SIDE, place[1] >> _PAGE_SIDE))
        found = page.get(place) if page is not None else None
        return default if found is None else found

    def __getitem__(self, place: TilePlace) -> R:
        found = self.get(place)
        if found is None:
            raise KeyError(place)
        return found

    def __contains__(self, place: object) -> bool:
        page = self.pages.get(page_of(place))  # type: ignore[arg-type]
        return page is not None and page.has(place)  # type: ignore[arg-type]

    def __iter__(self) -> Iterator[TilePlace]:
        for at, page in self.pages.items():
            yield from page.places(at)

    def __len__(self) -> int:
        return self._count

    def __eq__(self, other: object) -> bool:
        if isinstance(other, PagedLevel) and self.pages == other.pages:
            return True
        return Mapping.__eq__(self, other)

    __hash__ = None  # type: ignore[assignment]

    def items(self) -> ItemsView[TilePlace, R]:
        """Gives all records with their places."""
        return _Items(self)

    def rows(self) -> Iterator[list[tuple[TilePlace, R]]]:
        """Yields all records with their places, those of a row of pages together, from the top."""
        return self._in_lines(1)

    def columns(self) -> Iterator[list[tuple[TilePlace, R]]]:
        """Yields all records with their places, those of a column of pages together, from the left."""
        return self._in_lines(0)

    def _in_lines(self, axis: int) -> Iterator[list[tuple[TilePlace, R]]]:
        lines: dict[int, list[Page[R]]] = {}
        for at, page in self.pages.items():
            lines.setdefault(at[axis], []).append(page)
        for number in sorted(lines):
            yield [item for page in lines[number] for item in page.items()]

    def here(self) -> Iterator[R]:
        """Yields the records that are in memory."""
        for page in self.pages.values():
            yield from (record for record in page.held[1].values() if record is not None)

    def delete(self, place: TilePlace) -> PagedLevel[R]:
        """Returns the level without the record of a tile; KeyError if it has none."""
        editable = self.mutate()
        del editable[place]
        return editable.finish()

    def mutate(self) -> PageEditor[R]:
        """Returns what makes another state of the level."""
        return PageEditor(self)


class _Items(ItemsView[TilePlace, R]):
    """Reads page by page."""

    def __init__(self, level: PagedLevel[R]) -> None:
        super().__init__(level)
        self._pages = level.pages

    def __iter__(self) -> Iterator[tuple[TilePlace, R]]:
        for page in self._pages.values():
            yield from page.items()


class PageEditor(Generic[R]):
    """Makes another state of a level, as an `immutables.MapMutation` does."""

    def __init__(self, level: PagedLevel[R]) -> None:
        self._level, self._count = level, len(level)
        self._changed: dict[TilePlace, _Changed[R]] = {}

    def set(self, place: TilePlace, record: R) -> None:
        """Gives a tile a record."""
        page = self._page(place)
        self._count += not page.has(place)
        page.changed[place] = record

    __setitem__ = set

    def pop(self, place: TilePlace, *default: None) -> None:
        """Takes the record of a tile away; KeyError if it has none, and no default is given."""
        page = self._page(place)
        if not page.has(place):
            if not default:
                raise KeyError(place)
            return
        self._count -= 1
        if page.is_away(place):
            page.changed[place] = None
        else:
            del page.changed[place]

    def __delitem__(self, place: TilePlace) -> None:
        self.pop(place)

    def finish(self) -> PagedLevel[R]:
        """Returns the other state."""
        pages = self._level.pages.mutate()
        for at, changed in self._changed.items():
            page = Page(changed.away, changed.changed.finish())
            if next(page.places(at), None) is not None:
                pages[at] = page
            else:
                pages.pop(at, None)
        return PagedLevel(pages.finish(), self._count)

    def _page(self, place: TilePlace) -> _Changed[R]:
        """Returns the page of a tile as it is by now."""
        at = page_of(place)
        found = self._changed.get(at)
        if found is None:
            page = self._level.pages.get(at)
            away, changed = (None, immutables.Map()) if page is None else page.held
            found = self._changed[at] = _Changed(away, changed.mutate())
        return found


class _Changed(NamedTuple, Generic[R]):
    """A page that is being changed."""

    away: PutAwayPage[R] | None
    changed: immutables.MapMutation[TilePlace, R | None]

    def is_away(self, place: TilePlace) -> bool:
        """Tells whether a tile has a record that is not in memory."""
        return self.away is not None and self.away.bits & bit_of(place) != 0

    def has(self, place: TilePlace) -> bool:
        """Tells whether a tile has a record."""
        found = self.changed.get(place, _UNTOLD)
        return self.is_away(place) if found is _UNTOLD else found is not None


def page_of(place: TilePlace) -> TilePlace:
    """Returns the place of the page in which a tile lies."""
    return place[0] >> _PAGE_SIDE, place[1] >> _PAGE_SIDE


def place_in(page: TilePlace, number: int) -> TilePlace:
    """Returns the place of the tile whose bit has this number in the page at a place."""
    return (page[0] << _PAGE_SIDE) + (number & _IN_PAGE), (page[1] << _PAGE_SIDE) + (number >> _PAGE_SIDE)


def bit_of(place: TilePlace) -> int:
    """Returns the bit of a tile in its page."""
    return 1 << ((place[1] & _IN_PAGE) << _PAGE_SIDE | place[0] & _IN_PAGE)
