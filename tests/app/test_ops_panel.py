"""The raster-op panel's pure parts: formulas offered and faulty, the chooser's headings."""

from itertools import groupby

import pytest

from app.panels.brush import operations
from engine.brush.ops import OPS
from engine.numeric.formula import parse


def test_every_op_stands_with_those_of_its_heading_and_every_kind_of_parameter_has_a_control():
    headings = [group for group, _ in groupby(OPS.values(), lambda row: row.group)]
    assert len(set(headings)) == len(headings) > 1
    assert all(headings)
    assert {part.kind for row in OPS.values() for part in row.parameters} <= set(operations.CONTROLS)


@pytest.mark.parametrize(("title", "formula"), operations.FORMULAS)
def test_the_formulas_to_begin_with_can_be_read(title, formula):
    parse(formula)
    assert operations.fault(formula) is None


def test_a_mistake_is_shown_in_its_surroundings():
    formula = "0.5 * (colour - pic) + image(x) * 0.25 + 0.125 * pic"
    fault = operations.fault(formula)
    before, there, behind = operations.around(formula, fault.column)
    assert formula[fault.column - 1 :].startswith("image")
    assert (before, there, behind) == ("…our - pic) + ", "i", "mage(x) * 0.2…")


def test_a_mistake_at_the_end_is_shown_behind_the_last_character():
    fault = operations.fault("pic *")
    assert operations.around("pic *", fault.column) == ("pic *", " ", "")
    assert operations.around("", 1) == ("", " ", "")


def test_a_clone_begins_with_another_layer_where_there_is_one():
    assert operations.copied(["top", "middle", "bottom"], "middle") == "bottom"
    assert operations.copied(["top", "bottom"], "bottom") == "top"
    assert operations.copied(["only"], "only") == "only"
    assert operations.copied(["top", "bottom"], "a group") == "top"
