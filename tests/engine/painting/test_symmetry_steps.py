"""Taking steps back and doing them again leaves out those that only set the symmetry, and is recorded exactly."""

from hypothesis import given, settings
from hypothesis import strategies as st

from engine.painting import commands as c
from engine.session.replay import replay
from engine.studio import requests as q
from engine.studio.studio import Studio

TO = ((0.0, 0.0), (9.0, 5.0))


def guide(kind, count):
    return c.Guide(kind, kind, 0, (count, 0), TO, count)


UNDO, REDO = q.Do(c.Undo(), over_symmetry=True), q.Do(c.Redo(), over_symmetry=True)
AXES = st.integers(1, 9).map(lambda count: q.Do(guide("symmetry", count)))
RULERS = st.integers(1, 9).map(lambda count: q.Do(guide("ruler", count)))
OTHERS = st.integers(1, 9).map(lambda width: q.Do(c.SetPaper(f"#00000{width}")))


def seen(painting):
    """All that the commands of this test set, but the symmetry."""
    return painting.paper, painting.guides.get("ruler")


@settings(deadline=None, max_examples=40)
@given(st.lists(st.one_of(AXES, RULERS, OTHERS, st.just(UNDO), st.just(UNDO), st.just(REDO)), max_size=16))
def test_the_hand_goes_from_one_step_that_is_none_of_the_symmetry_to_the_next(requests):
    studio = Studio(lambda result: None, lambda request: None)
    session = studio.easel.session
    done, undone = [seen(session.painting)], []
    for request in requests:
        studio.do(request)
        if request is UNDO:
            undone += [done.pop()] if len(done) > 1 else []
        elif request is REDO:
            done += [undone.pop()] if undone else []
        else:
            undone.clear()
            axis = isinstance(request.command, c.Guide) and request.command.kind == "symmetry"
            done += [] if axis else [seen(session.painting)]
        assert seen(session.painting) == done[-1]
    again = replay(session.recording()).painting
    assert again.guides == session.painting.guides
    assert seen(again) == seen(session.painting)
    studio.close()


def test_doing_again_undoes_what_undoing_did_with_the_symmetry_that_came_after():
    studio = Studio(lambda result: None, lambda request: None)
    for command in (c.SetPaper("#102030"), guide("symmetry", 2), guide("symmetry", 3), c.SetPaper("#405060")):
        studio.do(q.Do(command))
    log = studio.easel.session.log
    for request, told in ((UNDO, c.Undo(1)), (UNDO, c.Undo(3)), (REDO, c.Redo(3)), (REDO, c.Redo(1))):
        studio.do(request)
        assert log[-1] == told
    studio.close()
