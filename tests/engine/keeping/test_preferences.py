"""Preferences: what is understood is taken over, the rest is told, and nothing keeps the program from starting."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.keeping.preferences import LARGEST_FILE, SETTINGS, Preferences, Row, read_preferences

WHOLE = b"[kept]\nversions = 5\ngigabytes = 2\npart_of_free = 0.25\n[memory]\nmegabytes = 900\n"


@pytest.fixture
def read(tmp_path):
    def read(data):
        (tmp_path / "preferences.toml").write_bytes(data)
        return read_preferences(tmp_path / "preferences.toml")

    return read


def test_every_row_is_read(read):
    assert read(WHOLE) == (Preferences(5, 2, 0.25, 900), ())
    assert len(SETTINGS) == len(Preferences.__dataclass_fields__)


def test_none_are_the_usual_ones(read, tmp_path):
    assert read(b"") == read_preferences(tmp_path / "missing") == (Preferences(), ())
    assert Preferences() == Preferences(3, 5.0, 0.1, 0)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"[kept]\nversions = 0", "[kept] versions: found '0', expected a whole number from 1 to 100"),
        (b"[kept]\nversions = 2.5", "expected a whole number"),
        (b"[kept]\nversions = true", "expected a whole number"),
        (b"[kept]\ngigabytes = nan", "expected a number from 0 to 1e+06"),
        (b"[kept]\ngigabytes = '5'", "expected a number"),
        (b"[kept]\nversion = 2", "found 'version', expected one of versions, gigabytes, part_of_free"),
        (b"[keeps]\nversions = 2", "found 'keeps', expected a table, one of display, kept, memory, pen"),
        (b"[memory]\nmegabytes = 1.5", "[memory] megabytes: found '1.5', expected a whole number from 0"),
        (b"kept = 3", "found 'kept', expected a table"),
        (b"[kept", "expected ']'"),
        (b"\xff", "utf-8"),
        (b"a = " + b"[" * 5000, "preferences are as they come"),
        (b"#" * (LARGEST_FILE + 1), "expected preferences"),
    ],
)
def test_what_is_wrong_is_told_in_one_line(read, data, words):
    found, faults = read(data)
    assert found == Preferences()
    assert len(faults) == 1
    assert words.lower() in faults[0].lower()
    assert "preferences.toml: " in faults[0]
    assert "\n" not in faults[0]


def test_one_fault_leaves_the_other_rows(read):
    assert read(b"[kept]\nversions = 0\ngigabytes = 1.5")[0] == Preferences(3, 1.5)


def test_a_folder_in_its_place(tmp_path):
    assert read_preferences(tmp_path)[0] == Preferences()


@settings(deadline=None)
@given(st.integers(0, len(WHOLE) - 1), st.integers(0, 255), st.booleans())
def test_cut_or_flipped_anywhere_it_is_read_without_an_error(tmp_path_factory, place, byte, cut):
    path = tmp_path_factory.getbasetemp() / "flipped.toml"
    path.write_bytes(WHOLE[:place] if cut else WHOLE[:place] + bytes([byte]) + WHOLE[place + 1 :])
    found, faults = read_preferences(path)
    for (_, key), row in SETTINGS.items():
        assert not isinstance(row, Row) or row.low <= getattr(found, key) <= row.high
    assert found == Preferences(5, 2, 0.25, 900) or faults or found != Preferences() or cut
