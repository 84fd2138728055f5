"""Steps that were made as one are taken back and done again as one, and are recorded as what they are."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.painting import commands as c
from engine.painting.value import Refusal
from engine.session.replay import replay
from engine.studio import requests as q
from engine.studio.studio import Studio

UNDO, REDO = q.Do(c.Undo(), over_symmetry=True), q.Do(c.Redo(), over_symmetry=True)
LONE = st.integers(1, 9).map(lambda shade: [q.Do(c.SetPaper(f"#00000{shade}"))])
MANY = st.integers(1, 4).map(lambda count: [c.SetPaper(f"#{count:02d}000{n}") for n in range(count)])


@settings(deadline=None, max_examples=40)
@given(st.lists(st.one_of(LONE, MANY, st.just([UNDO]), st.just([UNDO]), st.just([REDO])), max_size=16))
def test_the_hand_goes_over_all_that_was_made_as_one(gestures):
    studio = Studio(lambda result: None, lambda request: None)
    session = studio.easel.session
    done, undone = [session.painting.paper], []
    for number, gesture in enumerate(gestures, 1):
        for one in gesture:
            studio.do(one if isinstance(one, q.Do) else q.Do(one, together=number))
        if gesture == [UNDO]:
            undone += [done.pop()] if len(done) > 1 else []
        elif gesture == [REDO]:
            done += [undone.pop()] if undone else []
        else:
            undone.clear()
            done.append(session.painting.paper)
        assert session.painting.paper == done[-1]
    assert replay(session.recording()).painting.paper == done[-1]
    studio.close()


def test_one_that_is_refused_leaves_the_step_before_alone():
    studio = Studio(lambda result: None, lambda request: None)
    studio.do(q.Do(c.AddLayer("A")))
    with pytest.raises(Refusal):
        studio.do(q.Do(c.RemoveLayer("B"), together=1))
    studio.do(q.Do(c.RemoveLayer("A"), together=1))
    studio.do(UNDO)
    assert [node.name for node in studio.easel.session.painting.root.children] == ["A"]
    studio.do(UNDO)
    assert not studio.easel.session.painting.root.children
    studio.close()
