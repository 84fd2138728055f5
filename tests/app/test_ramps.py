"""Ramps of colour edited by hand."""

from itertools import pairwise

from hypothesis import given, settings
from hypothesis import strategies as st

from app.desk import ramps
from app.desk.colours import from_hex

PART = st.floats(0.0, 1.0, width=32)
GESTURE = st.tuples(st.sampled_from(["add", "move", "remove", "colour", "turn"]), st.integers(0, 9), PART)


@given(st.lists(GESTURE, max_size=60))
@settings(deadline=None, max_examples=60)
def test_any_editing_leaves_stops_in_order(gestures):
    stops = ramps.PLAIN
    for what, i, place in gestures:
        i %= len(stops)
        if what == "add":
            stops, _ = ramps.added(stops, place)
        elif what == "move":
            stops = ramps.moved(stops, i, place)
        elif what == "remove":
            stops = ramps.removed(stops, i)
        elif what == "colour":
            stops = ramps.recoloured(stops, i, "#12ab34")
        else:
            stops = ramps.turned(stops)
        places = [p for p, _ in stops]
        assert ramps.FEWEST <= len(stops) <= ramps.MOST
        assert all(a < b for a, b in pairwise(places))
        assert ramps.read(stops) == stops
        assert ramps.read([list(stop) for stop in stops]) == stops


def test_a_stop_added_changes_no_colour():
    stops, i = ramps.added(ramps.PLAIN, 0.4)
    assert i == 1
    for place in (0.0, 0.2, 0.4, 0.7, 1.0):
        assert max(abs(a - b) for a, b in zip(
            ramps.colour_at(stops, place), ramps.colour_at(ramps.PLAIN, place), strict=True)) < 0.004  # fmt: skip


def test_the_ramp_holds_its_end_colours():
    stops = ((0.25, "#ff0000"), (0.5, "#0000ff"))
    assert ramps.colour_at(stops, 0.0) == from_hex("#ff0000")
    assert ramps.colour_at(stops, 1.0) == from_hex("#0000ff")


def test_what_is_no_ramp_reads_as_the_plain_one():
    for value in (None, 3, "black", [[0, "red"], [1, "#ffffff"]], [[0.0, "#ffffff"]]):
        assert ramps.read(value) == ramps.PLAIN
