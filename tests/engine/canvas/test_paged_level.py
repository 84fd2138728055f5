"""Levels by pages hold what a map holds, wherever their pages lie."""

import itertools
from dataclasses import dataclass
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from immutables import Map

from engine.canvas.rising import page_lines, page_sizes, paged_level
from engine.canvas.rising.page_places import LEAST_SIDE, NearPlaces, bit_of, page_of, places_in
from engine.canvas.rising.page_sizes import key_for
from engine.canvas.rising.paged_level import Page, PagedLevel, shared
from engine.numeric.address import Rect

FAR = st.sampled_from([-(1 << 40), -(1 << 31), -200, 4000, 1 << 31, 1 << 70])
PLACES = st.tuples(st.integers(-12, 12), st.integers(-9, 9) | FAR) | st.tuples(FAR, FAR)
EDITS = st.lists(st.tuples(PLACES, st.integers(0, 3)), max_size=12)
SIZES = st.sampled_from([(64, 32), (3, 2)])  # records of a page that is full, and of one that was split


@dataclass
class Elsewhere:
    """Records of a page that somebody else keeps."""

    kept: dict
    where: Any

    @property
    def inks(self):
        return ()

    def records(self):
        return self.kept


def put_away(level, number):
    """As paging does it, of some pages, leaving one of their records where it is."""
    for key, page in list(level.pages.items())[number::2]:
        changed = page.held[1]
        records = dict(page.items())
        left = {at: record for at, record in changed.items() if record == 1}
        gone = {at: record for at, record in records.items() if at not in left}
        page.put_away(Elsewhere(gone, places_in(key, gone)), Map(left))


def filed(records):
    """As a file has them: all by pages of 8 x 8 tiles."""
    pages = {}
    for place, record in records.items():
        pages.setdefault((*page_of(place), LEAST_SIDE), {})[place] = record
    return PagedLevel(Map({at: Page(None, Map(some)) for at, some in pages.items()}), None, len(records))


@pytest.mark.parametrize("laid", [PagedLevel.of, filed])
@given(
    given_records=st.dictionaries(PLACES, st.integers(1, 3)),
    rounds=st.lists(st.tuples(EDITS, st.integers(0, 1)), max_size=4),
    sizes=SIZES,
    lines=st.sampled_from([1, 4096]),
)
def test_a_level_by_pages_holds_what_a_map_holds(laid, given_records, rounds, sizes, lines):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(paged_level, "PAGE_FULL", sizes[0])
        patch.setattr(page_sizes, "_FILLED", sizes[1])
        patch.setattr(page_lines, "_AT_ONCE", lines)
        hold_alike(laid(given_records), Map(given_records), rounds)


def hold_alike(paged, plain, rounds):
    """Asserts that both hold the same after some edits."""
    states = [(plain, paged)]
    for edits, number in rounds:
        one, other = plain.mutate(), paged.mutate()
        for place, record in edits:
            if record:
                one[place] = other[place] = record
            else:
                one.pop(place, None)
                other.pop(place, None)
        plain, paged = one.finish(), other.finish()
        states.append((plain, paged))
        put_away(paged, number)
    for (plain, paged), (other, beside) in itertools.pairwise(states):
        alike = [place for place in {*plain, *other, (5, 5)} if shared(paged, beside, place)]
        assert all(plain.get(place) == other.get(place) for place in alike)
        assert all(shared(paged, paged, place) for place in plain)
    for plain, paged in states:  # older states share pages that were put away
        assert dict(paged.items()) == dict(plain.items())
        assert set(paged) == set(plain)
        assert len(paged) == len(plain)
        assert [item for part in paged.lines(0) for item in sorted(part)] == sorted(plain.items())
        pages = [[place[1] >> 3 for place, _ in part] for part in paged.lines(1)]
        assert sorted(itertools.chain(*paged.lines(1))) == sorted(plain.items())
        assert [number for row in pages for number in sorted(set(row))] == sorted({n for row in pages for n in row})
        assert sorted(paged.values()) == sorted(plain.values())
        assert all(place in paged and paged[place] == paged.get(place) == plain[place] for place in plain)
        assert paged == PagedLevel.of(plain)
        assert all(
            key_for(place, paged.pages, paged.split) == key
            for key, page in paged.pages.items()
            for place in page.places()
        )
        for rect in (Rect(-3, -5, 9, 6), Rect(-(1 << 41), -300, 1 << 32, 5000), Rect(0, 0, 0, 0)):
            inside = [(x, y) for x, y in plain if rect.x0 <= x < rect.x1 and rect.y0 <= y < rect.y1]
            assert sorted(paged.within(rect)) == sorted(inside)


def test_pages_are_the_wider_the_farther_apart_their_records_lie():
    dense, sparse = {(x, y): 1 for x in range(64) for y in range(64)}, {(x << 20, x << 25): 1 for x in range(-500, 500)}
    level = PagedLevel.of(dense | sparse)
    assert sum(side == LEAST_SIDE for _, _, side in level.pages) >= 64
    assert len(level.pages) < 64 + 150
    editor = level.mutate()
    for place in itertools.product(range(1 << 22, (1 << 22) + 16), range(16)):
        editor[place] = 2
    assert len(editor.finish().pages) <= len(level.pages) + 12
    assert set(NearPlaces((0, 0), bit_of((3, 4)))) == {(3, 4)}


@given(st.dictionaries(PLACES, st.integers(1, 3), min_size=1), PLACES)
def test_what_is_not_there_is_missing_as_in_a_map(records, place):
    level = PagedLevel.of(records)
    put_away(level, 0)
    if place in records:
        less = level.delete(place)
        assert dict(less.items()) == {at: record for at, record in records.items() if at != place}
        assert all(next(page.places(), None) is not None for page in less.pages.values())
        return
    assert place not in level
    assert level.get(place) is None
    for missing in (level.delete, level.__getitem__):
        with pytest.raises(KeyError):
            missing(place)
