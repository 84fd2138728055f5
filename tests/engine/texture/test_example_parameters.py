"""Parameter files of examples: what they may say, and the line that tells what they may not."""

from pathlib import Path

import pytest

from engine.checks.field_error import FieldError
from engine.texture.example.parameters import Parameters, read_toml

BUNDLED = sorted((Path(__file__).parents[3] / "palettes" / "examples").glob("*.toml"))


@pytest.mark.parametrize("path", BUNDLED, ids=lambda path: path.stem)
def test_bundled_files_are_read_with_their_groups(path):
    found = read_toml(path.read_bytes())
    assert found.neighbourhood == 7
    assert found != Parameters()


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("title = 3", "line 1, title: found 3, expected a name to list the example under"),
        ("kappa = 1\ngroup = 3", "line 2, group: found 3, expected a name to list the example under"),
        ("\nkapa = 1", "line 2, kapa: found an unknown field, expected one of kappa"),
        ("kappa = 'a'", 'line 1, kappa: found "a", expected a number from 0 to 100'),
        ("levels = 2\nlevels = 3", "line 2"),
        ("kappa = " + "9" * 5000, "line 1: found a number too long, expected TOML"),
    ],
)
def test_a_fault_names_its_line_and_field(text, told):
    with pytest.raises(FieldError) as caught:
        read_toml(text.encode())
    assert str(caught.value).startswith(told)
