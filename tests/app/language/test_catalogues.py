"""Catalogues: complete where they are to be, compiled, with the places of the English texts; and nothing is drawn past
them."""

import ast
import re

import pytest

import texts
from app.language.words import LANGUAGES, Words, read_catalogue

NOT_TEXTS = (texts.ROOT / "tests" / "not_texts.txt").read_text("utf-8").splitlines()
PLACES = re.compile(r"\{(\w+)\}")
CODES = sorted(path.stem for path in texts.CATALOGUES.glob("*.po"))
# imgui's own functions that draw a text, which `app.language.said` has, too.
DRAWING = {
    *("text_unformatted", "text_disabled", "text_colored", "text_wrapped", "text", "button", "small_button"),
    *("menu_item", "menu_item_simple", "begin_menu", "selectable", "checkbox", "radio_button", "begin_combo"),
    *("begin_popup_modal", "tree_node_ex", "collapsing_header", "input_text_with_hint", "set_tooltip", "add_text"),
}
# Where names of the artist's own are drawn, signs and numbers, or what was looked up before: by modules.
OWN = {
    *(
        "workshop.completion_list",
        "workshop.line_marks",
        "workshop.text_letters",
        "workshop.node_menus",
    ),  # what the artist writes
    *("brush.preset_tile", "examples.examples_panel", "controls.widgets", "dialogs.file_list", "menu_bar"),
    *("arranging.workspaces_dialog", "layers.layers_panel", "places.places_panel", "recent_menu", "recovery.cards"),
}


@pytest.fixture(scope="module")
def shown():
    return texts.texts()


@pytest.mark.parametrize("code", texts.COMPLETE)
def test_every_text_is_in_the_catalogues_that_are_complete(shown, code):
    has = texts.read_po(texts.CATALOGUES / f"{code}.po")
    lacking = [f"{where}: {text}" for text, where in shown.items() if not has.get(text) and text not in NOT_TEXTS]
    assert not lacking, "translate these, or name them in tests/not_texts.txt:\n" + "\n".join(lacking)


def test_what_is_no_text_is_still_there(shown):
    assert [text for text in NOT_TEXTS if text not in shown] == []


@pytest.mark.parametrize("code", CODES)
def test_catalogues_are_compiled_and_keep_the_places_of_texts(code):
    rows = texts.read_po(texts.CATALOGUES / f"{code}.po")
    assert read_catalogue(code) == {told: becomes for told, becomes in rows.items() if becomes}, "texts.py --compile"
    for told, becomes in rows.items():
        assert set(PLACES.findall(becomes)) <= set(PLACES.findall(told)), told
        assert becomes == becomes.strip() or told != told.strip() or becomes.startswith(" ;"), told
    assert code in LANGUAGES


def test_nothing_is_drawn_past_the_languages():
    past = []
    for file in sorted((texts.ROOT / "app" / "panels").rglob("*.py")):
        name = ".".join(file.relative_to(texts.ROOT / "app" / "panels").with_suffix("").parts)
        for node in ast.walk(ast.parse(file.read_text())):
            if name in OWN or not isinstance(node, ast.Call) or not isinstance(node.func, ast.Attribute):
                continue
            if node.func.attr in DRAWING and getattr(node.func.value, "id", "") not in ("said", "w"):
                past.append(f"{name}:{node.lineno}: {node.func.attr}")
    assert past == []


@pytest.mark.parametrize("code", texts.COMPLETE)
def test_every_form_finds_its_text(code):
    words = Words(code, read_catalogue(code))
    for told in read_catalogue(code):
        filled = PLACES.sub("7", told)
        if PLACES.search(told) and re.sub(r"\{\w+\}", "", told).strip(" .,×px%°"):
            assert "{" not in words.of(filled), told
