"""Hints are as large as their texts, from the frame on in which a text changes."""

from imgui_bundle import ImVec2, imgui

from app.panels.controls import widgets as w


def hinted(text):
    """The size of the hint after a frame with the pointer on a button of this hint."""
    imgui.get_io().delta_time = 1.0
    imgui.get_io().add_mouse_pos_event(50, 50)
    imgui.new_frame()
    imgui.set_next_window_pos(ImVec2(0, 0))
    imgui.begin("window")
    imgui.set_cursor_screen_pos(ImVec2(30, 40))
    imgui.button("button", ImVec2(80, 40))
    w.tooltip(text)
    imgui.end()
    imgui.render()
    found = imgui.internal.find_window_by_name("##Tooltip_00")
    return (found.size.x, found.size.y) if found is not None and found.active else None


def test_a_hint_whose_text_changes_under_the_pointer_is_whole_in_the_same_frame():
    context = imgui.create_context()
    imgui.get_io().set_ini_filename("")
    imgui.get_io().display_size = 800, 600
    imgui.get_io().backend_flags |= imgui.BackendFlags_.renderer_has_textures
    for _ in range(9):
        hinted("Short")
    long = "Its layer goes on below its own pixels, as they let expect: sharp edges, and grain where it has some"
    for text in ("Short\nand another line", long, "Short"):
        first = hinted(text)
        assert first is not None
        assert {hinted(text) for _ in range(3)} == {first}
    imgui.destroy_context(context)
