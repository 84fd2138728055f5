"""The scripts that paint for long run, and tell what they measured.  Their times are nobody's test."""

import pytest

from bench import crowded, extremes, soak


@pytest.mark.parametrize("kind", ["places", "levels"])
def test_strokes_far_apart_are_painted_and_undone(kind):
    told = extremes.paint(kind, 12)
    assert len(told["strokes"]) == extremes.TENTHS
    assert told["steps"] == 12


def test_a_short_soak_ends_where_it_began():
    rows = list(soak.main(24, 12, 1))
    assert [row["strokes"] for row in rows[:2]] == [12, 24]
    assert rows[3]["bytes"] > 0
    assert rows[-1]["empty"]
    assert rows[-1]["undone"] + rows[-1]["left to replay"] == rows[1]["all steps"]


def test_a_crowd_of_strokes_is_painted_on_seen_saved_and_opened(monkeypatch):
    monkeypatch.setattr(crowded, "STROKES", 4)
    rows = list(crowded.main(64, True))
    assert [row["level"] for row in rows if "level" in row] == [0, -1, -2, -3, -4] * 2
    assert rows[0]["strokes"] == 64
    assert min(row["bytes"] for row in rows if "saved" in row) > 0
    assert sum("opened" in row for row in rows) == 1
    assert sum("undone" in row for row in rows) == 2
