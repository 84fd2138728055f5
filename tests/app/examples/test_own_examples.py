"""The artist's own examples: pictures, regions, names, settings and files."""

from dataclasses import replace

import numpy as np
import pytest
from examples_at_hand import named, picture, scene_with
from immutables import Map
from PIL import Image

from app.desk import palette
from app.desk.examples import example_state, example_use, example_work, own_example_files
from app.desk.examples.region_state import EVERYTHING, INVERTED, SMOOTHED
from app.desk.presets import Preset
from app.desk.stock import TakeStock
from engine.brush.settings import Brush
from engine.makers.definitions import defined_by
from engine.painting.commands import parse, to_json
from engine.session.session import Session
from engine.studio.textures.texture_requests import RegionClose
from engine.texture.example.parameters import NEW


def test_a_dropped_picture_is_an_example_and_its_region_is_opened(desk, own, tmp_path):
    assert not example_work.dropped(desk, tmp_path / "a.ora")
    assert example_work.dropped(desk, picture(tmp_path / "My rock.png"))
    assert {path.name for path in own.iterdir()} == {"My rock.png", "My rock.mask.png", "My rock.toml"}
    state = desk.examples
    assert (state.entry.own, state.entry.group, state.tab) == (True, example_state.OWN, "region")
    assert state.region.scene.inside[:, :20].all()
    assert not state.region.scene.inside[:, 20:].any()
    assert desk.hand.brush.example == "My rock"
    state.tab = "palette"
    example_work.add(desk, tmp_path / "My rock.png", shown=False)
    assert (state.entry.name, state.tab) == ("My rock 2", "palette")
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
    example_work.delete_example(desk, state.entry)
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
    example_work.delete_example(desk, sand)
    assert (desk.hand.brush.mode, desk.hand.preset, desk.examples.chosen) == ("paint", "Pen", "")
    example_use.choose(desk, rock)
    example_work.delete_example(desk, rock)
    assert (desk.hand.brush.example, desk.hand.needs) == ("Rock", ())
    assert desk.examples.entry.here is not None


def test_ones_own_settings_are_kept_in_its_file(desk, tmp_path):
    example_work.add(desk, picture(tmp_path / "rock.png"))
    state = desk.examples
    for name, value in (("kappa", 4.5), ("channels", "luminance"), ("feather", 0), ("neighbourhood", 5)):
        state.set(state.entry, name, value)
    example_work.use_settings(desk)
    (read,), faults = example_state.load_examples(example_state.own_folder(), True)
    assert not faults
    assert read.parameters == replace(NEW, kappa=4.5, channels="luminance", feather=0, neighbourhood=5)
    example_work.keep_settings(desk)
    assert state.entry.name == "rock 2"
    assert state.entry.parameters == read.parameters


def test_a_file_of_parameters_that_is_none_is_told_by_its_line(own):
    own.mkdir()
    picture(own / "a.png")
    (own / "a.toml").write_text('group = "X"\nkappa = "much"\n')
    (entry,), (fault,) = example_state.load_examples(own, True)
    assert entry.parameters == NEW
    assert fault.startswith("a.toml: line 2, kappa")


@pytest.mark.parametrize("stem", ["", "///", "..", "a\0b", "x" * 400, "Größe"])
def test_any_stem_makes_a_name(stem, own):
    name = own_example_files.free_file_name(stem)
    assert 0 < len(name) <= 40
    assert not set(name) & set("/\\\0.")
