"""The pointers of a window: what happened first comes first."""

from types import SimpleNamespace

from app.input import pointers
from app.input.events import PenEvent


class Told:
    """In place of a source: what it tells is put into it."""

    name = "told"
    near = False

    def __init__(self, *x):
        self.waiting = [PenEvent("move", float(at), 0.0) for at in x]

    def events(self):
        found, self.waiting = self.waiting, []
        return found


def test_what_the_mouse_did_before_pens_were_heard_comes_before_what_they_tell(monkeypatch):
    mouse, pens = Told(1, 2), Told(3, 4)
    monkeypatch.setattr(pointers, "GlfwPointer", lambda window: mouse)
    monkeypatch.setattr(pointers, "pen_source", lambda window, driver: pens)
    monkeypatch.setattr(pointers, "key_times", lambda: None)
    found = pointers.Pointers(None)
    found.hear_pens()
    assert [event.x for event in found.events()] == [1.0, 2.0, 3.0, 4.0]
    assert found.events() == []


def test_a_key_parts_what_the_pointer_did_before_it_from_what_it_did_after(monkeypatch):
    """Also where the server's clock begins anew."""
    begin = 2**32 - 2
    times = iter((begin + 1, None, (begin + 4) % 2**32))
    pens = Told()
    pens.waiting = [PenEvent("move", float(x), 0.0, time=((begin + x) % 2**32) / 1000) for x in range(6)]
    monkeypatch.setattr(pointers, "GlfwPointer", lambda window: Told())
    monkeypatch.setattr(pointers, "pen_source", lambda window, driver: pens)
    monkeypatch.setattr(pointers, "key_times", lambda: SimpleNamespace(of=lambda code: next(times)))
    found = pointers.Pointers(None)
    found.hear_pens()
    assert [event.x for event in found.events_before(38)] == [0.0, 1.0]
    assert [event.x for event in found.events_before(38)] == [2.0, 3.0, 4.0, 5.0], "when is not known"
    pens.waiting = [PenEvent("move", 4.0, 0.0, time=((begin + 4) % 2**32) / 1000)]
    pens.waiting += [PenEvent("move", 5.0, 0.0, time=((begin + 5) % 2**32) / 1000)]
    assert [event.x for event in found.events_before(38)] == [4.0]
    assert [event.x for event in found.events()] == [5.0]


def test_keys_that_come_later_than_a_press_after_them_are_told_first(monkeypatch):
    """Both come over connections of their own: the press may be read while the key is still on its way."""
    pens, before = Told(), []
    pens.waiting = [PenEvent("move", 0.0, 0.0, time=0.100), PenEvent("down", 4.0, 0.0, time=0.104)]
    monkeypatch.setattr(pointers, "GlfwPointer", lambda window: Told())
    monkeypatch.setattr(pointers, "pen_source", lambda window, driver: pens)
    monkeypatch.setattr(pointers, "key_times", lambda: SimpleNamespace(of=lambda code: 102))
    found = pointers.Pointers(None)
    found.hear_pens()

    def poll():
        pens.waiting.append(PenEvent("move", 5.0, 0.0, time=0.105))
        before.extend(event.x for event in found.events_before(65))

    monkeypatch.setattr(pointers.glfw, "poll_events", poll)
    assert [event.x for event in found.events_in_order()] == [4.0], "what came since then may have keys before it"
    assert before == [0.0]
    monkeypatch.setattr(pointers.glfw, "poll_events", lambda: None)
    assert [event.x for event in found.events_in_order()] == [5.0]
    assert found.events_in_order() == []
