"""The panels' picture: whatever changes in them, the screen shows what imgui would have drawn anew."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from imgui_bundle import ImVec2, imgui
from imgui_bundle.imgui import backends

from app import theme
from app.canvas.gallery import Gallery
from app.canvas.overlay import NOTHING, Overlay, Sheet, grouped_sheets

SIZE = (320, 240)
_PLAIN = (
    imgui.WindowFlags_.no_title_bar
    | imgui.WindowFlags_.no_resize
    | imgui.WindowFlags_.no_move
    | imgui.WindowFlags_.no_saved_settings
)


@pytest.fixture(scope="module")
def panels(context):
    """OpenGL without a display, and imgui that draws with it."""
    imgui.create_context()
    imgui.get_io().set_ini_filename("")
    theme.load_fonts(imgui.get_io())
    theme.apply(1.0)
    backends.opengl3_init("#version 330")
    yield context
    backends.opengl3_shutdown()
    imgui.destroy_context()


class Stage:
    """A screen without a window; `draw` gives its pictures by two overlays: one that goes on, one that begins anew."""

    def __init__(self, ctx):
        self.ctx = ctx
        self.target = ctx.simple_framebuffer(SIZE)
        self.overlay = Overlay(ctx, self.target)

    def draw(self, show, pointer=(-9, -9), fresh=frozenset()):
        io = imgui.get_io()
        io.display_size, io.delta_time = ImVec2(*SIZE), 0.1
        io.add_mouse_pos_event(*pointer)
        backends.opengl3_new_frame()
        imgui.new_frame()
        show()
        imgui.render()
        data = imgui.get_draw_data()
        lists = list(data.cmd_lists)
        return self._picture(data, lists, self.overlay, fresh), self._picture(data, lists, None, frozenset())

    def _picture(self, data, lists, overlay, fresh):
        self.target.use()
        self.target.clear(0.2, 0.5, 0.3, 1.0)
        data.cmd_lists.clear()
        for one in lists:
            data.cmd_lists.push_back(one)
        if overlay is None:
            backends.opengl3_render_draw_data(data)
        else:
            self.changed = overlay.look(data, SIZE, fresh)
            overlay.redraw(data)
            overlay.draw(data)
        return np.frombuffer(self.target.read(), np.uint8).reshape(SIZE[1], SIZE[0], 3)[::-1].astype(int)


@pytest.fixture
def stage(panels):
    return Stage(panels)


def window(name, x, y, width, height, text, alpha=1.0, picture=None):
    imgui.set_next_window_pos(ImVec2(x, y))
    imgui.set_next_window_size(ImVec2(width, height))
    imgui.set_next_window_bg_alpha(alpha)
    imgui.begin(name, None, _PLAIN)
    imgui.text(text)
    imgui.button("press")
    if picture is not None:
        imgui.image(picture, ImVec2(60, 40))
    imgui.end()


LAYOUTS = st.lists(
    st.lists(
        st.tuples(st.integers(-40, 300), st.integers(-40, 220), st.integers(40, 160), st.integers(40, 120))
        | st.just((0, 0, 100, 240)),
        max_size=4,
    ),
    min_size=2,
    max_size=4,
)


@settings(deadline=None, max_examples=40)
@given(LAYOUTS, st.sampled_from((1.0, 0.5)))
def test_the_screen_shows_what_imgui_would_have_drawn_anew(panels, layouts, alpha):
    stage = Stage(panels)
    for n, boxes in enumerate(layouts):

        def show(n=n, boxes=boxes):
            for k, box in enumerate(boxes):
                window(f"window {k}", *box, f"text {n // 2}", alpha)

        kept, anew = stage.draw(show, pointer=(60, 60))
        assert abs(kept - anew).max() <= (1 if alpha == 1.0 else 3)


@pytest.fixture
def redrawn(monkeypatch):
    """The boxes that are drawn anew."""
    boxes = []
    draw = Overlay._render_box
    monkeypatch.setattr(
        Overlay, "_render_box", lambda self, data, box, lists: (boxes.append(box), draw(self, data, box, lists))
    )
    return boxes


def test_what_did_not_change_is_not_drawn_anew(stage, redrawn):
    def show(text):
        window("left", 0, 0, 100, 200, "still")
        window("below", 0, 200, 320, 40, text)

    stage.draw(lambda: show("10 %"))
    stage.draw(lambda: show("10 %"))
    redrawn.clear()
    stage.draw(lambda: show("10 %"))
    assert redrawn == []
    assert not stage.changed
    stage.draw(lambda: show("20 %"))
    assert stage.changed
    assert redrawn == [(0, 200, 320, 240)]


def test_only_windows_with_a_picture_that_changed_are_drawn_anew(stage, redrawn):
    shown = {}
    gallery = Gallery(stage.ctx, shown)
    for name in ("one", "other"):
        gallery.hang(name, np.full((20, 30, 4), 255, np.uint8))

    def show():
        window("left", 0, 0, 100, 200, "still")
        for n, name in enumerate(("one", "other")):
            window(name, 110 * n + 100, 0, 100, 200, name, picture=shown[name])

    stage.draw(show, fresh=gallery.fresh())
    stage.draw(show, fresh=gallery.fresh())
    redrawn.clear()
    gallery.hang("other", np.zeros((20, 30, 4), np.uint8) + np.array([0, 0, 0, 255], np.uint8))
    kept, anew = stage.draw(show, fresh=gallery.fresh())
    assert redrawn == [(210, 0, 310, 200)]
    assert stage.changed
    assert abs(kept - anew).max() <= 1
    redrawn.clear()
    stage.draw(show, fresh=gallery.fresh())
    assert redrawn == []


def test_a_small_window_goes_from_the_screen_again(stage):
    def show(tip):
        window("left", 0, 0, 100, 240, "panel")
        if tip:
            window("tip", 60, 60, 120, 60, "what it is for", 0.9)

    before, _ = stage.draw(lambda: show(False))
    above, _ = stage.draw(lambda: show(True))
    after, _ = stage.draw(lambda: show(False))
    assert (above != before).any(axis=-1)[60:120, 100:180].all()
    assert np.array_equal(before, after)


def test_what_is_drawn_below_all_windows_is_never_kept(stage):
    def show(x):
        imgui.get_background_draw_list().add_circle_filled(ImVec2(x, 120), 20, 0xFFFFFFFF)
        window("left", 0, 0, 100, 240, "panel")

    for x in (200, 240, 90):
        kept, anew = stage.draw(lambda x=x: show(x))
        assert np.array_equal(kept, anew)
        assert stage.changed
    assert (kept[120, 105] == 255).all()
    assert (kept[120, 80] != 255).any()


BOXES = st.tuples(*[st.integers(0, 60)] * 4).map(lambda b: (b[0], b[1], b[0] + b[2] // 3 + 1, b[1] + b[3] // 3 + 1))


@given(st.lists(BOXES | st.just(NOTHING), max_size=12))
def test_groups_do_not_overlap_and_keep_the_order(boxes):
    sheets = [Sheet(((), b"", b"", SIZE), box) for box in boxes]
    groups = grouped_sheets(sheets)
    places = [n for group in groups for n in group.lists]
    assert sorted(places) == [n for n, box in enumerate(boxes) if box != NOTHING]
    for group in groups:
        assert list(group.lists) == sorted(group.lists)
        assert group.sheets == tuple(sheets[n] for n in group.lists)
        lefts, tops, rights, bottoms = zip(*(boxes[n] for n in group.lists), strict=True)
        assert group.box == (min(lefts), min(tops), max(rights), max(bottoms))
    counts = np.zeros((100, 100), int)
    for group in groups:
        x0, y0, x1, y1 = group.box
        counts[y0:y1, x0:x1] += 1
    assert counts.max() <= 1


def test_windows_side_by_side_are_groups_of_their_own():
    sheets = [Sheet(((), b"", b"", SIZE), box) for box in ((0, 0, 10, 20), (10, 0, 30, 20), (0, 20, 30, 30))]
    assert [group.box for group in grouped_sheets(sheets)] == [sheet.box for sheet in sheets]


def test_of_pictures_of_steps_the_newest_hang(context):
    shown = {}
    gallery = Gallery(context, shown)
    for n in range(300):
        for name in ("brush", f"step 0.{n}", "step 0.299"):
            gallery.hang(name, np.zeros((2, 2, 4), np.uint8))
    assert set(shown) == {"brush", "step 0.299", *(f"step 0.{n}" for n in range(44, 299))}
