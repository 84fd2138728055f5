"""What is asked before layers are merged: whether ink would end as pixels, and at which level."""

import pytest

from app.actions.merging_actions import ends_at
from engine.studio.layer_rows import LayerRow


def row(name, **fields):
    common = {"group": False, "depth": 0, "parent": None, "position": 0, "opacity": 1.0, "visible": True}
    rest = {"blend": "src-over", "locked": False, "alpha_locked": False, "finest": 3}
    return LayerRow(name, **{**common, **rest, **fields})


@pytest.mark.parametrize(
    ("upper", "level"),
    [
        ({}, None),
        ({"clip": True}, 3),
        ({"blend": "multiply", "finest": 5}, 5),
        ({"group": True, "opacity": 0.5}, 3),
        ({"clip": True, "visible": False}, None),
        ({"clip": True, "reference": True}, None),
        ({"clip": True, "height": True}, None),
    ],
)
def test_ink_ends_where_layers_mix_in_another_way_than_over_one_another(upper, level):
    low = row("low", blend="screen")
    assert ends_at([row("high", **upper), low], [low]) == level
