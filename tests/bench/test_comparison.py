"""What a run of the benchmarks finds worse than a stored one."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from app.__main__ import main
from bench import Figure, Skipped
from bench.comparison import worsened

RATIOS = Path(__file__).with_name("ratios.json")


def row(name="a", ratio=2.0, more=False):
    return {"name": name, "ratio": ratio, "more_is_better": more}


@pytest.mark.parametrize(
    ("old", "new", "more", "worse"),
    [
        (2.0, 2.6, False, False),
        (2.0, 2.61, False, True),
        (2.0, 1.0, False, False),
        (2.6, 2.0, True, False),
        (2.61, 2.0, True, True),
        (2.0, 4.0, True, False),
        (0.0, 0.0, False, False),
        (0.0, 0.1, False, True),
        (2.0, 0.0, True, True),
    ],
)
def test_the_direction_and_the_bound(old, new, more, worse):
    found = worsened({"view": [row(ratio=old, more=more)]}, {"view": [row(ratio=new, more=more)]})
    assert len(found) == worse
    assert all(line.startswith(f"view: a: ratio {new:.4g}, stored {old:.4g}: ") for line in found)


def test_rows_are_found_by_benchmark_and_name():
    stored = {"view": [row("a", 1.0), row("b", 5.0)], "dab": [row("a", 9.0)]}
    told = {"view": [row("b", 5.0), row("a", 2.0)], "dab": [row("a", 9.0)]}
    assert worsened(stored, told) == ["view: a: ratio 2, stored 1: 2.00 x worse"]


def test_what_only_one_run_measured_is_not_compared():
    skipped = {"name": "a", "skipped": "no window"}
    for stored, told in (([skipped], [row()]), ([row()], [skipped]), ([], [row()]), ([row()], [])):
        assert worsened({"view": stored}, {"view": told}) == []
    assert worsened({}, {"view": [row()]}) == []


def test_the_stored_ratios_are_not_worse_than_themselves_and_all_are_compared():
    stored = json.loads(RATIOS.read_text())["benches"]
    assert worsened(stored, stored) == []
    rows = [row for found in stored.values() for row in found if "ratio" in row]
    bad = {
        bench: [
            {**row, "ratio": row["ratio"] * (0.5 if row["more_is_better"] else 2.0)} if "ratio" in row else row
            for row in found
        ]
        for bench, found in stored.items()
    }
    assert len(worsened(stored, bad)) == len([row for row in rows if row["ratio"]])


@pytest.mark.parametrize(("ratio", "status"), [(2.0, 0), (3.0, 1)])
def test_the_command_tells_what_is_worse(capsys, tmp_path, monkeypatch, ratio, status):
    figure = Figure("a", 1.0, "ms", "a copy", 2.0, 8.0)
    rows = [("view", replace(figure, ratio=ratio)), ("view", Skipped("b", "no window"))]
    monkeypatch.setattr("bench.command.measured", lambda names, small: iter(rows))
    stored = tmp_path / "ratios.json"
    assert main(["bench", "view", "--store", str(stored)]) == 0
    assert main(["bench", "view", "--compare", str(stored)]) == 0
    stored.write_text(stored.read_text().replace(f'"ratio": {ratio}', '"ratio": 2.0'))
    capsys.readouterr()
    assert main(["bench", "view", "--compare", str(stored)]) == status
    assert ("view: a: ratio 3, stored 2: 1.50 x worse" in capsys.readouterr().out) == bool(status)


def test_a_file_without_ratios_is_refused(capsys, tmp_path):
    (tmp_path / "other").write_text("[1]")
    assert main(["bench", "view", "--compare", str(tmp_path / "other")]) == 2
    assert str(tmp_path / "other") in capsys.readouterr().err
