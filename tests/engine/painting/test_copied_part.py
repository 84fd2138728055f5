"""What is selected, copied, cut and pasted: exact where it is wholly selected, adding up along the rim."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from test_selecting import GROUND, seen, selected, told

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.evaluate import evaluate_sparse
from engine.canvas.reading import layer_planes
from engine.checks.roles import COPIED
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.value import Refusal
from engine.session.replay import replay
from engine.session.session import Session
from engine.studio.outline import rows

WINDOW = Rect(-40, -40, 200, 180)
OVAL = {"do": "select", "ellipse": [0, 20, 10, 90, 80]}
INK = {
    "do": "stroke",
    "points": [[10, 30], [50, 50]],
    "brush": {"radius": 12, "ink": [{"texture": "rock", "amount": 1}]},
}
NEW = {"do": "layer", "duplicate": "Paint", "to": "New", "selected": "copy"}


def planes(painting, name, level=0):
    found = layer_planes(layers.find(painting.root, name), level, WINDOW)
    return np.zeros((4, WINDOW.height, WINDOW.width), np.float32) if found is None else found


@given(
    st.integers(-30, 90), st.integers(-30, 60), st.integers(1, 120), st.sampled_from([0.0, 6.0, 14.0]), st.booleans()
)
@example(x=0, y=0, side=1, feather=0.0, inverse=True)  # all of it is taken
@settings(max_examples=4, deadline=None)
def test_what_a_cut_takes_and_leaves_adds_up_to_what_was_there(x, y, side, feather, inverse):
    session = told(Session(GROUND), {"do": "select", "ellipse": [0, x, y, side, side], "feather": feather})
    if inverse:
        told(session, {"do": "select", "invert": True})
    before, chosen = planes(GROUND, "Paint"), selected(session.painting, 0)
    if not (before[3] * chosen > 1e-3).any():
        return
    told(session, {**NEW, "selected": "cut"})
    taken, left = planes(session.painting, "New"), planes(session.painting, "Paint")
    assert np.abs(taken + left - before).max() <= 1 / 255
    assert (left[:, chosen == 0.0] == before[:, chosen == 0.0]).all()
    assert not taken[:, chosen == 0.0].any()
    assert np.abs(taken - before)[:, chosen == 1.0].max(initial=0) <= 2**-15
    told(session, {"do": "undo"})
    assert (planes(session.painting, "Paint") == before).all()


def test_a_copy_keeps_ink_and_finer_detail_within():
    session = told(Session(GROUND), INK, {"do": "select", "rect": [0, -64, -64, 128, 128]}, NEW)
    near = Rect(-20, -20, 120, 100)  # of level 1
    paints = (layers.find(session.painting.root, name).pyramid for name in ("Paint", "New"))
    one, other = (evaluate_sparse(paint, 1, near, None) for paint in paints)
    assert one.data.any()
    assert (one.data == other.data).all()
    assert [len(found.inks) for found in (one, other)] == [1, 1]


def test_what_is_copied_is_pasted_as_it_was_whatever_came_between(tmp_path):
    aside = {"do": "layer", "duplicate": "Paint", "to": "Copied", "selected": "copy", "aside": True}
    session = told(Session(GROUND), OVAL, aside)
    assert [row.name for row in rows(session.painting.root)] == ["Paint"]
    assert (seen(session.painting, 0) == seen(GROUND, 0)).all()
    chosen = selected(session.painting, 0)
    told(session, {"do": "select", "none": True}, {"do": "layer", "clear": "Paint"})
    place = tmp_path / "copied.ora"
    save(place, Snapshot(session.painting))
    opened = open_painting(place).painting
    paste = {"do": "layer", "duplicate": "Copied", "to": "Pasted"}
    again = told(Session(opened), paste).painting
    told(session, paste)
    assert session.painting.active == "Pasted"
    assert (seen(session.painting, 0)[:, chosen == 1.0] == seen(GROUND, 0)[:, chosen == 1.0]).all()
    assert (seen(again, 0) == seen(session.painting, 0)).all()
    told(session, paste | {"to": "Twice"})
    assert [row.name for row in rows(session.painting.root)] == ["Twice", "Pasted", "Paint"]


def test_the_next_copy_takes_the_place_of_the_last_and_a_replay_is_equal():
    session = Session()
    told(session, {"do": "stroke", "points": [[10, 10], [90, 70]], "brush": {"radius": 20}}, OVAL)
    cut = {"do": "layer", "duplicate": "Layer 1", "to": "Copied", "selected": "cut", "aside": True}
    told(session, cut, {"do": "select", "none": True}, cut | {"selected": "copy"})
    told(session, {"do": "layer", "duplicate": "Copied", "to": "Pasted"})
    held = [node for node in layers.layers(session.painting.root) if node.role == COPIED]
    assert len(held) == 1
    assert session.steps.count == 6
    assert (seen(replay(session.recording()).painting, 0) == seen(session.painting, 0)).all()


def test_what_is_set_aside_is_never_painted_on():
    aside = {"do": "layer", "duplicate": "Paint", "to": "Copied", "selected": "copy", "aside": True}
    session = told(Session(GROUND), OVAL, aside, {"do": "layer", "remove": "Paint"})
    assert session.painting.active is None
    told(session, {"do": "layer", "duplicate": "Copied", "to": "Pasted"})
    assert session.painting.active == "Pasted"


@pytest.mark.parametrize(
    ("before", "command", "why"),
    [
        ({"do": "select", "rect": [0, 5000, 5000, 9, 9]}, NEW, "found no paint where it is selected"),
        ({"do": "layer", "set": "Paint", "locked": True}, {**NEW, "selected": "cut"}, "found it locked"),
        ({"do": "layer", "add": "G", "kind": "group"}, {**NEW, "duplicate": "G"}, "found no layer of paint"),
    ],
)
def test_what_cannot_be_copied_is_refused(before, command, why):
    session = told(Session(GROUND), before)
    painting = session.painting
    with pytest.raises(Refusal, match=why):
        session.do(c.parse(command))
    assert session.painting is painting
