"""Taking steps back and doing them again leaves out those that only set the symmetry, and is recorded exactly."""

from hypothesis import given, settings
from hypothesis import strategies as st

from engine.archive.opening import open_painting
from engine.canvas.layers import layers
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


def test_the_hands_symmetry_is_saved_where_undo_went_back_to_an_older_one(tmp_path):
    studio = Studio(lambda result: None, lambda request: None)
    for command in (guide("symmetry", 2), c.SetPaper("#102030"), guide("symmetry", 3)):
        studio.do(q.Do(command))
    studio.do(UNDO)
    assert studio.easel.session.painting.guides["symmetry"].count == 2
    studio.do(q.Save(tmp_path / "a.ora", symmetry=guide("symmetry", 3)))
    studio.close()
    found = open_painting(tmp_path / "a.ora").painting
    assert found.guides["symmetry"].count == 3
    assert studio.easel.session.can_redo


@settings(deadline=None, max_examples=40)
@given(st.lists(st.tuples(st.sampled_from(("add", "remove", "select", "paper")), st.integers(0, 3)), max_size=9))
def test_undo_and_redo_by_hand_choose_the_layer_again_that_was_chosen(steps):
    studio = Studio(lambda result: None, lambda request: None)
    session, seen = studio.easel.session, []
    for verb, number in steps:
        names = [layer.name for layer in layers(session.painting.root)]
        name = f"{len(session.log)}" if verb == "add" or not names else names[number % len(names)]
        if verb == "select" and names:  # what the hand chooses counts from then on
            studio.do(q.Do(c.SelectLayer(name)))
            continue
        before = session.painting.active
        command = c.SetPaper(f"#00000{len(seen)}") if verb == "paper" or (verb != "add" and not names) else None
        studio.do(q.Do(command or (c.AddLayer(name) if verb == "add" else c.RemoveLayer(name))))
        seen.append((before, session.painting.active))
    for before, after in reversed(seen):
        stood = session.painting.active
        studio.do(UNDO)
        wanted = before if stood == after else stood
        if wanted in {layer.name for layer in layers(session.painting.root)}:
            assert session.painting.active == wanted
    for before, after in seen:
        stood = session.painting.active
        studio.do(REDO)
        wanted = after if stood == before else stood
        if wanted in {layer.name for layer in layers(session.painting.root)}:  # it may be gone with this very step
            assert session.painting.active == wanted
    assert replay(session.recording()).painting.active == session.painting.active
    studio.close()
