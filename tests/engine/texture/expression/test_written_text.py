"""The language of written textures: what it says, what it refuses and where."""

from pathlib import Path

import numpy as np
import pytest

from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.texture.expression.defined import expression
from engine.texture.expression.language import FUNCTIONS, read
from engine.texture.expression.written import CHARACTERS_MOST, LINES_MOST, PARTS_MOST, Adjustable, WrittenError


def refused(text):
    """The line, column, what was found and what was expected of a text that is refused."""
    with pytest.raises(FieldError) as caught:
        expression({"text": text}, 0)
    message = str(caught.value)
    assert "\n" not in message
    assert message.isascii()
    return caught.value


REFUSED = (
    ("", "line 1, column 1", "nothing"),
    ("// nothing but this", "line 1, column 1", "nothing"),
    ("x +", "line 1, column 4", "the end"),
    ("a = x\nb = noyse(x, y)\nb", "line 2, column 5", '"noyse"'),
    ("a = x\n\na = y\na", "line 3, column 1", '"a"'),
    ("if = x\nif", "line 1, column 1", '"if"'),
    ("level = x\nlevel", "line 1, column 1", '"level"'),
    ("star = x\nstar(x, y)", "line 2, column 10", '")"'),
    ("x\ny", "line 1, column 1", "a line without a name"),
    ("mix(#102030, #ffffff)", "line 1, column 21", '")"'),
    ("noise(x)", "line 1, column 8", '")"'),
    ("noise(x, y, 1, 2)", "line 1, column 16", "one value more"),
    ("sin(#ff0000)", "line 1, column 5", "a colour"),
    ("x < #ff0000", "line 1, column 5", "a colour"),
    ("#ff00", "line 1, column 1", '"#ff00"'),
    ("# a comment\nx", "line 1, column 1", '"#"'),
    ("fbm(x, y, x)", "line 1, column 11", "a number that changes from place to place"),
    ("fbm(x, y, level)", "line 1, column 11", "a number that changes from level to level"),
    ("n = level\nfbm(x, y, n)", "line 1, column 5", "a number that changes from level to level"),
    ("fbm(x, y, 2.5)", "line 1, column 11", "2.5"),
    ("fbm(x, y, 99)", "line 1, column 11", "99"),
    ("a = slider(2, 0, 1)\na*x", "line 1, column 5", '"slider"'),
    ("x * slider(0.5, 0, 1)", "line 1, column 5", '"slider"'),
    ("a = pick(x)\na", "line 1, column 10", '"x"'),
    ("a = slider(0.5, 0, 1)", "line 1, column 22", "the end"),
    ("ramp(x, #000000, 0.5)\nx", "line 1, column 1", "a line without a name"),
    ("ramp(x, 0.5, #000000, 0.2, #ffffff)", "line 1, column 23", "0.2"),
    ("curve(x, 0, 1, 1, 0, 2)", "line 1, column 1", "a place without a value"),
    ("\n".join(f"a{n} = x" for n in range(LINES_MOST)) + "\nx", f"line {LINES_MOST + 1}, column 1", "one line more"),
    ("+".join("x" * PARTS_MOST), None, "one part more"),
    ("x" * (CHARACTERS_MOST + 1), "line 1, column 1", f"{CHARACTERS_MOST + 1} characters"),
    ("(" * 99 + "x", None, "one level more"),
    ("+".join("x" * 400), None, "one level more"),
    ('"moss(x, y)', "line 1, column 1", "'\"'"),
    ("x = y\nx", "line 1, column 1", '"x"'),
    ("warp(x, #ff0000, 0)", "line 1, column 9", "a colour"),
    ("1e999", "line 1, column 1", '"1e999"'),
)


@pytest.mark.parametrize(("text", "place", "found"), REFUSED, ids=range(len(REFUSED)))
def test_a_mistake_is_told_with_its_line_and_column(text, place, found):
    told = refused(text)
    assert place is None or told.place == f"text, {place}"
    assert told.found == found


def test_a_word_that_is_nearly_one_is_told():
    assert refused("fbn(x, y)").expected == "a name that there is, such as fbm"
    assert refused("tone = noise(x, y)\ntonne").expected == "a name that there is, such as tone"


def test_a_line_may_be_called_as_a_function_or_a_constant_is():
    named = "star = 0.5*noise(x*4, y*4)\nnoise = noise(x, y)\ne = e*star\nmix(noise, e, star(x, y, 5, 0.4, 0.2) < 0)"
    other = "a = 0.5*noise(x*4, y*4)\nb = noise(x, y)\nc = e*a\nmix(b, c, star(x, y, 5, 0.4, 0.2) < 0)"
    one, two = (expression({"text": text}, 0).appearance(0, Rect(0, 0, 24, 24)) for text in (named, other))
    assert np.array_equal(one, two)


def test_another_name_is_told_in_place_of_one_that_is_taken():
    assert refused("level = x\nlevel").expected == "a name of your own, such as my_level: this one has a meaning"
    assert refused("a2 = x\na3 = x\na2 = y\na2").expected == "a name of your own, such as a4: this one is taken"


def test_too_dear_a_texture_is_refused_with_its_cost():
    lines = [f"a{n} = " + "+".join(f"cells_edge(x, y, 1, {20 * n + k})**9" for k in range(20)) for n in range(12)]
    told = refused("\n".join([*lines, "+".join(f"a{n}" for n in range(12)) + "+ pow(noise(x*99, y*99), 0.3)"]))
    assert told.found.endswith("microseconds a pixel")
    assert refused("a = fbm(x, y)\n" + warped()).found == "too much at once"


def warped():
    """Lines each of which is asked for twice by the next one, elsewhere."""
    names = [f"a{n}" for n in range(20)]
    lines = [f"{b} = warp({a}, {a}, 1) + warp({a}, 1, {a})" for a, b in zip(["a", *names], names, strict=False)]
    return "\n".join([*lines, names[-1]])


def test_what_is_asked_for_has_an_end():
    many = "+".join(f"scatter({{0}}, {n}, 0.3)" for n in range(2, 9))
    things = "\n".join([f"{name} = {many.format(held)}" for name, held in ("ax", "ba", "cb")] + [many.format("c")])
    repeats = "\n".join(["a0 = x", *(f"a{n} = repeat(a{n - 1}, 2, 2) + a{n - 1}" for n in range(1, 60)), "a59"])
    for _ in range(2):  # what is refused is built anew
        assert refused(things).found == "one thing more"
        assert refused(repeats).found == "too much at once"


def test_lines_go_on_within_brackets_and_comments_are_none():
    written = read('a = mix(#102030, // dark\n  #ffffff,\n  0.5)  // "grey"\n\n; b = a ;; b')
    assert [line.name for line in written.lines] == ["a", "b", ""]


def test_sliders_tell_their_bounds():
    written = read("a = slider(-0.5, -1, 1)\nn = slider(3, 1, 8, 1)\nc = pick(#AABBCC)\nfbm(x, y, n) * a")
    assert written.sliders == {
        "a": Adjustable(-0.5, -1.0, 1.0),
        "n": Adjustable(3.0, 1.0, 8.0, 1.0),
        "c": Adjustable("#aabbcc"),
    }


TEXT = "n = slider(3, 1, 8, 1)\nc = pick(#aabbcc)\nmix(c, #000000, fbm(x, y, n))"


def test_values_of_sliders_are_checked_and_whole_where_they_are():
    made = expression({"text": TEXT, "values": {"n": 5.4}}, 0)
    assert made.values == (("n", 5.0), ("c", "#aabbcc"))
    for values in ({"n": 9}, {"n": "3"}, {"c": 3}, {"c": "#aabbc"}, {"m": 1}, {"n": float("nan")}, [3]):
        with pytest.raises(FieldError) as caught:
            expression({"text": TEXT, "values": values}, 0)
        assert caught.value.place.startswith("values")


@pytest.mark.parametrize("bad", [{"period": 0}, {"period": "64"}, {"seed": 0.5}, {"level": 1.5}, {"text": 3}])
def test_other_members_are_checked(bad):
    with pytest.raises(FieldError) as caught:
        expression({"text": "x", **bad}, 0)
    assert caught.value.place in bad


def test_every_function_tells_how_it_is_written():
    for name, (least, most, _, told) in FUNCTIONS.items():
        assert told.startswith(f"{name}(")
        named = told[len(name) + 1 : told.index(")")].split(", ")
        assert least <= len(named) <= most or "..." in named
        assert len(told) < 100


def test_the_mistake_is_picklable():
    import pickle

    error = WrittenError((2, 5), "this", "that")
    assert str(pickle.loads(pickle.dumps(error))) == "line 2, column 5: found this, expected that"


def test_the_guide_tells_every_function():
    guide = (Path(__file__).parents[4] / "palettes/expressions.md").read_text()
    for *_, told in FUNCTIONS.values():
        form, about = told.split("): ", 1)
        assert f"* `{form})`: {about}\n" in guide
