"""What palettes/recording.md tells of brushes is what the tables hold."""

import re
from pathlib import Path

from engine.brush.modes import MODES
from engine.brush.ops import OPS

TEXT = (Path(__file__).parents[2] / "palettes" / "recording.md").read_text("utf-8")


def rows(heading):
    """The cells of each row of the table that begins with a line `heading`."""
    lines = TEXT.split(f"{heading}", 1)[1].split("\n\n", 1)[0].splitlines()[2:]
    return [re.split(r"(?<!\\)\|", line)[1:-1] for line in lines]


def test_every_mode_is_told():
    [told] = [line for line in TEXT.splitlines() if line.startswith("| `mode`")]
    assert set(re.findall(r'"(\w+)"', told)) - {"formula"} == set(MODES)


def test_every_op_is_told_with_its_parameters():
    found = {}
    for names, parameters, _ in rows("| op | parameters"):
        for name in re.findall(r"`(\w+)`", names):
            found[name] = set(re.findall(r"`(\w+)`", parameters))
    assert found == {name: {part.name for part in row.parameters} for name, row in OPS.items()}
