"""Fonts for languages that need another one: one of the system's, else a small one that comes along."""

import pytest

import texts
from app.desk.preferring.speaking import SpeakLanguage
from app.language import wide_fonts
from app.language.words import LANGUAGES, read_catalogue

WIDE = ("ja", "zh_CN")


@pytest.mark.parametrize("code", WIDE)
def test_the_font_that_comes_along_has_all_letters_of_its_catalogue(code, monkeypatch):
    from PIL import ImageFont

    monkeypatch.setattr(wide_fonts, "_files", lambda: iter(()))
    path = wide_fonts.wide_font(code)
    assert path == texts.CATALOGUES / f"NotoSansCJK-{code}.otf"
    font = ImageFont.truetype(str(path), 20)
    missing = bytes(font.getmask("\uffff"))
    for letter in set("".join(read_catalogue(code).values())):
        assert letter.isascii() or bytes(font.getmask(letter)) != missing or letter == " ", letter


def test_each_language_is_called_as_it_calls_itself():
    from PIL import ImageFont

    font = ImageFont.truetype(str(texts.CATALOGUES / "NotoSansCJK-names.otf"), 20)
    for name in LANGUAGES.values():
        assert name[0].isascii() or all(font.getmask(letter).getbbox() for letter in name), name


def test_one_of_the_system_s_comes_first(tmp_path, monkeypatch):
    names = ("msgothic.ttc", "NotoSansCJK-Regular.ttc", "other.ttf")
    monkeypatch.setattr(wide_fonts, "_files", lambda: iter([tmp_path / name for name in names]))
    assert wide_fonts.wide_font("ja") == tmp_path / "msgothic.ttc"
    assert wide_fonts.wide_font("zh_CN") == tmp_path / "NotoSansCJK-Regular.ttc"
    assert wide_fonts.wide_font("de") is None
    words, font = SpeakLanguage("de").carry_out()
    assert (words.code, font) == ("de", None)
    assert words.of("Save") == "Speichern"


def test_without_a_font_english_is_spoken():
    assert wide_fonts.load_wide_font("de", None)
    assert not wide_fonts.load_wide_font("ja", None)
