"""Strict JSON: what is refused, and that what is kept survives."""

import contextlib
import json
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.checks.field_error import FieldError
from engine.files.strict_json import Fields, dumps, loads

REFUSED = {
    "nan": "NaN",
    "infinity": '{"a": Infinity}',
    "minus infinity": "[-Infinity]",
    "overflow": "[1e999]",
    "minus overflow": "-1e999",
    "twice": '{"a": 1, "a": 2}',
    "twice inside": '[{"b": {"a": 1, "a": 1}}]',
    "deep": "[" * 100_000,
    "deep and closed": "[" * 100_000 + "]" * 100_000,
    "deep objects": '{"a":' * 100_000,
    "long integer": "1" * 5000,
    "latin-1": '"é"'.encode("latin-1"),
    "utf-16": '{"a": 1}'.encode("utf-16"),
    "lone surrogate": r'"\ud800"',
    "lone surrogate in a key": r'{"\udc00": 1}',
    "trailing comma": "[1,]",
    "comment": "[1] // no",
    "single quotes": "{'a': 1}",
    "nothing": "",
    "two values": "1 2",
    "raw control character": '"a\nb"',
    "NUL": b"\x00",
    "leading zero": "[01]",
    "arabic digits": "[٤]",
    "underscore": "[1_000]",
    "hex": "[0x10]",
}


@pytest.mark.parametrize("text", REFUSED.values(), ids=REFUSED)
def test_refused_with_one_line(text):
    with pytest.raises(FieldError) as caught:
        loads(text)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 300
    assert "expected" in str(caught.value)


def test_too_long_is_refused_before_it_is_read():
    with pytest.raises(FieldError, match="more than 1 MiB"):
        loads(b" " * ((1 << 20) + 1), cap=1 << 20)


def test_byte_order_mark_and_pairs_of_surrogates_are_fine():
    assert loads(b'\xef\xbb\xbf{"a": 1}') == {"a": 1}
    assert loads(r'"\ud83c\udfa8"') == "🎨"


json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(), inner, max_size=4),
    max_leaves=12,
)


@settings(deadline=None, max_examples=100)
@given(json_values)
def test_what_is_written_is_read_back(value):
    try:
        text = dumps(value)
        text.encode()
    except UnicodeEncodeError:
        with pytest.raises(FieldError):
            loads(json.dumps(value))
        return
    assert loads(text) == value
    assert loads(text.encode()) == value


@settings(deadline=None, max_examples=200)
@given(st.binary(max_size=60) | st.text(alphabet='{}[]",:0123456789.eE+-\\u nultrefasINy', max_size=40))
def test_garbage_raises_nothing_else(data):
    with contextlib.suppress(FieldError):
        loads(data)


FIELD_FAULTS = [
    ({"a": True}, lambda f: f.integer("a", lo=0, hi=9)),
    ({"a": 1.0}, lambda f: f.integer("a", lo=0, hi=9)),
    ({"a": 10}, lambda f: f.integer("a", lo=0, hi=9)),
    ({}, lambda f: f.integer("a", lo=0, hi=9)),
    ({"a": None}, lambda f: f.integer("a", 3, lo=0, hi=9)),
    ({"a": "1"}, lambda f: f.number("a", lo=0, hi=9)),
    ({"a": 10**400}, lambda f: f.number("a", lo=0, hi=9)),
    ({"a": 1}, lambda f: f.flag("a")),
    ({"a": ""}, lambda f: f.text("a")),
    ({"a": "x" * 257}, lambda f: f.text("a")),
    ({"a": "a\x00b"}, lambda f: f.text("a")),
    ({"a": [1]}, lambda f: f.integers("a", 2, limit=9)),
    ({"a": [1, 10]}, lambda f: f.integers("a", 2, limit=9)),
    ({"a": [1, 1.5]}, lambda f: f.integers("a", 2, limit=9)),
    ({"a": {"x": 0}}, lambda f: f.integers("a", 2, limit=9)),
    ([], lambda f: f),
]


@pytest.mark.parametrize(("value", "read"), FIELD_FAULTS)
def test_fields_name_place_found_and_expected(value, read):
    with pytest.raises(FieldError) as caught:
        read(Fields(value, "top"))
    assert str(caught.value).startswith("top")
    assert ": found " in str(caught.value)
    assert ", expected " in str(caught.value)


def test_the_middle_of_a_long_place_is_left_out():
    place = "layers[3]" + ".children[0]" * 99 + ".kind"
    told = str(FieldError(place, "1", "2"))
    assert re.fullmatch(r"layers\[3\]\S+\.\.\.\S+\[0\]\.kind: found 1, expected 2", told)
    assert len(told) < 120
    assert FieldError(place, "1", "2").place == place


def test_fields_keep_what_nobody_asked_for():
    members = Fields({"a": 1, "later": [1, 2], "b": 2.5}, "")
    assert members.integer("a", lo=0, hi=5) == 1
    assert members.number("b", lo=0, hi=5) == 2.5
    assert members.number("missing", 4.0, lo=0, hi=5) == 4.0
    assert dict(members.rest()) == {"later": (1, 2)}
