"""Steps of undo in the workshop: words and pauses, though the editor has a step each key."""

from hypothesis import given
from hypothesis import strategies as st

from app.panels.workshop.text_steps import TextSteps, Typed

KEYS = st.lists(st.tuples(st.sampled_from("ab2 (,*\b"), st.sampled_from((0.1, 0.2, 3.0))), max_size=40)


def typed(steps, keys, pause=0.1):
    """The texts before and after keys that come one by one."""
    text, now = "", 0.0
    texts = [text]
    for count, key in enumerate(keys):
        text = text[:-1] if key == "\b" else text + key
        now += pause
        steps.note(count, 1, Typed(-1 if key == "\b" else 1, (0, len(text)), text, now))
        texts.append(text)
    return texts


def taken_back(steps, texts):
    """What stands there after each step back."""
    found, count = [], len(texts) - 1
    while count:
        count = steps.back(count)
        found.append(texts[count])
    return found


def test_a_word_is_a_step_with_what_lies_behind_it():
    steps = TextSteps()
    texts = typed(steps, "tiles = bricks(x*6, y)")
    assert taken_back(steps, texts) == ["tiles = bricks(x*6, ", "tiles = bricks(x*", "tiles = bricks(", "tiles = ", ""]


def test_a_pause_a_row_and_taking_away_are_steps():
    steps = TextSteps()
    texts = typed(steps, "tiles\b\b\ble")
    assert taken_back(steps, texts) == ["ti", "tiles", ""]
    steps = TextSteps()
    assert taken_back(steps, typed(steps, "abc", pause=9.0)) == ["ab", "a", ""]
    steps = TextSteps()
    steps.note(0, 1, Typed(1, (0, 1), "a", 0.0))
    steps.note(1, 1, Typed(1, (1, 0), "", 0.1))  # Enter
    steps.note(2, 1, Typed(40, (3, 2), "ab", 0.2))  # what was pasted
    steps.note(3, 1, Typed(1, (3, 3), "abc", 0.3))
    assert [steps.back(count) for count in (4, 3, 2, 1)] == [3, 2, 1, 0]


def test_what_is_put_there_is_a_step():
    steps = TextSteps()
    texts = typed(steps, "ab")
    steps.end()
    steps.note(2, 1, Typed(1, (0, 3), "abc", 0.3))
    assert taken_back(steps, [*texts, "abc"]) == ["ab", ""]


@given(KEYS, st.integers(1, 6))
def test_forth_is_as_far_as_back(keys, back):
    steps, text, now = TextSteps(), "", 0.0
    for count, (key, pause) in enumerate(keys):
        text, now = (text[:-1] if key == "\b" else text + key), now + pause
        steps.note(count, 1, Typed(-1 if key == "\b" else 1, (0, len(text)), text, now))
    places = [len(keys)]
    for _ in range(back):
        if places[-1]:
            places.append(steps.back(places[-1]))
    assert places == sorted(set(places), reverse=True)
    for count, wanted in zip(reversed(places), reversed(places[:-1]), strict=False):
        found = steps.again(count)
        assert (len(keys) if found is None else found) == wanted
    steps.note(places[-1], 1, Typed(1, (5, 1), "z", now + 9.0))  # what is written then takes the place of the rest
    assert steps.back(places[-1] + 1) == places[-1]
    assert steps.again(places[-1] + 1) is None
