"""The pointers of a window: what happened first comes first."""

from app.input import pointers
from app.input.events import PenEvent


class Told:
    """In place of a source: what it tells is put into it."""

    name = "told"

    def __init__(self, *x):
        self.waiting = [PenEvent("move", float(at), 0.0) for at in x]

    def events(self):
        found, self.waiting = self.waiting, []
        return found


def test_what_the_mouse_did_before_pens_were_heard_comes_before_what_they_tell(monkeypatch):
    mouse, pens = Told(1, 2), Told(3, 4)
    monkeypatch.setattr(pointers, "GlfwPointer", lambda window: mouse)
    monkeypatch.setattr(pointers, "pen_source", lambda window: pens)
    found = pointers.Pointers(None)
    found.hear_pens()
    assert [event.x for event in found.events()] == [1.0, 2.0, 3.0, 4.0]
    assert found.events() == []
