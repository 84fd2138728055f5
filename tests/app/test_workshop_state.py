"""The workshop as the window knows it: texts that teach, words that are completed, what is looked at, files."""

import json
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from immutables import Map

from app.desk.presets import bundled_folder
from app.desk.workshop.explained import explained
from app.desk.workshop.workshop_state import USUALLY, TextTold, WorkshopState
from app.desk.workshop.workshop_work import ReadText, WriteText, own_path
from app.panels.workshop import text_colours as colours
from app.panels.workshop.completing import Offer, accepted, function_around, offers, word_before
from engine.brush.ink import resolve
from engine.brush.parts import Component
from engine.brush.settings import Brush, from_json
from engine.brush.sway import still
from engine.canvas.layers import EMPTY
from engine.makers.definitions import read as read_definitions
from engine.makers.definitions import used
from engine.makers.makers import define, named_by
from engine.numeric.address import Rect, TileKey
from engine.painting.commands import DefineTexture
from engine.painting.textures import Around
from engine.studio.workshop.language_words import language_words
from engine.studio.workshop.workshop_records import WorkshopAsk, WorkshopScene, WorkshopSet
from engine.texture.expression.defined import expression
from engine.texture.expression.library.lesson_texts import lessons
from engine.texture.procedural import Sawtooth, Squares, Stripes

WORDS = language_words()
NAMES = colours.Names(frozenset(row.name for row in WORDS.functions), frozenset("xy"), frozenset({"wall"}))


@pytest.mark.parametrize("lesson", lessons(), ids=lambda lesson: lesson.title)
def test_lessons_are_right_and_begin_with_what_they_teach(lesson):
    assert lesson.about.startswith(f"{lesson.title}: ")
    named = named_by(lesson.text, EMPTY, Around())
    assert expression({"text": lesson.text, "named": dict(named)}, -4).named == named


def test_a_word_is_completed_by_what_begins_with_it_then_by_what_holds_it():
    found = [offer.text for offer in offers("bri", WORDS, ())]
    assert found[:2] == ["bricks(", "bricks_random("]
    assert offers("wal", WORDS, {"wall", "tone"})[0].text == "wall"
    assert offers("bricks_random", WORDS, ()) == ()
    assert [offer.text for offer in offers("", WORDS, {"wall"})][:2] == ["wall", "noise("]


def test_a_texture_is_found_by_its_name_by_what_it_is_called_and_in_quotes():
    assert [offer.text for offer in offers("roo", WORDS, ())] == ['"rooftops"(', '"clay-tiles"(']
    assert offers('"mo', WORDS, {"moist"})[0].text == '"moss"('
    whole = offers("dark", WORDS, {"dark"})  # may stand as it is: no texture that is told of with that word
    assert not whole or {offer.text[:4] for offer in whole} == {"dark"}
    assert offers('"', WORDS, {"wall"}, ["mine"])[0].text == '"mine"('
    assert {offer.text[0] for offer in offers("m", WORDS, ())} == {"m"}


@pytest.mark.parametrize(
    ("line", "at", "text", "after"),
    [
        ("a = fb", 6, "fbm(", "a = fbm("), ("a = fb(x)", 6, "fbm(", "a = fbm(x)"),
        ('a = "mo', 7, '"moss"(', 'a = "moss"('),
        ('a = mo + "', 6, '"moss"(', 'a = "moss"( + "'), ('a = "mo"(x, y)', 7, '"moss"(', 'a = "moss"(x, y)'),
    ],
)  # fmt: skip
def test_what_is_typed_gives_way_to_what_is_offered(line, at, text, after):
    start, end, told = accepted(line, at, Offer(text, text, ""))
    assert line[:start] + told + line[end:] == after


@pytest.mark.parametrize(
    ("line", "at", "word"),
    [("a = fb", 6, "fb"), ("fbm(x", 5, "x"), ("// no", 5, ""), ("#8a3", 4, ""), ("a=", 2, ""), ("a = fbm", 6, "fb"),
        ('a = "mo', 7, '"mo'), ('a = "moss"(x', 12, "x"), ('"moss"() + "fe', 14, '"fe'), ('// "no', 6, "")],
)  # fmt: skip
def test_the_word_before_the_caret(line, at, word):
    assert word_before(line, at) == word


def test_the_function_around_the_caret_is_the_innermost():
    line = "mix(#000000, fbm(x*4, y), 1)"
    assert function_around(line, 20, WORDS).name == "fbm"
    assert function_around(line, 26, WORDS).name == "mix"
    assert function_around(line, 2, WORDS).name == "mix"
    assert function_around("wall", 2, WORDS) is None
    assert function_around("x", 1, WORDS) is None
    assert function_around('a + "moss"(x*2, y)', 14, WORDS).name == "moss"
    assert function_around('a + "moss"(x*2, y)', 7, WORDS).name == "moss"


@given(st.text(alphabet=st.characters(codec="ascii", exclude_categories=["Cc"]), max_size=40))
def test_the_parts_of_a_line_are_all_its_letters_but_blanks(line):
    parts = colours.text_parts(line, NAMES)
    assert "".join(part.text for part in parts).replace(" ", "") == line.replace(" ", "")
    assert all(line[part.at :].startswith(part.text) for part in parts)


def test_parts_are_told_apart():
    found = [(part.text, part.kind) for part in colours.text_parts("wall = fbm(x*0.5, #8a3a2a) // so", NAMES)]
    assert found == [
        *(("wall", colours.OWN_NAME), ("=", colours.SIGN), ("fbm", colours.FUNCTION), ("(", colours.SIGN)),
        *(("x", colours.PLACE), ("*", colours.SIGN), ("0.5", colours.NUMBER_PART), (",", colours.SIGN)),
        *(("#8a3a2a", colours.COLOUR_PART), (")", colours.SIGN), ("// so", colours.NOTE)),
    ]
    named = NAMES._replace(own=frozenset({"star"}))
    found = [(part.text, part.kind) for part in colours.text_parts("star*star (x)", named)]
    assert found[::2][:2] == [("star", colours.OWN_NAME), ("star", colours.FUNCTION)]
    assert colours.own_names("wall = 1; tone=2\nx == 3\n  last = 4") == {"wall", "tone", "last"}


def test_what_was_set_is_asked_for_once():
    state, posted = WorkshopState(), []
    state.ask(posted.append)
    state.ask(posted.append)
    assert [type(one) for one in posted] == [WorkshopSet]
    state.over = (3, 4)
    state.ask(posted.append)
    state.edit("x\ny")
    state.ask(posted.append)
    assert posted[1] == WorkshopAsk((3, 4))
    assert posted[2].text == "x\ny"
    assert posted[3] == WorkshopAsk((3, 4))  # its values are others now


@given(st.integers(-3, 3), st.integers(0, 250), st.integers(0, 250))
def test_what_is_under_the_pointer_stays_there_as_one_zooms(finer, x, y):
    state = WorkshopState(origin=(512, -256))
    before = [o + a for o, a in zip(state.origin, (x, y), strict=True)]
    state.zoom(finer, (x, y))
    after = [o + a for o, a in zip(state.origin, (x, y), strict=True)]
    for one, other in zip(before, after, strict=True):
        assert abs(one * 2.0**finer - other) <= 8 + 2.0**finer


def test_values_of_sliders_are_written_into_the_text():
    state = WorkshopState("a = slider(0.5, 0, 1); b = pick( #102030 )\nab = slider(1, 0, 2)\na*b*ab")
    state.values = Map({"a": 0.25, "b": "#ffffff", "ab": 2.0})
    state.settle()
    assert state.text == "a = slider(0.25, 0, 1); b = pick( #ffffff )\nab = slider(2, 0, 2)\na*b*ab"
    assert not state.values
    assert state.put


def test_a_text_is_called_as_its_first_line_says_once_that_is_written():
    state = WorkshopState()
    state.take("// Stitches: of wool\nx", "Stitches")
    state.edit("// Stitches: of wool\nx + y")
    assert state.name == "Stitches"
    state.edit("// Wool, blue\nx + y")
    assert state.name == "Wool"
    state.edit("x + y")
    assert state.name == "Wool"
    state.edit("")
    assert state.name == ""


def test_a_text_comes_back_from_its_file_with_its_period(tmp_path):
    path = tmp_path / "wall.inktexture"
    WriteText(path, "// a wall\nbricks(x, y)\n", 96.0).carry_out()
    assert ReadText(path).carry_out() == ("// a wall\nbricks(x, y)\n", TextTold(period=96.0))
    expression({"text": path.read_text()}, 0)  # as the command line reads it
    (tmp_path / "other.txt").write_text("x")
    assert ReadText(tmp_path / "other.txt").carry_out() == ("x", USUALLY)
    WriteText(path, "// stages 3\npressure*rim", 64.0, 4).carry_out()
    assert ReadText(path).carry_out() == ("// stages 3\npressure*rim\n", TextTold(stages=4))
    (tmp_path / "bad.txt").write_bytes(b"\xff\xfe")
    with pytest.raises(OSError, match="UTF-8"):
        ReadText(tmp_path / "bad.txt").carry_out()


@pytest.mark.parametrize(
    ("name", "stem"),
    [("My roof", "My roof"), (" a/b: c. ", "a-b- c"), ("", "Written"), ("…", "Written"), ("x" * 99, "x" * 60)],
)
def test_a_text_is_kept_under_its_name_as_far_as_files_may_have_it(name, stem):
    assert own_path(name).name == f"{stem}.inktexture"


WAVES = {"stripes": Stripes, "sawtooth": Sawtooth, "squares": Squares}


@pytest.mark.parametrize("kind", list(WAVES))
@pytest.mark.parametrize(("angle", "phase"), [(0.0, 0.0), (30.0, 0.3), (90.0, 0.7)])
def test_a_brush_is_explained_by_a_text_that_shows_the_same(kind, angle, phase):
    told = Map({"period": 24.0, "angle": angle, "phase": phase})
    found = explained(Brush(colour="#000000", ink=(Component(kind, 1.0, "#ffffff", told),)), ())
    rect = Rect(0, 0, 48, 48)
    seen = expression({"text": found.text, "period": found.told.period}, 0).means(0, rect)[0]
    wanted = 0.5 + 0.5 * WAVES[kind](0, 24.0, angle, phase).appearance(0, rect)[0]
    assert np.abs(seen - wanted).mean() < 1e-3


def test_a_brush_is_explained_with_its_own_textures_by_their_names_shaped_and_summed():
    shapes = ({"shape": "wedge", "angle": 90, "spread": 16, "slope": 0.7},)
    made = DefineTexture("Deep furrows", "spectrum", Map({"size": (64, 64), "seed": 4, "shapes": shapes}))
    parts = Map({"period": 48}), Map({"period": 24.0})
    bent = ((0.0, 0.0), (0.4, 0.1), (0.6, 0.8), (1.0, 1.0))
    ink = Component("Deep furrows", 0.8, "#b08e70", parts[0], bent), Component("stripes", 0.4, "#231713", parts[1])
    brush = Brush(colour="#5a4234", ink=ink)
    found = explained(brush, (made,))
    assert "left out" not in found.text
    textures = {made.name: define(made, EMPTY, Around())}
    named = named_by(found.text, EMPTY, Around(textures=Map(textures)))
    text = expression({"text": found.text, "period": found.told.period, "named": dict(named)}, 0)
    key = TileKey(0, 0, 0)
    seen, wanted = text.appearance(0, key.rect)[:3], resolve(brush, textures, 0, 0).field(key)
    assert np.abs(seen - wanted).mean() < 0.01


def test_a_written_texture_is_explained_by_its_own_text_and_a_picture_by_its_name():
    told = Map({"text": "a = slider(1, 0, 2)\nx*a", "period": 96.0, "values": Map({"a": 2.0})})
    ink = (Component("Mine", 1.0),)
    found = explained(Brush(ink=ink), (DefineTexture("Mine", "expression", told),))
    assert found == (told["text"], TextTold(Map({"a": 2.0}), 96.0))
    assert '"Mine"(x, y)' in explained(Brush(ink=ink), (DefineTexture("Mine", "image", Map({"path": "a.png"})),)).text
    assert explained(Brush(), ()) is None


def written(text, **told):
    return DefineTexture("Own", "expression", Map({"text": text, **told}))


@pytest.mark.parametrize(
    ("texture", "given"),
    [
        (written("fbm(x*3, y*3)*0.5 + 0.5*step(0.1, fract(x*4)*rim)", period=96), {"rim": 1.0}),
        (written("a = slider(1, 0, 2)  // so\nb = pick(#ff8020); tint = b*a; rim = tint\nrepeat(fade(rim, 0.5), 3, 3)"),
            {"values": Map({"a": 0.25}), "period": 48}),
        (written("own = noise(x*5, y*5)\nalong = own\nramp(along, #102030, #ffe0c0)"), {}),
        (written("noise(x*5, y*5, seed)", seed=7), {}),
        (DefineTexture("Own", "expression", Map({"bundled": "halftone"})), {"period": 80}),
    ],
)  # fmt: skip
def test_a_written_texture_within_a_mix_is_explained_line_by_line(texture, given):
    ink = Component("stripes", 0.3, "#203040", Map({"period": 64})), Component("Own", 0.8, "#ffe0f0", Map(given))
    assert apart(Brush(colour="#405a30", ink=ink), (texture,)) < 0.002


def apart(brush, needs):
    """Tells how far the text of a brush is from its ink, on the average."""
    found = explained(brush, needs)
    assert found.text.count("amount_") == 2 * len(brush.ink)
    textures = {one.name: define(one, EMPTY, Around()) for one in needs}
    named = named_by(found.text, EMPTY, Around(textures=Map(textures)))
    text = expression({"text": found.text, "period": found.told.period, "named": dict(named)}, 0)
    key = TileKey(0, 0, 0)
    ink = tuple(still(component, textures) for component in brush.ink)
    wanted = resolve(replace(brush, ink=ink), textures, 0, 0).field(key)
    return np.abs(text.appearance(0, key.rect)[:3] - wanted).mean()


MIXED = {  # of bundled brushes: how far their texts may be from their inks; others are seen at night
    "brick": 0.02, "cobbles": 0.01, "crazy-paving": 0.005, "river-pebbles": 0.005, "town-from-afar": 0.001,
}  # fmt: skip


@pytest.mark.parametrize("stem", MIXED)
def test_brushes_with_written_textures_are_explained_by_what_they_paint(stem):
    assert apart(*bundled_brush(stem)) < MIXED[stem]


def bundled_brush(stem):
    path = bundled_folder() / f"{stem}.json"
    told = json.loads(path.read_text())
    brush = from_json(told.get("brush", told))
    return brush, used(brush, read_definitions(told.get("textures", []), "textures", path.parent))


OTHERWISE_ALIKE = {"rock", "sparse"}  # much like it, but other features


@pytest.mark.nightly
def test_all_bundled_brushes_are_explained_by_what_they_paint():
    count = 0
    for path in sorted(bundled_folder().glob("*.json")):
        brush, needs = bundled_brush(path.stem)
        if brush.ink:
            kinds = {part.texture for part in brush.ink} | {str(one.arguments.get("field")) for one in needs}
            found, count = apart(brush, needs), count + 1
            assert found < (0.25 if kinds & OTHERWISE_ALIKE else 0.04), path.stem
    assert count > 60


def test_stages_are_told_where_the_text_looks_at_what_the_stroke_tells():
    state = WorkshopState("pressure*x", stages=8)
    assert "stages" not in state.definition("a").arguments
    state.scene = WorkshopScene(state.text, felt=("pressure",))
    assert state.definition("a").arguments["stages"] == 8
    state.scene = WorkshopScene(state.text, felt=("pressure", "rim"))
    assert "stages" not in state.definition("a").arguments  # five at most, as usual
