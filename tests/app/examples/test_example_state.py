"""The palette of examples without a window: what is in it, and what the brush gets."""

from dataclasses import asdict, replace

import pytest
from examples_at_hand import named, scene_with
from immutables import Map

from app.desk import palette
from app.desk.examples import example_pictures, example_state, example_use, example_work, thumbnails
from app.desk.presets import Preset
from engine.brush.settings import Brush
from engine.makers.definitions import defined_by
from engine.painting.commands import Swap, to_json
from engine.studio.requests import Do, Swatch


def test_all_bundled_examples_are_listed_by_group(desk):
    state = desk.examples
    assert len(state.entries) == len(list(example_state.bundled_folder().glob("*.toml"))) >= 10
    assert state.groups()[:2] == ["Watercolour", "Paper"]
    assert all(entry.mask is not None for entry in state.entries)
    state.group = "Watercolour"
    assert {example_state.label(entry, state.entries) for entry in state.listed()} >= {"Indigo", "Sap green"}
    assert named(desk, "wash-indigo").title == "Wash indigo"
    assert desk.message[0] == ""


def test_the_brush_grows_what_was_chosen_and_the_painting_gets_it_with_the_first_stroke(desk, posted):
    desk.hand.take(Brush(radius=1.0, mode="paint", hardness=0.2))
    example_use.choose(desk, named(desk, "felt"))
    assert (desk.hand.brush.mode, desk.hand.brush.example, desk.hand.brush.depth) == ("example", "Felt", 0.0)
    assert desk.hand.brush.radius > 10
    assert not posted
    usual = asdict(named(desk, "felt").parameters)
    assert [to_json(need) for need in desk.hand.needs] == [
        {"do": "texture", "name": "Felt", "maker": "example", "bundled": "felt", **usual, "detail": "learnt"}
    ]
    level, brush = desk.stroke_brush(eraser=False)
    assert (level, brush.example_level, brush.example_detail) == (0, 0, 0)


@pytest.mark.parametrize(("size", "level", "detail"), [(-2, 5, 2), (-1, 5, 1), (0, 5, 0), (1, 4, 0), (2, 3, 0)])
def test_sizes_go_by_the_zoom_at_which_it_was_chosen(desk, size, level, detail):
    desk.view = desk.view.zoomed(5)
    example_use.choose(desk, named(desk, "felt"))
    desk.examples.size = size
    example_use.follow(desk)
    desk.view = desk.view.zoomed(-3)
    assert (desk.hand.brush.example_level, desk.hand.brush.example_detail) == (level, detail)
    example_use.fit_size(desk)
    assert desk.hand.brush.example_level == level - 3


def test_strokes_too_far_from_the_size_fit_it_anew(desk):
    example_use.choose(desk, named(desk, "felt"))
    for levels, fitted in ((8, False), (-13, True), (-1, False)):
        desk.view = desk.view.zoomed(levels)
        before = desk.hand.brush.example_level
        example_use.fit_within_reach(desk)
        assert (desk.hand.brush.example_level != before) == fitted
        level, brush = desk.stroke_brush(eraser=False)
        assert abs(brush.example_level - level) <= 8


def test_another_example_chosen_near_by_has_the_same_pixels_and_far_away_its_own(desk):
    example_use.choose(desk, named(desk, "felt"))
    desk.view = desk.view.zoomed(1)
    example_use.choose(desk, named(desk, "turf"))
    assert desk.hand.brush.example_level == 0
    desk.view = desk.view.zoomed(3)
    example_use.choose(desk, named(desk, "felt"))
    assert desk.hand.brush.example_level == 4


def test_the_eraser_takes_everything_or_one_depth(desk):
    example_use.choose(desk, named(desk, "felt"))
    desk.examples.depth = 3
    example_use.follow(desk)
    _, brush = desk.stroke_brush(eraser=True)
    assert (brush.mode, brush.depth) == ("erase", None)
    desk.examples.eraser = 2
    _, brush = desk.stroke_brush(eraser=True)
    assert brush.depth == 2.0
    _, brush = desk.stroke_brush(eraser=False)
    assert (brush.mode, brush.depth) == ("example", 3.0)


def test_a_kept_brush_with_an_example_fits_what_is_seen(desk):
    example_use.choose(desk, named(desk, "felt"))
    desk.examples.size, desk.examples.depth = -1, 2
    example_use.follow(desk)
    preset = Preset("Mine", desk.hand.brush, textures=palette.belonging(desk)[0])
    desk.examples.size, desk.examples.depth, desk.examples.chosen = 0, 0, ""
    desk.view = desk.view.zoomed(20)
    palette.take(desk, preset)
    example_use.adopt(desk)
    state = desk.examples
    assert (state.entry.name, state.size, state.depth) == ("felt", -1, 2)
    assert (desk.hand.brush.example_level, desk.hand.brush.example_detail, desk.hand.brush.depth) == (20, 1, 2.0)


def test_growing_without_an_example_opens_the_palette_and_takes_its_first(desk):
    desk.strip, desk.examples.tab = "", "settings"
    example_use.take_example(desk)
    assert (desk.strip, desk.examples.tab) == ("examples", "palette")
    assert (desk.hand.brush.mode, desk.examples.entry) == ("example", desk.examples.listed()[0])
    desk.examples.entries = ()
    desk.hand.take(Brush())
    example_use.take_example(desk)
    assert desk.hand.brush.mode == "paint"


def test_a_swap_defines_the_example_and_names_the_pixel(desk, posted):
    example_use.choose(desk, named(desk, "felt"))
    desk.examples.swapping = True
    example_use.swap(desk, 430.0, 300.0)
    assert not desk.examples.swapping
    assert [type(request) for request in posted] == [Do, Do]
    assert posted[1].command == Swap(0, (30, 0), "Felt")


def test_settings_are_told_where_they_differ_and_are_used_on_demand(desk):
    entry = named(desk, "felt")
    example_use.choose(desk, entry)
    state = desk.examples
    state.set(entry, "kappa", 9.0)
    assert state.tried(entry)
    usual = {"bundled": "felt", "detail": "learnt", **asdict(entry.parameters)}
    assert dict(state.command(entry).arguments) == usual
    assert dict(state.command(entry, draft=True).arguments) == usual | {"kappa": 9.0}
    example_work.use_settings(desk)
    assert not state.tried(entry)
    assert desk.hand.needs[-1].arguments["kappa"] == 9.0
    state.reset(entry)
    assert state.tried(entry)
    example_work.use_settings(desk)
    assert dict(desk.hand.needs[-1].arguments) == usual
    assert not defined_by(desk.hand.needs[-1], "example", usual | {"kappa": 9.0})  # the painting gets it anew


def test_the_sample_stroke_is_asked_for_when_it_changes_and_not_too_often(desk, posted):
    entry, state = named(desk, "felt"), desk.examples
    example_use.choose(desk, entry)
    state.tab, state.sampled = "settings", (200, 100)
    for now in (10.0, 10.01, 10.5):
        example_pictures.ask_sample(state, posted.append, now)
    assert len(posted) == 1
    for k, now in enumerate((11.0, 11.01, 11.02, 11.2)):
        state.set(entry, "kappa", float(k))
        example_pictures.ask_sample(state, posted.append, now)
    assert [type(request) for request in posted] == [Swatch] * 3
    assert posted[-1].textures[0].arguments["kappa"] == 3.0
    assert "detail" not in posted[-1].textures[0].arguments  # nothing of it would be seen
    assert state.at_home(replace(desk.hand.brush, example_level=77)).example_level == 0


def test_examples_that_only_the_painting_has_are_listed_and_painted_with(desk, posted):
    """Neither those that come along, as they came or with other settings in use, nor the artist's own."""
    felt = named(desk, "felt")
    plain = {"bundled": "felt", "detail": "learnt", **asdict(felt.parameters)}
    desk.examples.used[felt.ident] = Map(kappa=9.0)
    lost = {"path": "/nowhere/rag.png", "sha": "1"}
    given = (("Felt", plain), ("F", plain | {"kappa": 9.0}), ("G", plain | {"kappa": 8.0}), ("Rag", lost))
    desk.learn(scene=scene_with(*given))
    count = len(desk.examples.entries)
    example_use.gather(desk)
    example_use.gather(desk)
    state = desk.examples
    state.group = example_state.HERE
    assert [entry.title for entry in state.listed()] == ["G", "Rag"]
    assert example_state.label(state.listed()[1], state.entries) == "Rag"
    assert len(state.entries) == count + 2
    example_use.choose(desk, named(desk, "Rag"))
    assert (desk.hand.brush.mode, desk.hand.brush.example, desk.hand.needs) == ("example", "Rag", ())
    example_use.swap(desk, 430.0, 300.0)
    assert [request.command for request in posted] == [Swap(0, (30, 0), "Rag")]
    desk.learn(scene=scene_with())
    example_use.gather(desk)
    assert (state.entry, state.group, len(state.entries)) == (None, example_state.ALL, count)


def test_their_thumbnails_are_strokes_asked_for_once(desk, posted):
    made = thumbnails.Shelf(lambda: None)
    desk.learn(scene=scene_with(("Rag", {"sha": "1"})))
    example_use.gather(desk)
    state = desk.examples
    made.ask((named(desk, "Rag"),), 32)
    assert made.take() == []
    for side in (60, 60, 90):
        example_pictures.ask_thumbnails(state, posted.append, side)
    desk.learn(scene=scene_with(("Rag", {"sha": "2"})))
    example_use.gather(desk)
    example_pictures.ask_thumbnails(state, posted.append, 90)
    assert [(swatch.ident, swatch.size[0]) for swatch in posted] == [("example here Rag", n) for n in (60, 90, 90)]
    example_use.choose(desk, named(desk, "Rag"))
    state.sampled = (200, 100)
    example_pictures.ask_sample(state, posted.append, 10.0)
    assert (posted[-1].brush.example, posted[-1].textures) == ("Rag", ())
