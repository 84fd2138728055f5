"""Texts that have less room than they take end with dots."""

import pytest
from imgui_bundle import imgui

from app.panels.controls.fitting import ended


@pytest.fixture
def frame():
    context = imgui.create_context()
    imgui.get_io().display_size = 800, 600
    imgui.get_io().backend_flags |= imgui.BackendFlags_.renderer_has_textures
    imgui.new_frame()
    yield
    imgui.end_frame()
    imgui.destroy_context(context)


@pytest.mark.parametrize("text", ["", "Ink pen", "New group “Reeds at the shore, behind the boat”", "wwwwwwwwwwww"])
def test_a_text_is_as_long_as_there_is_room(frame, text):
    whole = imgui.calc_text_size(text).x
    assert ended(text, whole) == text
    for width in (20.0, 50.0, 90.0, 200.0):
        shown = ended(text, width)
        assert imgui.calc_text_size(shown).x <= width
        assert shown == text or (shown.endswith("…") and text.startswith(shown[:-1]))
        assert (shown == text) == (whole <= width)
        if shown != text:  # nor would one letter more fit
            assert imgui.calc_text_size(text[: len(shown)].rstrip() + "…").x > width or text[len(shown) - 1] == " "
