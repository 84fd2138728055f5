"""Levels by pages hold what a map holds, wherever their pages lie."""

import itertools
from dataclasses import dataclass

import pytest
from hypothesis import given
from hypothesis import strategies as st
from immutables import Map

from engine.canvas.rising.paged_level import PagedLevel, bit_of

PLACES = st.tuples(st.integers(-12, 12), st.integers(-9, 9) | st.just(1 << 70))
EDITS = st.lists(st.tuples(PLACES, st.integers(0, 3)), max_size=12)


@dataclass
class Elsewhere:
    """Records of a page that somebody else keeps."""

    kept: dict

    @property
    def bits(self):
        return sum(map(bit_of, self.kept))

    @property
    def inks(self):
        return ()

    def records(self):
        return self.kept


def put_away(level, number):
    """As paging does it, of some pages, leaving one of their records where it is."""
    for page in list(level.pages.values())[number::2]:
        changed = page.held[1]
        records = dict(page.items())
        left = {at: record for at, record in changed.items() if record == 1}
        page.put_away(Elsewhere({at: record for at, record in records.items() if at not in left}), Map(left))


@given(st.dictionaries(PLACES, st.integers(1, 3)), st.lists(st.tuples(EDITS, st.integers(0, 1)), max_size=4))
def test_a_level_by_pages_holds_what_a_map_holds(given_records, rounds):
    plain, paged = Map(given_records), PagedLevel.of(given_records)
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
    for plain, paged in states:  # older states share pages that were put away
        assert dict(paged.items()) == dict(plain.items())
        assert set(paged) == set(plain)
        assert len(paged) == len(plain)
        assert [item for part in paged.columns() for item in sorted(part)] == sorted(plain.items())
        pages = [[place[1] >> 3 for place, _ in part] for part in paged.rows()]
        assert sorted(itertools.chain(*paged.rows())) == sorted(plain.items())
        assert [row[0] for row in pages] == sorted({number for row in pages for number in row})
        assert sorted(paged.values()) == sorted(plain.values())
        assert all(place in paged and paged[place] == paged.get(place) == plain[place] for place in plain)
        assert paged == PagedLevel.of(plain)


@given(st.dictionaries(PLACES, st.integers(1, 3), min_size=1), PLACES)
def test_what_is_not_there_is_missing_as_in_a_map(records, place):
    level = PagedLevel.of(records)
    put_away(level, 0)
    if place in records:
        less = level.delete(place)
        assert dict(less.items()) == {at: record for at, record in records.items() if at != place}
        assert all(next(page.places(at), None) is not None for at, page in less.pages.items())
        return
    assert place not in level
    assert level.get(place) is None
    for missing in (level.delete, level.__getitem__):
        with pytest.raises(KeyError):
            missing(place)
