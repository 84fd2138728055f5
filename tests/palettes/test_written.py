"""The written textures that come along: each is whole, is right at every level, and is a brush of the window."""

import numpy as np
import pytest

from app.desk.holding.dipping import dipped
from app.desk.holding.written_brushes import GROUP, written_brushes
from app.desk.presets import bundled_folder, load_brushes
from engine.checks.field_error import FieldError
from engine.numeric.address import Rect
from engine.painting.commands import parse
from engine.painting.value import Painting, Refusal
from engine.session.apply import apply
from engine.session.session import Session
from engine.studio.preparing.job_queue import expected
from engine.studio.requests import Swatch
from engine.studio.textures.swatches import painted
from engine.texture.expression.defined import expression
from engine.texture.expression.examined import shimmer
from engine.texture.expression.library.bundled_texts import written_library
from engine.texture.expression.written_ink import woven_line

NAMES = list(written_library())
LEVELS = range(-4, 11)  # of 4 pixels of a period to 65,536
SHIMMER_EXACT, SHIMMER = 1.0, 3.0  # of 255, rms: what is exactly filtered, and all else
DEFINED = {"do": "texture", "name": "wall", "maker": "expression"}


@pytest.mark.parametrize("name", NAMES)
def test_each_is_whole(name):
    told = written_library()[name]
    assert told.about[:1].isupper()
    assert len(told.about) <= 80
    made = expression({"text": told.text}, -4)
    for level in (0, 10):
        seen = made.appearance(level, Rect.at(77 << level, 50 << level, 48, 48))
        assert np.isfinite(seen).all()
        nothing = -1.0 if len(seen) == 1 else 0.0  # between the lines of a pen
        assert seen.std() > 0.004 or (seen == nothing).all(), level


def test_they_are_brushes_of_a_group():
    found = written_brushes()
    assert {preset.group for preset in found} == {GROUP}
    assert len({preset.name for preset in found}) == len(found) == len(NAMES) >= 30
    others, _ = load_brushes(bundled_folder())
    taken = {one.name.casefold() for preset in others for one in (preset, *preset.textures)}
    assert not taken & {preset.name.casefold() for preset in found}
    assert all(dipped(one.brush, "#fe5b5b").ink == dipped(one.brush, "#000000").ink for one in found)
    lines = {preset.name for preset in found if not preset.brush.ink}
    assert lines == {"Cross-hatching", "Hatching with a pen"}
    drawn = next(preset for preset in found if preset.name == "Basket")
    picture = painted(Swatch(drawn.name, drawn.brush, (104, 44), textures=drawn.textures), Painting())
    assert picture[3].max() > 0.9
    assert picture[0].std() > 0.02


def test_one_of_them_is_made_ready_for_all():
    listed = [Swatch("", one.brush, (104, 44), textures=one.textures) for one in written_brushes()]
    assert len(expected(listed)) == len(expected(listed[:1])) == len(expected(())) + 1


def test_a_recording_names_one_and_keeps_its_text():
    session = Session(Painting())
    session.do(parse({**DEFINED, "bundled": "red-brick"}))
    (command,) = session.log
    assert command.arguments["text"] == written_library()["red-brick"].text
    with pytest.raises(Refusal, match="red-brick"):
        apply(Painting(), parse({**DEFINED, "bundled": "red-brik"}))


def test_a_text_names_others_where_they_are_or_elsewhere():
    rect = Rect.at(30, 40, 20, 20)
    plain = expression({"text": written_library()["snow"].text}, 0).appearance(2, rect)
    assert (expression({"text": '"snow"()'}, 0).appearance(2, rect) == plain).all()
    assert (expression({"text": 'a = x; "snow"(a, y)'}, 0).appearance(2, rect) == plain).all()
    with pytest.raises(FieldError, match="such as snow"):
        expression({"text": '"snou"(x, y)'}, 0)


@pytest.mark.parametrize("name", ["agate", "autumn-leaves", "kraft-paper", "linen"])
def test_from_near_four_samples_of_a_pixel_are_enough(name):
    near = expression({"text": written_library()[name].text}, -4).at(3)
    assert (near.side, near.finer) == (2, None)


@pytest.mark.parametrize("name", NAMES)
def test_none_shimmers(name):
    """Each level is the next finer one, reduced: here one level of each, so that all levels are looked at."""
    _shimmers_little(name, LEVELS[NAMES.index(name) * 4 % len(LEVELS)])


@pytest.mark.nightly
@pytest.mark.parametrize("name", NAMES)
def test_none_shimmers_at_any_level(name):
    for level in LEVELS:
        _shimmers_little(name, level)


def _shimmers_little(name, level):
    made = expression({"text": written_library()[name].text}, -4)
    period = 2.0 ** (level + 6)
    rect = Rect.at(int(5.37 * period), int(3.81 * period), 24, 24)
    woven = woven_line(made.text, made.values, (), 0, level, made.period)
    most = SHIMMER if woven.rough or woven.jumps else SHIMMER_EXACT
    assert shimmer(made, level, rect).rms * 255.0 <= most, level
