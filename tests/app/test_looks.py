"""Every look of the window can be read: contrasts of texts and of controls are those of WCAG 2.1, AA."""

import pytest

from app import theme
from app.theme.looks import (
    CONTROL_CONTRAST,
    CONTROLS,
    LOOKS,
    TEXT_CONTRAST,
    TEXTS,
    USUAL_LOOK,
    WindowLook,
    contrast,
    tone_over,
)
from engine.keeping.preferences import LOOK_NAMES, Preferences


def test_contrasts_are_those_of_the_standard():
    assert contrast((0, 0, 0), (1, 1, 1)) == pytest.approx(21)
    assert contrast((0.4, 0.4, 0.4), (1, 1, 1)) == pytest.approx(5.74, abs=0.01)  # of WebAIM's table: #666


def test_preferences_know_the_looks():
    assert tuple(LOOKS) == LOOK_NAMES
    assert Preferences().look == USUAL_LOOK


@pytest.mark.parametrize("name", LOOKS)
def test_all_texts_and_controls_stand_out_from_what_they_lie_on(name):
    look, low = LOOKS[name], []
    for pairs, least in ((TEXTS, TEXT_CONTRAST), (CONTROLS, CONTROL_CONTRAST)):
        for upper, grounds in pairs.items():
            for ground in grounds:
                found = contrast(getattr(look, upper), getattr(look, ground))
                low += [(upper, ground, round(found, 2))] if found < least else []
    for ground in ("panel", "popup", "shade"):  # what cannot be used is drawn less opaque
        found = contrast(tone_over(look.quiet, getattr(look, ground), look.dimmed), getattr(look, ground))
        low += [("dimmed", ground, round(found, 2))] if found < CONTROL_CONTRAST else []
    assert not low


def test_every_colour_is_of_a_look_and_every_tone_is_checked_or_adorns():
    tones = {name for name in WindowLook._fields if name not in ("title", "hint", "frames", "dimmed")}
    checked = {*TEXTS, *CONTROLS, *(ground for grounds in (*TEXTS.values(), *CONTROLS.values()) for ground in grounds)}
    assert tones - checked == {"line", "border", "grid"}
    assert set(theme.GROUNDS.values()) <= tones
