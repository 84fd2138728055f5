"""Preferences are written so that they are read again, and what else the file says stays."""

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.keeping.preferences import Preferences, read_preferences
from engine.keeping.writing_preferences import edited, write_preferences

UNIT = st.floats(0, 1, allow_subnormal=False)
CURVES = st.just(()) | st.lists(st.tuples(UNIT, UNIT), min_size=2, max_size=6, unique_by=lambda knot: knot[0]).map(
    lambda knots: tuple(sorted(knots))
).filter(lambda knots: knots != ((0.0, 0.0), (1.0, 1.0)))
TOLD = st.builds(
    Preferences, st.integers(1, 100), st.floats(0, 1e6), UNIT, st.integers(0, 10**6), CURVES, UNIT, st.booleans(),
    st.floats(0.75, 3), st.floats(12, 20),
    st.sampled_from(["screen", "none", "/a b/ü#1 \"x\\.icc"]), st.sampled_from(["", "p.icm"]),
    st.sampled_from(["", "de"]),
)  # fmt: skip
TEXT = "# mine\n[memory] # all of it\nmegabytes = 900   # enough\n\n[kept]\nversions=5\n"


@settings(deadline=None)
@given(TOLD, TOLD)
def test_what_is_written_is_read(tmp_path_factory, told, then):
    path = tmp_path_factory.mktemp("preferred") / "inkfall" / "preferences.toml"
    for one in (told, then):
        write_preferences(path, one)
        assert read_preferences(path) == (one, ())
    assert not path.with_name("preferences.damaged.toml").exists()


def test_lines_that_say_the_same_and_comments_stay(tmp_path):
    told = Preferences(versions=5, megabytes=700, ignore_touch=True, curve=((0.0, 0.2), (1.0, 1.0)))
    text = edited(TEXT, replace(told, part_of_free=0.5))
    assert text.startswith("# mine\n[memory] # all of it\nmegabytes = 700   # enough\n\n[kept]\nversions=5\n")
    assert "part_of_free = 0.5\n" in text
    path = tmp_path / "preferences.toml"
    path.write_text(TEXT)
    write_preferences(path, told)
    assert read_preferences(path) == (told, ())
    assert edited(path.read_text(), told) == path.read_text()


@pytest.mark.parametrize("text", ["[kept", "[kept]\nversions = 0\n", "[strange]\n", "\0"])
def test_a_file_that_is_not_understood_is_put_aside(tmp_path, text):
    path = tmp_path / "preferences.toml"
    path.write_text(text)
    write_preferences(path, Preferences(megabytes=300))
    assert path.with_name("preferences.damaged.toml").read_text() == text
    assert read_preferences(path) == (Preferences(megabytes=300), ())


@pytest.mark.parametrize(
    "line",
    ["curve = 3", "curve = []", "curve = [[0, 0]]", "curve = [[0, 0], [0, 1]]", "curve = [[0, 0], [1, 2]]",
     "curve = [[0, 0], [1]]", 'curve = [[0, "a"], [1, 1]]', "curve = [[0, nan], [1, 1]]", "ignore_touch = 1",
     'constant = "hard"', f"curve = {[[i / 99, 0] for i in range(99)]}"],
)  # fmt: skip
def test_pens_that_are_none_are_told_in_a_line(tmp_path, line):
    path = tmp_path / "preferences.toml"
    path.write_text(f"[pen]\n{line}\n")
    found, faults = read_preferences(path)
    assert found == Preferences()
    assert len(faults) == 1
    assert faults[0].isprintable()
