"""What is known: each result of the engine gives the next record, and leaves the one before as it was."""

from dataclasses import FrozenInstanceError, replace

import pytest

from app.desk.known import Known, known_after
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.value import Painting
from engine.session.apply import apply
from engine.studio.outline import rows
from engine.studio.results import GotReady, Growing, Note, Opening, Pending, Ready, Scene, Writing

SCENE = Scene(Rect(0, 0, 64, 48), (), None, False, False, modified=True, path=None)
PLACE = ((0, Rect(0, 0, 8, 8)),)


def test_it_is_replaced_never_changed():
    known = Known()
    with pytest.raises(FrozenInstanceError):
        known.pending = 3
    assert known_after(known, Pending(3), 1.0).pending == 3
    assert known.pending == 0


@pytest.mark.parametrize(
    ("result", "name", "value"),
    [(SCENE, "scene", SCENE), (Writing(2), "writing", Writing(2))],
)
def test_what_the_engine_tells_is_known(result, name, value):
    assert getattr(known_after(Known(), result, 1.0), name) == value


def test_what_tells_nothing_of_it_leaves_the_same_record():
    known = Known()
    assert known_after(known, Note("a line"), 1.0) is known


def test_what_is_being_opened_is_known_until_it_is_there_or_cannot_be():
    begun = known_after(Known(opening=Opening("a.png")), SCENE, 1.0)  # the empty painting of the start
    assert begun.opening == Opening("a.png")
    assert known_after(begun, Opening("a.png", 0.5), 1.0).opening == Opening("a.png", 0.5)
    assert known_after(begun, replace(SCENE, serial=1), 1.0).opening == Opening("a.png")  # a new one meanwhile
    assert known_after(begun, Note("b.png: cannot be written", bad=True, about="export"), 1.0).opening is not None
    assert known_after(begun, Opening(), 1.0).opening is None
    assert known_after(begun, Note("The paint engine did not load", bad=True, about="engine"), 1.0).opening is None


def test_the_engine_is_ready_with_its_tables():
    tables = Ready(blends=(("normal", "Normal", "As it is"),))
    known = known_after(Known(), tables, 1.0)
    assert known.ready
    assert known.tables is tables
    assert known_after(Known(preparing=0.5), GotReady(), 1.0).preparing is None


def test_what_grows_is_known_since_it_began_and_forgotten_when_it_is_done():
    begun = known_after(Known(), Growing(0.1, PLACE), 5.0)
    more = known_after(begun, Growing(0.4, PLACE), 7.0)
    assert (more.growing, more.grows) == (Growing(0.4, PLACE), 5.0)
    for end in (Growing(1.0, PLACE), Growing(0.5)):
        assert known_after(more, end, 9.0).growing is None
    assert known_after(known_after(more, Growing(1.0), 9.0), Growing(0.0, PLACE), 11.0).grows == 11.0


def test_a_frame_is_there_before_the_painting_is():
    assert Known().frame.width > 0
    assert (Known().modified, Known().path) == (False, None)
    assert Known(scene=SCENE).frame == SCENE.frame
    assert Known(scene=SCENE).modified


def seen_with(active, *hidden):
    """What is known of a painting with one layer in two groups and one beside them, some of them hidden."""
    made = Painting()
    for name, kind, group in (("Outer", "group", None), ("Inner", "group", "Outer"), ("Paint", "layer", "Inner")):
        made = apply(made, c.AddLayer(name, kind=kind, group=group))
    made = apply(made, c.AddLayer("Beside", group=None))
    for name in hidden:
        made = apply(made, c.SetLayer(name, visible=False))
    listed = tuple(rows(made.root))
    return known_after(Known(), Scene(Rect(0, 0, 8, 8), listed, active, False, False, modified=False, path=None), 1.0)


def test_what_hides_the_layer_that_is_painted_on_is_known():
    assert Known().hiding == ()
    assert seen_with(None, "Paint").hiding == ()
    assert seen_with("Paint", "Beside").hiding == ()
    assert seen_with("Paint", "Paint").hiding == ("Paint",)
    assert seen_with("Paint", "Outer", "Paint").hiding == ("Paint", "Outer")
    assert seen_with("Beside", "Outer", "Paint").hiding == ()
    assert seen_with("Paint").active.name == "Paint"
