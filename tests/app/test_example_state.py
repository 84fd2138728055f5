"""The palette of examples without a window: what is in it, what the brush gets, and the artist's own."""

from dataclasses import asdict, replace

import numpy as np
import pytest
from immutables import Map
from PIL import Image

from app import icons, tools
from app.actions import ACTIONS
from app.canvas.view import Place, View
from app.cursor import apart
from app.desk import example_state, example_use, example_work, own_example_files, palette, thumbnails
from app.desk.desk import Desk
from app.desk.example_state import Entry
from app.desk.files import carried_out
from app.desk.presets import Preset
from app.desk.region_state import EVERYTHING, INVERTED, SMOOTHED
from app.desk.stock import TakeStock
from app.input.events import PenEvent
from app.panels import status
from app.panels.examples.examples_panel import tile
from app.panels.strip import StripPanel
from engine.brush.settings import Brush
from engine.makers.definitions import defined_by
from engine.numeric.address import Rect
from engine.painting.commands import Swap, parse, to_json
from engine.session.session import Session
from engine.studio.region import Regions
from engine.studio.requests import Do, GetReady, RegionClose, Swatch
from engine.studio.results import Growing, RegionScene, Scene, Writing
from engine.texture.example.parameters import Parameters


@pytest.fixture
def own(tmp_path, monkeypatch):
    monkeypatch.setattr(example_state, "own_folder", lambda: tmp_path / "examples")
    return tmp_path / "examples"


@pytest.fixture
def posted():
    return []


@pytest.fixture
def desk(own, posted):
    made = Desk(View(Place(0, 0, 0), 0, 0.0, 800, 600), posted.append)
    regions = Regions(lambda r: example_work.told(made, r) if isinstance(r, RegionScene) else None)

    def post(request):
        """Regions are painted at once; all else that is asked for is only noted."""
        if type(request) not in regions.handlers:
            posted.append(request)
            return
        regions.handlers[type(request)](request)
        while regions.pending:
            regions.step()

    made.post = post
    made.learn(ready=True)
    made.strip = "examples"
    made.work = lambda work: carried_out(work).arrive(made)
    made.work(TakeStock())
    return made


def named(desk, name):
    return next(entry for entry in desk.examples.entries if entry.name == name)


def picture(path, size=(40, 30), mode="RGBA"):
    pixels = np.random.default_rng(3).integers(0, 255, (size[1], size[0], 4)).astype(np.uint8)
    pixels[..., 3] = np.where(np.arange(size[0]) < size[0] // 2, 255, 0)
    Image.fromarray(pixels).convert(mode).save(path)
    return path


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
        {"do": "texture", "name": "Felt", "maker": "example", "bundled": "felt", **usual}
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
    example_use.fit(desk)
    assert desk.hand.brush.example_level == level - 3


def test_strokes_too_far_from_the_size_fit_it_anew(desk):
    example_use.choose(desk, named(desk, "felt"))
    for levels, fitted in ((8, False), (-13, True), (-1, False)):
        desk.view = desk.view.zoomed(levels)
        before = desk.hand.brush.example_level
        example_use.reach(desk)
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


def test_growing_without_an_example_opens_the_palette(desk):
    desk.strip = ""
    example_use.take(desk)
    assert desk.strip == "examples"
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
    usual = {"bundled": "felt", **asdict(entry.parameters)}
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
        state.ask(posted.append, now)
    assert len(posted) == 1
    for k, now in enumerate((11.0, 11.01, 11.02, 11.2)):
        state.set(entry, "kappa", float(k))
        state.ask(posted.append, now)
    assert [type(request) for request in posted] == [Swatch] * 3
    assert posted[-1].textures[0].arguments["kappa"] == 3.0
    assert state.at_home(replace(desk.hand.brush, example_level=77)).example_level == 0


# --- the artist's own ------------------------------------------------------------------------------------------------


def test_a_dropped_picture_is_an_example_and_its_region_is_opened(desk, own, tmp_path):
    assert not example_work.dropped(desk, tmp_path / "a.ora")
    assert example_work.dropped(desk, picture(tmp_path / "My rock.png"))
    assert {path.name for path in own.iterdir()} == {"My rock.png", "My rock.mask.png", "My rock.toml"}
    state = desk.examples
    assert (state.entry.own, state.entry.group, state.tab) == (True, example_state.OWN, "region")
    assert state.region.scene.inside[:, :20].all()
    assert not state.region.scene.inside[:, 20:].any()
    assert desk.hand.brush.example == "My rock"
    example_work.add(desk, tmp_path / "My rock.png")
    assert state.entry.name == "My rock 2"
    desk.strip = ""
    assert not example_work.dropped(desk, tmp_path / "My rock.png")


def test_what_is_no_picture_is_told_and_leaves_nothing(desk, own, tmp_path):
    (tmp_path / "bad.png").write_bytes(b"no picture")
    example_work.add(desk, tmp_path / "bad.png")
    assert desk.message[1]
    assert not own.exists() or not list(own.iterdir())


def test_a_large_picture_is_made_smaller(desk, tmp_path):
    example_work.add(desk, picture(tmp_path / "wide.jpg", (2048, 20), "RGB"))
    assert desk.examples.region.scene.size == (1024, 10)
    assert "smaller" in desk.message[0]
    assert desk.examples.region.way == "colour"  # it has no holes: its background is to be clicked


def test_another_region_makes_another_texture_of_the_same_files(desk, tmp_path):
    example_work.add(desk, picture(tmp_path / "rock.png"))
    state = desk.examples
    first = state.command(state.entry)
    assert parse(to_json(first)) == first
    known = {**first.arguments}
    assert defined_by(first, "example", known)
    state.region.do(desk.post, EVERYTHING)
    assert state.region.scene.modified
    example_work.save_region(desk)
    second = state.command(state.entry)
    assert not defined_by(second, "example", known)
    assert own_example_files.cut_out(state.entry)[1].all()
    assert not state.region.scene.modified
    assert second.arguments["region"] == (EVERYTHING,)
    assert "mask" not in second.arguments  # it is told without the file
    assert parse(to_json(second)) == second


def made_of(entry, state):
    """The region that the example's definition means, to whoever carries it out."""
    session = Session()
    session.do(state.command(entry))
    (texture,) = session.painting.textures.values()
    return texture.mask.data[3] > 0.5


def read_again(desk):
    """As if the window were opened anew."""
    for ident in list(desk.examples.regions):
        desk.examples.regions.pop(ident)
        desk.post(RegionClose(ident))
    desk.work(TakeStock())


def test_a_region_that_was_painted_is_told_as_its_steps_and_made_again_of_them(desk, own, tmp_path):
    """What the definition means is what was saved; a mask that another program wrote since counts as it is."""
    example_work.add(desk, picture(tmp_path / "rock.png"))
    state = desk.examples
    for step in (EVERYTHING, Map({"op": "subtract", "stroke": Map({"points": ((20, 15), (30, 15))})}), SMOOTHED):
        state.region.do(desk.post, step)
    saved = state.region.scene
    assert 0.2 < saved.share < 0.9
    example_work.save_region(desk)
    assert np.array_equal(made_of(state.entry, state), saved.inside)
    # Read again, the steps can be taken back; a copy has them too.
    read_again(desk)
    example_work.keep_settings(desk)
    assert state.entry.name == "rock 2"
    assert state.entry.steps == saved.steps
    example_work.edit(desk)
    assert np.array_equal(state.region.scene.inside, saved.inside)
    state.region.travel(desk.post, -3)
    assert np.array_equal(state.region.scene.inside, np.broadcast_to(np.arange(40) < 20, (30, 40)))
    Image.fromarray(np.full((30, 40), 255, np.uint8)).save(own / "rock.mask.png")
    read_again(desk)
    assert named(desk, "rock").steps == ()
    assert "mask" in state.command(named(desk, "rock")).arguments


def test_a_mask_that_was_there_first_is_kept_for_the_steps_to_begin_with(desk, own, tmp_path):
    """As an example has it that was made before steps were told."""
    example_work.add(desk, picture(tmp_path / "rock.png"))
    first = np.zeros((30, 40), bool)
    first[5:25, 3:19] = True
    Image.fromarray((first * 255).astype(np.uint8)).save(own / "rock.mask.png")
    state = desk.examples
    for steps in (1, 2):
        read_again(desk)
        example_use.choose(desk, named(desk, "rock"))
        example_work.edit(desk)
        state.region.do(desk.post, INVERTED)
        example_work.save_region(desk)
        assert len(state.entry.steps) == steps
        assert np.array_equal(made_of(state.entry, state), first if steps == 2 else ~first)
    state.region.travel(desk.post, -2)
    assert np.array_equal(state.region.scene.inside, first)
    example_work.save_region(desk)
    assert {path.name for path in own.iterdir()} == {"rock.png", "rock.mask.png", "rock.toml"}


def test_more_steps_than_a_definition_may_have_are_not_told(desk, own, tmp_path):
    example_work.add(desk, picture(tmp_path / "rock.png"))
    own_example_files.write_region("rock", np.ones((30, 40), bool), (INVERTED,) * 5000)
    read_again(desk)
    assert named(desk, "rock").steps == ()
    assert own_example_files.cut_out(named(desk, "rock"))[1].all()


def test_a_bundled_region_is_saved_as_a_copy(desk, own):
    entry, state = named(desk, "felt"), desk.examples
    example_use.choose(desk, entry)
    example_work.edit(desk)
    state.region.do(desk.post, Map({"op": "add", "stroke": Map({"points": ((3, 3),)})}))
    state.set(entry, "kappa", 9.0)
    example_work.save_region(desk)
    assert state.region.scene.ident == "own felt"
    assert (state.entry.own, state.entry.name, state.entry.parameters.kappa) == (True, "felt", 9.0)
    assert "“Felt”" in desk.message[0]
    assert own_example_files.cut_out(state.entry)[1][3, 3]
    assert not own_example_files.cut_out(entry)[1][3, 3]
    state.region.do(desk.post, EVERYTHING)
    state.region.do(desk.post, INVERTED)
    example_work.save_region(desk)
    assert desk.message[1]
    assert own_example_files.cut_out(state.entry)[1].any()
    example_work.delete(desk, state.entry)
    assert not list(own.iterdir())
    assert state.entry is None


def test_ones_own_is_renamed_and_stays_so(desk, tmp_path):
    """Its files stay where paintings and brushes look for them."""
    example_work.add(desk, picture(tmp_path / "rock.png"))
    example_work.add(desk, picture(tmp_path / "sand.png"))
    state, path = desk.examples, named(desk, "rock").picture
    example_work.rename(desk, named(desk, "rock"), '  My "wet"\n rock ')
    assert named(desk, "rock").title == 'My "wet" rock'
    assert state.entry.name == "sand"  # which the brush goes on painting with
    example_work.rename(desk, state.entry, 'my "WET" rock')
    assert (state.entry.title, desk.hand.brush.example) == ('my "WET" rock 2', 'my "WET" rock 2')
    assert [need.name for need in desk.hand.needs] == ['my "WET" rock 2']
    example_work.rename(desk, state.entry, " \t")
    state.set(state.entry, "kappa", 9.0)
    example_work.use_settings(desk)
    desk.work(TakeStock())
    own = {entry.name: entry for entry in state.entries if entry.own}
    assert {name: entry.title for name, entry in own.items()} == {"rock": 'My "wet" rock', "sand": 'my "WET" rock 2'}
    assert own["rock"].picture == path
    assert own["sand"].parameters.kappa == 9.0
    example_work.rename(desk, own["sand"], "x" * 99)
    assert len(state.entry.title) == example_state.NAME_CAP


def test_who_paints_with_ones_own_is_told_and_keeps_on_painting_when_it_is_deleted(desk, tmp_path):
    example_work.add(desk, picture(tmp_path / "rock.png"))
    example_work.add(desk, picture(tmp_path / "sand.png"))
    rock, sand = named(desk, "rock"), named(desk, "sand")
    assert example_work.users(desk, rock) == ""
    mine = Preset("Mine", desk.hand.brush, textures=palette.belonging(desk)[0])
    desk.learn(presets=(mine, Preset("Pen", Brush(radius=3.0))))
    desk.learn(scene=scene_with(("Rock", {"path": str(rock.picture), "sha": "1"})))
    example_use.gather(desk)
    assert example_work.users(desk, rock) == "this painting"
    assert example_work.users(desk, sand) == "the brush “Mine”"
    example_work.delete(desk, sand)
    assert (desk.hand.brush.mode, desk.hand.preset, desk.examples.chosen) == ("paint", "Pen", "")
    example_use.choose(desk, rock)
    example_work.delete(desk, rock)
    assert (desk.hand.brush.example, desk.hand.needs) == ("Rock", ())
    assert desk.examples.entry.here is not None


def test_ones_own_settings_are_kept_in_its_file(desk, tmp_path):
    example_work.add(desk, picture(tmp_path / "rock.png"))
    state = desk.examples
    for name, value in (("kappa", 4.5), ("channels", "luminance"), ("feather", 0), ("neighbourhood", 5)):
        state.set(state.entry, name, value)
    example_work.use_settings(desk)
    (read,), faults = example_state.load(example_state.own_folder(), True)
    assert not faults
    assert read.parameters == replace(Parameters(), kappa=4.5, channels="luminance", feather=0, neighbourhood=5)
    example_work.keep_settings(desk)
    assert state.entry.name == "rock 2"
    assert state.entry.parameters == read.parameters


def test_a_file_of_parameters_that_is_none_is_told_by_its_line(own):
    own.mkdir()
    picture(own / "a.png")
    (own / "a.toml").write_text('group = "X"\nkappa = "much"\n')
    (entry,), (fault,) = example_state.load(own, True)
    assert entry.parameters == Parameters()
    assert fault.startswith("a.toml: line 2, kappa")


@pytest.mark.parametrize("stem", ["", "///", "..", "a\0b", "x" * 400, "Größe"])
def test_any_stem_makes_a_name(stem, own):
    name = own_example_files.free_name(stem)
    assert 0 < len(name) <= 40
    assert not set(name) & set("/\\\0.")


def test_a_thumbnail_is_cut_out_by_the_region(desk):
    seen = thumbnails.thumbnail(named(desk, "felt"), 64)
    assert seen.shape == (64, 64, 4)
    assert (seen[..., 3] == 255).all()
    assert (seen[0, 0, :3] == thumbnails.PAPER).all()
    assert (seen[32, 32, :3] != thumbnails.PAPER).any()


def test_thumbnails_are_made_once_and_again_for_another_region(desk, tmp_path):
    woken = []
    made = thumbnails.Shelf(lambda: woken.append(1))
    entry = named(desk, "felt")
    for known in (
        entry,
        entry,
        replace(entry, mask_sha="1"),
        Entry("no", "X", tmp_path / "no.png", None, Parameters(), True),
    ):
        made.ask((known,), 32)
        made._thread.join(20)
    assert [picture.ident for picture in made.take()] == ["example bundled felt"] * 2
    assert len(woken) == 2


def test_thumbnails_grow_into_the_room_that_there_is():
    assert tile(26, (450.0, 280.0), 6.0, 16.0, 1.0) == 68.0  # the list scrolls
    wide = tile(26, (1096.0, 330.0), 6.0, 16.0, 1.0)
    assert 68.0 < wide < 104.0
    assert -(-26 // int(1102 / (wide + 6))) * (wide + 22) <= 330
    assert tile(3, (1096.0, 330.0), 6.0, 16.0, 1.5) == 156.0


# --- gestures and keys -----------------------------------------------------------------------------------------------


def pen(kind, x, y, eraser=False):
    return PenEvent(kind, x, y, eraser=eraser)


@pytest.fixture
def region(desk):
    """A region on the screen, its corner at (100, 200), two pixels of the screen for each of its own."""
    example_use.choose(desk, named(desk, "felt"))
    example_work.edit(desk)
    desk.examples.spot = (100.0, 200.0, 2.0)
    return desk.examples.region


def test_a_stroke_in_the_region_paints_there_and_a_pens_eraser_paints_out(desk, region):
    before = region.scene.inside.copy()
    gesture = tools.paint_region(desk, pen("down", 110.0, 210.0))
    next(gesture)
    with pytest.raises(StopIteration):
        gesture.send(pen("up", 130.0, 210.0))
    assert region.scene.inside[5, 5:15].all()
    gesture = tools.paint_region(desk, pen("down", 110.0, 210.0, eraser=True))
    next(gesture)
    with pytest.raises(StopIteration):
        gesture.send(pen("up", 130.0, 210.0))
    assert not region.scene.inside[5, 5:15].any()
    assert region.way == "in"
    region.travel(desk.post, -2)
    assert (region.scene.inside == before).all()


def test_a_stroke_that_is_given_up_leaves_the_region_as_it_was(desk, region):
    before = region.scene.inside.copy()
    gesture = tools.paint_region(desk, pen("down", 110.0, 210.0))
    next(gesture)
    gesture.send(pen("move", 130.0, 210.0))
    gesture.close()
    assert (region.scene.inside == before).all()
    assert not region.scene.can_undo


def test_keys_over_the_region_are_the_regions(desk, region, posted):
    strip = StripPanel()
    desk.pointer.x, desk.pointer.y = 110.0, 210.0
    region.do(desk.post, INVERTED)
    assert strip.takes(desk, ACTIONS["undo"])
    assert not region.scene.can_undo
    radius = region.radius
    assert strip.takes(desk, ACTIONS["larger"])
    assert region.radius > radius
    assert not strip.takes(desk, ACTIONS["fit"])
    desk.pointer.x = 90.0  # beside it
    assert not strip.takes(desk, ACTIONS["redo"])
    assert not posted


def test_the_strip_is_as_tall_whatever_it_shows(desk):
    strip = StripPanel()
    heights = {strip.height(desk)}
    for desk.examples.tab in example_state.TABS:
        heights.add(strip.height(desk))
    assert len(heights) == 1
    desk.strip = ""
    assert strip.height(desk) == 0


def test_a_click_swaps_and_escape_does_not(desk, posted):
    example_use.choose(desk, named(desk, "felt"))
    desk.examples.swapping = True
    ACTIONS["escape"].do(desk)
    assert not desk.examples.swapping
    desk.examples.swapping = True
    gesture = tools.swap(desk, pen("down", 400.0, 300.0))
    next(gesture)
    gesture.close()
    assert desk.examples.swapping
    assert not posted
    gesture = tools.swap(desk, pen("down", 400.0, 300.0))
    next(gesture)
    with pytest.raises(StopIteration):
        gesture.send(pen("up", 402.0, 303.0))
    assert posted[-1].command.at == (2, 3)
    assert not desk.examples.swapping


def test_the_status_line_tells_how_far_it_is_grown_although_no_tiles_wait(desk):
    desk.learn(growing=Growing(0.42), pending=0)
    assert status._fields(desk, "")[0][0] == "growing 42 %"
    desk.learn(growing=None, pending=8)
    assert status._fields(desk, "")[0][0] == "8 tiles to do"
    desk.learn(writing=Writing(1, True, 0.4))
    assert status._fields(desk, "")[0][0] == f"{icons.DISK} Saving, growing 40 %"
    desk.learn(writing=Writing(1))
    assert status._fields(desk, "")[0][0] == f"{icons.DISK} Writing"


def test_marks_of_what_grows_do_not_lie_on_one_another():
    places = [(0.0, 0.0), (5.0, 5.0), (20.0, 0.0), (20.0, 1.0), (0.0, 11.0)]
    assert apart(places, 10.0) == [(0.0, 0.0), (20.0, 0.0), (0.0, 11.0)]


def test_the_engine_gets_ready_when_examples_are_used_once(desk, posted):
    desk.strip = ""
    example_use.prepare(desk, 1.0)
    assert not posted
    desk.strip = "examples"
    for now in (2.0, 3.0):
        example_use.prepare(desk, now)
    assert posted == [GetReady()]
    assert desk.known.preparing == 2.0
    assert "getting ready" in status._fields(desk, "")[0][0]


# --- of the painting -------------------------------------------------------------------------------------------------


def scene_with(*definitions):
    rows = tuple((name, "example", Map(told)) for name, told in definitions)
    return Scene(Rect(0, 0, 100, 80), (), None, False, False, False, None, definitions=(("R", "rock", Map()), *rows))


def test_examples_that_only_the_painting_has_are_listed_and_painted_with(desk, posted):
    """Neither those that come along, as they came or with other settings in use, nor the artist's own."""
    felt = named(desk, "felt")
    plain = {"bundled": "felt", **asdict(felt.parameters)}
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
        state.ask_thumbnails(posted.append, side)
    desk.learn(scene=scene_with(("Rag", {"sha": "2"})))
    example_use.gather(desk)
    state.ask_thumbnails(posted.append, 90)
    assert [(swatch.ident, swatch.size[0]) for swatch in posted] == [("example here Rag", n) for n in (60, 90, 90)]
    example_use.choose(desk, named(desk, "Rag"))
    state.sampled = (200, 100)
    state.ask(posted.append, 10.0)
    assert (posted[-1].brush.example, posted[-1].textures) == ("Rag", ())
