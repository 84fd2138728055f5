"""Texts in another language: found whole, by their form, by their parts; what is the artist's own stays."""

import pytest

from app.language import words
from app.language.words import Words
from app.panels.controls import widgets

CATALOGUE = {
    "Open": "Öffnen",
    "Save the painting": "Das Bild sichern",
    "Opening {name}": "{name} wird geöffnet",
    "{count} more, {hint}": "noch {count}, {hint}",
    "Growing {part} %": "Wächst, {part} %",
    "Size": "Größe",
    "far from it": "weit davon",
    "A lag: the faster": "Verzug, je schneller",
    "{name} is “{title}” already": "{name} ist schon „{title}“",
}


@pytest.fixture
def german(monkeypatch):
    found = Words("de", CATALOGUE)
    monkeypatch.setattr(words, "_spoken", found)
    return found


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("Open", "Öffnen"),
        ("\ue123  Open", "\ue123  Öffnen"),
        ("   Open", "   Öffnen"),
        ("Open\nSize", "Öffnen\nGröße"),
        ("Save the painting  (Ctrl+S)", "Das Bild sichern  (Ctrl+S)"),
        ("Opening Size", "Size wird geöffnet"),
        ("3 more, Size", "noch 3, Größe"),
        ("Growing 55 %", "Wächst, 55 %"),
        ("Ctrl+S is “Open” already", "Ctrl+S ist schon „Öffnen“"),
        ("Size: A lag: the faster", "Größe: Verzug, je schneller"),
        ("Far from it", "Weit davon"),
        ("Save the painting.  Open", "Das Bild sichern.  Öffnen"),
        ("Nothing of this", "Nothing of this"),
        ("", ""),
        ("  ", "  "),
    ],
)
def test_a_text_is_found_whole_by_its_form_or_by_its_parts(german, text, told):
    assert words.say(text) == told
    assert words.say(text) == told  # and so it is the next time


def test_a_control_keeps_its_english_identity(german):
    assert words.labelled("Open") == "Öffnen###Open"
    assert words.labelled("Open##file") == "Öffnen###Open##file"
    assert words.labelled("Open###dialog") == "Öffnen###dialog"
    assert words.labelled("##Open") == "##Open"
    assert words.labelled("Nothing") == "Nothing"
    assert words.meant("Öffnen") == "Open"
    assert words.meant("other") == "other"


def test_nothing_is_spoken_but_english_where_nothing_is_chosen(monkeypatch):
    monkeypatch.setattr(words, "_spoken", None)
    assert words.labelled("Open") == "Open"
    for name in ("LC_ALL", "LC_MESSAGES"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("LANG", "tlh_QO.UTF-8")
    assert words.read_words("") is None
    assert words.say("Open") == "Open"
    assert words.read_catalogue("tlh") == {}


def test_a_slider_may_show_a_word_in_place_of_its_number(german):
    assert widgets.told_number("auto", 0.0) == "auto"
    assert widgets.told_number("%.0f%%", 40.0) == "40%"
