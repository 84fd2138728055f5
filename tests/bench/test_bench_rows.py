"""The benchmarks run and tell their rows in the stored form.  Their times are nobody's test."""

import json
import os
from pathlib import Path

import pytest

import engine
from app.__main__ import main
from bench import BENCHES, Figure, Skipped
from bench.clock import best, copying

STORED = Path(__file__).parent / "ratios.json"
QUICK = (
    "view",
    "dab",
    "raster",
    "spectral",
    "written",
    "matching",
    "learnt",
    "example",
    "stroke",
    "copies",
    "flooding",
    "exporting",
    "looking",
    "memory",
)  # the others open windows and other programs, or take seconds however small


def checked(row):
    """A row as it is told in JSON."""
    if "skipped" in row:
        assert row["name"]
        return
    assert {"name", "value", "unit", "bound", "ratio", "limit", "more_is_better", "note", "within"} <= row.keys()
    assert row["value"] >= 0
    assert row["ratio"] >= 0
    assert row["within"] == (row["ratio"] >= row["limit"] if row["more_is_better"] else row["ratio"] <= row["limit"])


@pytest.mark.parametrize("names", [("view", "dab", "stroke"), pytest.param(QUICK, marks=pytest.mark.nightly)])
def test_quick_benchmarks_run_and_tell_their_rows(capsys, tmp_path, names):
    assert engine.__file__  # its import says where kernels are kept
    file, environment = tmp_path / "ratios.json", dict(os.environ)
    assert main(["bench", *names, "--small", "--json", "--store", str(file)]) == 0
    assert os.environ == environment  # what is started after it is started as before
    told = json.loads(capsys.readouterr().out)
    assert {row["bench"] for row in told["figures"]} == set(names)
    for row in told["figures"]:
        checked(row)
    kept = json.loads(file.read_text())["benches"]
    assert list(kept) == [name for name in BENCHES if name in names]

    # Another run replaces only the rows of what it measured.
    assert main(["bench", "view", "--small", "--store", str(file)]) == 0
    assert list(json.loads(file.read_text())["benches"]) == list(kept)
    assert "view, colour alone" in capsys.readouterr().out


def test_stored_ratios_have_every_benchmark():
    stored = json.loads(STORED.read_text())
    assert list(stored["benches"]) == list(BENCHES)
    assert stored["machine"]["processor"]
    for rows in stored["benches"].values():
        assert rows
        for row in rows:
            checked(row)


def test_a_file_of_another_kind_is_not_overwritten(capsys, tmp_path):
    for text in ("no json", "[1]"):
        file = tmp_path / "other"
        file.write_text(text)
        assert main(["bench", "view", "--small", "--store", str(file)]) == 2
        assert file.read_text() == text
        assert str(file) in capsys.readouterr().err


def test_an_unknown_name_is_refused(capsys):
    assert main(["bench", "nothing"]) == 2
    assert "nothing" in capsys.readouterr().err


def test_an_installed_program_has_no_benchmarks(capsys, tmp_path, monkeypatch):
    monkeypatch.setattr("app.cli.bench.TESTS", tmp_path)
    for words in (["bench"], ["bench", "view", "--small"], ["bench", "--json"]):
        assert main(words) == 1
        told = capsys.readouterr().err
        assert told.count("\n") == 1
        assert "benchmarks come with the source" in told


@pytest.mark.parametrize(
    ("ratio", "more", "within"), [(2, False, True), (5, False, False), (5, True, True), (2, True, False)]
)
def test_within_its_bound(ratio, more, within):
    assert Figure("a", 1.0, "s", "b", ratio, 3.0, more).within is within


def test_works_take_turns():
    order = []
    times = best(2, lambda: order.append("a"), lambda: order.append("b"))
    assert order == ["a", "b"] * 3
    assert len(times) == 2
    assert all(t >= 0 for t in times)
    copying(80)()
    assert Skipped("a", "b").reason == "b"
