"""Numbers typed for what is moved: exact to their last digit, and nothing else is taken for one."""

from fractions import Fraction

import pytest

from app.panels.moving.move_bar import typed_number


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("30°", 30), (" 50 %", 50), ("−12", -12), ("12,5", Fraction(25, 2)), ("+7.", 7), (str(1 << 4000), 1 << 4000),
        *((bad, None) for bad in ("", "e", "1e9", "nan", "inf", "1/0", "--1", "0x10", "9" * 2501, "9" * 2499)),
    ],
)  # fmt: skip
def test_a_number_is_taken_as_it_is_typed(text, value):
    assert typed_number(text) == value
