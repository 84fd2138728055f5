"""Names in written textures: what they stand for where they are defined, and from then on."""

import json

import numpy as np
import pytest
from immutables import Map

from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.makers import own_inks
from engine.makers.namesakes import bundled_inks, bundled_pictures, texture_names
from engine.numeric.address import Rect
from engine.painting import recording
from engine.painting.commands import DefineTexture
from engine.painting.value import Refusal, first_painting
from engine.session.replay import replay
from engine.session.session import Session
from engine.texture.expression.library.bundled_texts import written_library
from engine.texture.image import ImageSource

TEXT = """ground = mix("moss"(x, y), "photo"(x*2, y) + "mine"(y, x), "rock"(x + 0.1*"rock"(), y))
ground*0.5 + 0.2*"felt"() + 0.1*"clouds"()"""
SEEN = Rect(-3, 5, 20, 24)


@pytest.fixture
def session(tmp_path):
    made = Session(first_painting(recording.Header(arithmetic=2)), folder=tmp_path)
    planes = np.ones((4, 12, 16), np.float32)
    planes[:3] = np.random.default_rng(1).integers(0, 256, (3, 12, 16)) / 256.0
    lent = ImageSource.of("photo", planes)
    made.do(DefineTexture("photo", "image", Map({"path": "gone.png", "sha": lent.sha})), lent)
    written(made, "mine", 'a = slider(0.5, 0, 1)\n"photo"() * a + noise(x*4, y*4)*0.2', values={"a": 0.25})
    return made


def written(session, name, text, **told):
    session.do(DefineTexture(name, "expression", Map({"text": text, **told})))
    return look(session.painting, name)


def look(painting, name):
    made = painting.textures[name].instance({}, 0, 0)
    return np.concatenate([made.appearance(level, SEEN) for level in (0, 3)])


def test_a_name_keeps_what_it_stood_for(session, tmp_path):
    before = written(session, "t", TEXT)
    written(session, "mine", "x")
    session.do(DefineTexture("photo", "rock"))
    assert (look(session.painting, "t") == before).all()
    file = tmp_path / "a.ora"
    save(file, Snapshot(session.painting, session.recording()))
    assert (look(open_painting(file).painting, "t") == before).all()


def test_a_recording_plays_what_it_tells(session, tmp_path):
    lines = [
        {"inkfall": 2, "seed": 1},
        {"do": "texture", "name": "mine", "maker": "expression", "text": "noise(x*3, y*3)"},
        {"do": "texture", "name": "t", "maker": "expression", "text": '"mine"(x, y) + 0.3*"mine"() * "leaves"()'},
    ]
    told = tmp_path / "a.jsonl"
    told.write_text("\n".join(map(json.dumps, lines)))
    first = replay(recording.read(told))
    again = first.recording()
    recording.write(again, told)
    assert (look(replay(recording.read(told)).painting, "t") == look(first.painting, "t")).all()
    assert set(again.commands[-1].arguments["named"]) == {"mine", "leaves"}


def test_a_text_that_names_itself_means_the_one_before(session, tmp_path):
    once = written(session, "a", "noise(x*4, y*4)")
    written(session, "a", '0.5*"a"()')
    assert np.abs(look(session.painting, "a") - (0.5 * once - 0.5)).max() < 1e-6
    with pytest.raises(Refusal, match='line 1, column 1: found "b", expected'):
        written(session, "b", '"b"(x, y)')
    assert [command.name for command in session.recording().commands].count("a") == 2


def test_names_of_names_end_with_one_line(session):
    session.do(DefineTexture("a", "expression", Map({"text": "x"})))
    again = DefineTexture("a", "expression", Map({"text": '0.9*"a"(y, x) + 0.1*"a"()'}))
    with pytest.raises(Refusal, match=r"^[^\n]*names within names, 13 deep, expected 12 at most$"):
        any(session.do(again) is None for _ in range(10_000))


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('x + "nobody"(x, y)', 'line 1, column 5: found "nobody", expected the name of a texture'),
        ('"rok"()', "such as rock"),
        ("+".join(f'"t{n}"()' for n in range(300)), 'found "t0"'),
        ("+".join(f'"{name}"()' for name in list(bundled_pictures())[:30]), "found one name more, expected 16"),
        ("+".join(f'"rock"({n}*x, y)' for n in range(1, 12)), "found one texture more, expected 8"),
        ('"trees"()', 'found "trees"'),
        ('scatter("rock"(), 2, 1)', 'found "rock", expected the name of a written texture'),
    ],
)
def test_what_cannot_be_is_told_in_one_line(session, text, told):
    with pytest.raises(Refusal) as found:
        written(session, "t", text)
    assert told in str(found.value)
    assert "\n" not in str(found.value)


def test_what_comes_along_wins(session):
    plain = written(session, "plain", '"rock"() + "clouds"()')
    written(session, "rock", "1")
    written(session, "clouds", "1")
    assert (written(session, "t", '"rock"() + "clouds"()') == plain).all()


RAMP = ((0.0, "#102040"), (0.25, "#e0a030"), (1.0, "#ffffff"))


@pytest.mark.parametrize("kind", ["linear", "radial", "angular"])
def test_a_gradient_begins_at_0_and_ends_at_1(session, kind):
    session.do(DefineTexture("sunset", "gradient", Map({"kind": kind, "from": (0, 0), "to": (64, 0), "ramp": RAMP})))
    seen = look(session.painting, "sunset")
    named = written(session, "t", '"sunset"(x, y)')
    assert np.abs(named - seen).max() < 1 / 255
    session.do(DefineTexture("sunset", "rock"))
    assert (look(session.painting, "t") == named).all()


def test_a_brush_of_ones_own_is_kept_when_its_file_is_gone(session, tmp_path, monkeypatch):
    monkeypatch.setattr(own_inks, "own_brushes_folder", lambda: tmp_path)
    ink = [{"texture": "grain", "amount": 0.8, "colour": "#e0a030"}, {"texture": "rock", "amount": 0.3}]
    brush = {"name": "Dry Heather", "brush": {"colour": "#204060", "ink": ink}}
    texture = {"name": "grain", "maker": "stripes", "period": 7}
    file = tmp_path / "dry.json"
    file.write_text(json.dumps({**brush, "textures": [texture]}))
    (tmp_path / "broken.json").write_text("{")
    seen = written(session, "t", '"Dry Heather"(x*2, y)')
    assert seen.shape[0] == 8
    assert dict(texture_names(session.painting.textures))["Dry Heather"] == "the ink of a brush of your own"
    file.write_text(json.dumps({**brush, "brush": {"colour": "#ffffff", "ink": ink[1:]}}))
    assert (written(session, "other", '"Dry Heather"(x*2, y)') != seen).any()
    file.unlink()
    assert (look(session.painting, "t") == seen).all()
    again = Session(first_painting(recording.Header(arithmetic=2)), folder=tmp_path)
    again.do(next(command for command in session.recording().commands if command.name == "t"))
    assert (look(again.painting, "t") == seen).all()
    with pytest.raises(Refusal, match="expected the name of"):
        written(session, "u", '"Dry Heather"()')
    file.write_text(json.dumps({**brush, "textures": [{"name": "grain", "maker": "canvas", "rect": [0, 0, 0, 9, 9]}]}))
    with pytest.raises(Refusal, match="made from an example or the canvas"):
        written(session, "u", '"Dry Heather"()')


def test_all_names_are_told_with_what_they_are(session):
    told = dict(texture_names(session.painting.textures))
    assert told["photo"] == "a texture of the painting: image"
    assert told["moss"] == "the ink of a brush"
    assert {"felt", "rock", "red-brick", "mine"} <= set(told)


def test_what_comes_along_has_names_that_are_few_enough_to_tell_apart():
    assert {"moss", "wood-grain", "bark", "brick"} <= set(bundled_inks())
    assert {"felt", "bread"} <= set(bundled_pictures())
    assert len(set(written_library()) | set(bundled_inks()) | set(bundled_pictures())) > 120


@pytest.mark.parametrize(
    "named",
    [3, {"felt": 3}, {"felt": ["rock"]}, {"felt": ["rock", 0, 16.0, 0.5, [1]]}, {"felt": ["image", 0, 64, "felt", "0"]},
     {"felt": ["expression", 0, '"felt"()', 64.0, 0, 0, '"felt"', [["rock"]] * 9]}],
)  # fmt: skip
def test_a_recording_of_strange_keys_is_refused_in_one_line(session, named):
    with pytest.raises(Refusal) as found:
        written(session, "t", '"felt"()', named=named if not isinstance(named, dict) else Map(named))
    assert "\n" not in str(found.value)
