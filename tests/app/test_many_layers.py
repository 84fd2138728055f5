"""A list of a thousand layers: only the rows that are seen are drawn."""

from types import SimpleNamespace

import pytest
from imgui_bundle import ImVec2, imgui

from app.panels.layers.layers_panel import LayersPanel
from engine.studio.results import LayerRow

COUNT = 1000


@pytest.fixture
def drawn(monkeypatch):
    """Draws a panel in a window 400 pixels high; gives the names of the rows that are drawn."""
    context = imgui.create_context()
    io = imgui.get_io()
    io.display_size, io.delta_time = (800, 600), 0.02
    io.backend_flags |= imgui.BackendFlags_.renderer_has_textures
    names: list[str] = []

    def row(panel, desk, found):
        names.append(found.name)
        imgui.dummy(ImVec2(10, imgui.get_frame_height()))

    monkeypatch.setattr(LayersPanel, "_row", row)
    desk = SimpleNamespace(scale=1.0, known=SimpleNamespace(scene=None))

    def draw(panel, rows):
        for _ in range(3):
            names.clear()
            imgui.new_frame()
            imgui.set_next_window_size(ImVec2(300, 400))
            imgui.begin("window")
            panel._list(desk, rows)
            imgui.end()
            imgui.render()
        return list(names)

    yield draw
    imgui.destroy_context(context)


def rows(depth=lambda n: 0, group=lambda n: False):
    return tuple(
        LayerRow(f"Layer {n}", group(n), depth(n), None, n, 1.0, True, "src-over", False, False) for n in range(COUNT)
    )


def test_only_rows_that_are_seen_are_drawn(drawn):
    found = drawn(LayersPanel(), rows())
    assert found[:8] == [f"Layer {n}" for n in range(8)]
    assert len(found) < 60


def test_the_row_that_is_renamed_is_drawn_wherever_it_is(drawn):
    panel = LayersPanel()
    panel._editing = "Layer 700"
    found = drawn(panel, rows())
    assert "Layer 700" in found
    assert len(found) < 60


def test_rows_in_a_folded_group_are_left_out(drawn):
    panel = LayersPanel()
    panel._folded = {"Layer 1", "Layer 3"}
    depths = {2: 1, 3: 1, 4: 2, 5: 2}
    found = drawn(panel, rows(lambda n: depths.get(n, 0), lambda n: n in (1, 3)))
    assert found[:5] == ["Layer 0", "Layer 1", *(f"Layer {n}" for n in (6, 7, 8))]
