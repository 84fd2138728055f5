"""The records of a level where they are many: by pages, each of which may be put away on disk.

A page has 8 x 8 tiles, or more where they lie far apart (`page_sizes`).  All states of the history that have a page
share it, so that what is put away of one is put away of all.  A state that changes a tile holds the page's older
records, wherever they lie, and the changed one beside them.
"""

from __future__ import annotations

from collections.abc import ItemsView, Iterable, Iterator, Mapping
from typing import Generic, NamedTuple, Protocol, TypeVar

import immutables

from engine.canvas.rising.page_lines import in_lines
from engine.canvas.rising.page_places import LEAST_SIDE, PageKey, PagePlaces, TilePlace
from engine.canvas.rising.page_sizes import PAGE_FULL, by_pages, key_for, keys_met
from engine.numeric.address import Rect
from engine.texture.record import Instance

R = TypeVar("R")
T_co = TypeVar("T_co", covariant=True)

MANY = 4096  # records from which on a level has pages
_UNTOLD = object()


class PutAwayPage(Protocol[T_co]):
    """Records of one page that are not in memory."""

    @property
    def where(self) -> PagePlaces:
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
        return away.records().get(place) if away is not None and place in away.where else None

    def has(self, place: TilePlace) -> bool:
        """Tells whether a tile has a record."""
        away, changed = self.held
        found = changed.get(place, _UNTOLD)
        if found is not _UNTOLD:
            return found is not None
        return away is not None and place in away.where

    @property
    def most(self) -> int:
        """Counts the records, and those that were taken away."""
        away, changed = self.held
        return len(changed) + (0 if away is None else len(away.where))

    def items(self) -> Iterator[tuple[TilePlace, R]]:
        """Yields all records with their places."""
        away, changed = self.held
        if away is not None:
            yield from ((place, record) for place, record in away.records().items() if place not in changed)
        yield from ((place, record) for place, record in changed.items() if record is not None)

    def places(self) -> Iterator[TilePlace]:
        """Yields the places of all records."""
        away, changed = self.held
        if away is not None:
            yield from (place for place in away.where if place not in changed)
        yield from (place for place, record in changed.items() if record is not None)

    def put_away(self, away: PutAwayPage[R], left: immutables.Map[TilePlace, R | None]) -> None:
        """Holds the same records elsewhere, but for those that are `left`."""
        self.held = away, left


class PagedLevel(Mapping[TilePlace, R]):
    """The records of a level by their places, as an `immutables.Map` has them.  `split`: pages that have smaller ones
    in their place; None where all are of 8 x 8 tiles."""

    __slots__ = ("_count", "pages", "split")

    def __init__(
        self,
        pages: immutables.Map[PageKey, Page[R]],
        split: immutables.Map[PageKey, None] | None,
        count: int,
    ) -> None:
        self.pages, self.split, self._count = pages, split, count

    @classmethod
    def of(cls, stored: Mapping[TilePlace, R]) -> PagedLevel[R]:
        """Lays out all records in pages."""
        found, split = by_pages(stored, None)
        pages = {at: Page[R](None, immutables.Map(records)) for at, records in found.items()}
        return cls(immutables.Map(pages), immutables.Map(dict.fromkeys(split)), len(stored))

    def page_at(self, place: TilePlace) -> Page[R] | None:
        """Returns the page in which a tile lies; None where that has no record."""
        return self.pages.get(key_for(place, self.pages, self.split))

    def get(self, place: TilePlace, default: R | None = None) -> R | None:  # type: ignore[override]
        """Returns the record of a tile."""
        page = self.page_at(place)
        found = page.get(place) if page is not None else None
        return default if found is None else found

    def __getitem__(self, place: TilePlace) -> R:
        found = self.get(place)
        if found is None:
            raise KeyError(place)
        return found

    def __contains__(self, place: object) -> bool:
        page = self.page_at(place)  # type: ignore[arg-type]
        return page is not None and page.has(place)  # type: ignore[arg-type]

    def __iter__(self) -> Iterator[TilePlace]:
        for page in self.pages.values():
            yield from page.places()

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

    def lines(self, axis: int) -> Iterator[list[tuple[TilePlace, R]]]:
        """Yields all records with their places, those of a column of 8 tiles together from the left (axis 0), or those
        of a row from the top (1)."""
        return in_lines(self.pages, axis)

    def within(self, places: Rect) -> Iterator[TilePlace]:
        """Yields the places of records that lie in a rectangle of places."""
        x0, y0, x1, y1 = places
        for key in keys_met(self.pages, self.split, places):
            yield from ((x, y) for x, y in self.pages[key].places() if x0 <= x < x1 and y0 <= y < y1)

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


def shared(one: Mapping[TilePlace, R], other: Mapping[TilePlace, R], place: TilePlace) -> bool:
    """Tells whether two levels have one record at a place, or none, as far as that is told without reading any."""
    if not (isinstance(one, PagedLevel) and isinstance(other, PagedLevel)):
        return False
    page, beside = one.page_at(place), other.page_at(place)
    if page is beside or page is None or beside is None:
        return page is beside
    (away, changed), (there, altered) = page.held, beside.held
    return away is there and place not in changed and place not in altered


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
        self._changed: dict[PageKey, _Changed[R]] = {}

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
        level = self._level
        pages, split = level.pages.mutate(), level.split
        for at, changed in self._changed.items():
            page = Page(changed.away, changed.changed.finish())
            if page.most > PAGE_FULL and at[2] > LEAST_SIDE and split is not None:
                found, marks = by_pages(dict(page.items()), at)
                pages.pop(at, None)
                pages.update({key: Page(None, immutables.Map(records)) for key, records in found.items() if records})
                split = split.update(dict.fromkeys(marks))
            elif next(page.places(), None) is not None:
                pages[at] = page
            else:
                pages.pop(at, None)
        return PagedLevel(pages.finish(), split, self._count)

    def _page(self, place: TilePlace) -> _Changed[R]:
        """Returns the page of a tile as it is by now."""
        at = key_for(place, self._level.pages, self._level.split)
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
        return self.away is not None and place in self.away.where

    def has(self, place: TilePlace) -> bool:
        """Tells whether a tile has a record."""
        found = self.changed.get(place, _UNTOLD)
        return self.is_away(place) if found is _UNTOLD else found is not None
