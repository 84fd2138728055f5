"""Presets that bring textures along: read with care, defined once, under a free name where theirs is taken."""

import json
from collections import deque
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

from app.desk import palette, presets
from app.desk.hand import Hand
from app.desk.holding.taking import take_preset
from app.desk.known import Known
from app.desk.presets import Preset
from engine.brush import settings
from engine.makers.definitions import fitted, read, renamed, used
from engine.painting.commands import Stroke, parse
from engine.painting.value import Painting
from engine.studio import requests as q
from engine.studio import results
from engine.studio.studio import Studio
from engine.studio.textures.swatches import painted
from opens import opens

FUR = {
    "name": "fur",
    "maker": "spectrum",
    "field": "sparse",
    "size": [32, 32],
    "shapes": [{"shape": "wedge", "angle": 20}],
}
BRUSH = {
    "radius": 9,
    "ink": [{"texture": "fur", "colour": "#ffffff"}, {"texture": "rock"}],
    "density": "fur",
    "grain": {"texture": "paper", "amount": 0.5},
}
PAPER = {"name": "paper", "maker": "rock", "period": 8}
STROKE = parse({"do": "stroke", "points": [[5, 5], [30, 30]]})


def folder_with(tmp_path, **members):
    (tmp_path / "fur.json").write_text(json.dumps({"name": "Fur", "brush": BRUSH, **members}))
    return tmp_path


def preset(tmp_path, *textures):
    found, faults = presets.load_brushes(folder_with(tmp_path, textures=list(textures)))
    assert not faults
    return found[0]


class Desk(SimpleNamespace):
    """What of a desk the palette uses, with an engine that does at once what is posted."""

    def __init__(self):
        super().__init__(hand=Hand(), known=Known(), pointer=SimpleNamespace(pen=False))
        self.sent, self.posted = [], deque()
        self.studio = Studio(self._take, self.posted.append)

    def _take(self, result):
        self.sent.append(result)
        if isinstance(result, results.Scene):
            self.known = replace(self.known, scene=result)

    def post(self, request):
        self.sent.append(request)
        self.studio.do(request)

    @property
    def asked(self):
        return [request.command for request in self.sent if isinstance(request, q.Do)]

    def paint(self):
        palette.provide(self)
        self.studio.easel.carry_out(Stroke(0, (0, 0), STROKE.points, self.hand.brush))


def test_a_preset_brings_its_textures_with_the_first_stroke(tmp_path):
    desk = Desk()
    palette.take(desk, preset(tmp_path, FUR, PAPER))
    assert desk.asked == []  # a brush that is only looked at leaves nothing behind
    desk.paint()
    assert [command.name for command in desk.asked] == ["fur", "paper"]
    assert desk.known.scene.textures == ("fur", "paper")
    desk.paint()
    palette.take(desk, preset(tmp_path, FUR, PAPER))
    desk.paint()
    assert len(desk.asked) == 2


def test_only_what_the_brush_refers_to_comes_along(tmp_path):
    desk = Desk()
    palette.take(desk, preset(tmp_path, FUR, PAPER, {"name": "moss", "maker": "rock"}))
    desk.paint()
    assert desk.known.scene.textures == ("fur", "paper")


def test_a_paper_that_stays_is_felt_by_the_next_brush(tmp_path):
    """A virtual surface is the canvas's: every brush feels it (Lewis 1984, section 6.1)."""
    desk, fur = Desk(), preset(tmp_path, FUR, PAPER)
    smooth, rough = Preset("Smooth", settings.Brush(opacity=1.0)), presets.load_papers(presets.papers_folder())[0][0]
    grained = Preset("Grained", settings.Brush(grain=rough.grain), textures=rough.textures)
    palette.take(desk, fur)
    palette.take(desk, smooth)
    assert desk.hand.brush == smooth.brush
    palette.take(desk, fur)
    desk.hand.paper_stays = True
    palette.take(desk, smooth)
    assert desk.hand.brush.grain == fur.brush.grain
    assert desk.hand.brush.opacity < 1.0  # full coverage would fill the paper's hollows
    palette.take(desk, grained)
    assert desk.hand.brush == replace(grained.brush, grain=fur.brush.grain)
    desk.paint()
    assert desk.known.scene.textures == ("paper",)
    desk.hand.paper_stays = False
    palette.take(desk, grained)
    assert desk.hand.brush == grained.brush


def test_a_paper_makes_way_for_another_texture_of_its_name_that_the_next_brush_brings(tmp_path):
    desk, brush = Desk(), settings.Brush(density=settings.from_json(BRUSH).grain)
    other = read([{**PAPER, "period": 20}], "textures", tmp_path)
    palette.take(desk, preset(tmp_path, FUR, PAPER))
    desk.hand.paper_stays = True
    palette.take(desk, Preset("Other", brush, textures=other))
    assert desk.hand.brush == brush


def test_another_texture_of_the_name_stays_and_a_free_one_is_taken(tmp_path):
    desk = Desk()
    desk.post(q.Do(parse({"do": "texture", "name": "fur", "maker": "rock", "period": 20})))
    palette.take(desk, preset(tmp_path, FUR, PAPER))
    assert [command.name for command in palette.lacking(desk)] == ["fur 2", "paper"]
    desk.paint()
    assert desk.known.scene.textures == ("fur", "fur 2", "paper")
    assert [part.texture for part in desk.hand.brush.ink] == ["fur 2", "rock"]
    assert desk.hand.brush.density.texture == "fur 2"
    assert desk.studio.easel.session.painting.textures["fur"].kind == "rock"
    palette.take(desk, preset(tmp_path, FUR, PAPER))
    assert desk.known.scene.textures == ("fur", "fur 2", "paper")
    assert desk.hand.brush.density.texture == "fur 2"
    desk.paint()


def test_another_painting_gets_them_with_its_first_stroke(tmp_path):
    desk = Desk()
    palette.take(desk, preset(tmp_path, FUR, PAPER))
    desk.post(q.New(q.Rect(0, 0, 64, 64)))
    assert desk.known.scene.textures == ()
    assert not desk.known.scene.modified
    assert [command.name for command in palette.lacking(desk)] == ["fur", "paper"]
    desk.paint()
    assert desk.known.scene.textures == ("fur", "paper")
    assert palette.lacking(desk) == ()


def test_a_definition_is_recognised_after_saving(tmp_path):
    desk = Desk()
    palette.take(desk, preset(tmp_path, FUR, PAPER))
    desk.paint()
    desk.post(q.Save(tmp_path / "a.ora"))
    desk.studio.close()
    other = Desk()
    opens(other.studio, other.posted, tmp_path / "a.ora")
    palette.take(other, preset(tmp_path, FUR, PAPER))
    other.paint()
    assert other.asked == []
    changed = {**FUR, "shapes": [{"shape": "wedge", "angle": 21}]}
    palette.take(other, preset(tmp_path, changed, PAPER))
    other.paint()
    assert other.known.scene.textures == ("fur", "fur 2", "paper")


def test_the_thumbnail_knows_them(tmp_path):
    found = preset(tmp_path, FUR, PAPER)
    picture = painted(q.Swatch("it", found.brush, (104, 44), textures=found.textures), Painting())
    plain = painted(q.Swatch("it", settings.Brush(radius=9), (104, 44)), Painting())
    assert picture[3].max() > 0.2
    assert not np.array_equal(picture, plain)


def test_saved_and_read_again(tmp_path):
    found = preset(tmp_path, FUR, PAPER)
    path = presets.save_brush(Preset("My fur", found.brush, textures=found.textures), tmp_path / "own")
    (again,), faults = presets.load_brushes(tmp_path / "own")
    assert not faults
    assert again.path == path
    assert (again.brush, again.textures) == (found.brush, found.textures)


def test_paths_start_from_the_presets_folder(tmp_path):
    found = preset(tmp_path, {"name": "fur", "maker": "image", "path": "a/b.png"})
    assert found.textures[0].arguments["path"] == str(tmp_path / "a" / "b.png")


FAULTY = {
    "no list": ({}, "textures: found an object"),
    "no object": ([7], "textures[0]: found 7"),
    "no name": ([{"maker": "rock"}], "textures[0].name: found nothing"),
    "no maker": ([{"name": "fur"}], "textures[0].maker: found nothing"),
    "twice": ([FUR, FUR], "textures[1]"),
    "another command": ([{"do": "undo", **FUR}], "textures[0]"),
    "too many": ([{**FUR, "name": str(i)} for i in range(17)], "at most 16"),
}


@pytest.mark.parametrize(("textures", "message"), FAULTY.values(), ids=FAULTY)
def test_faulty_definitions_are_told_with_the_file(tmp_path, textures, message):
    found, faults = presets.load_brushes(folder_with(tmp_path, textures=textures))
    assert not found
    assert faults[0].startswith("fur.json: ")
    assert message in faults[0]


def test_names_are_changed_only_where_textures_are_meant():
    brush = settings.from_json({**BRUSH, "tip": "fur", "note": "fur"})
    other = settings.to_json(renamed(brush, {"fur": "pelt", "paper": "paper"}))
    assert other["note"] == "fur"
    assert [part["texture"] for part in other["ink"]] == ["pelt", "rock"]
    assert (other["density"], other["tip"]) == ("pelt", "pelt")
    assert other["grain"]["texture"] == "paper"
    assert used(brush, read([FUR], "textures")) == read([FUR], "textures")


def test_two_brushes_with_one_name_for_two_textures():
    first, second = (read([{**FUR, "seed": seed}], "textures") for seed in (1, 2))
    brush = settings.from_json({"ink": [{"texture": "fur"}]})
    known = {"fur": ("sparse", first[0].arguments)}
    same, _, missing = fitted(brush, first, known)
    assert (same, missing) == (brush, ())
    other, needed, missing = fitted(brush, second, known)
    assert other.ink[0].texture == needed[0].name == missing[0].name == "fur 2"


SPECTRAL = {
    "spectrum": {"maker": "spectrum", "size": [32, 32], "shapes": [{"shape": "ring"}], "seed": 4},
    "scattered": {"maker": "spectrum", "field": "sparse", "size": [32, 32], "density": 5},
    "sparse": {"maker": "sparse", "size": [32, 32], "shapes": [{"shape": "noise"}], "spread": 0.5},
    "photograph": {"maker": "impulse", "path": "{dir}/grey.png", "average": 2},
    "photograph, tiled": {"maker": "impulse", "path": "{dir}/grey.png", "field": "tile", "window": 9},
    "image": {"maker": "image", "path": "{dir}/grey.png", "period": 12},
    "rock": {"maker": "rock", "period": 12},
}


@pytest.mark.parametrize("members", SPECTRAL.values(), ids=SPECTRAL)
def test_a_brush_takes_the_paintings_textures_along(tmp_path, members):
    """Saved in one painting, used in another: the same picture."""
    Image.fromarray(np.random.default_rng(1).integers(0, 256, (20, 24), np.uint8)).save(tmp_path / "grey.png")
    members = {key: value.format(dir=tmp_path) if key == "path" else value for key, value in members.items()}
    desk, other = Desk(), Desk()
    desk.post(q.Do(parse({"do": "texture", "name": "fur", **members})))
    desk.hand.take(settings.from_json({"radius": 9, "ink": [{"texture": "fur", "colour": "#ffffff"}]}))
    textures, stay = palette.belonging(desk)
    assert stay == ()
    palette.take(other, Preset("Fur", desk.hand.brush, textures=textures))
    other.paint()
    assert other.known.scene.textures == ("fur",)
    swatch = q.Swatch("it", desk.hand.brush, (60, 40))
    pictures = [painted(swatch, d.studio.easel.session.painting) for d in (desk, other)]
    assert np.array_equal(*pictures)
    palette.take(other, Preset("Fur", desk.hand.brush, textures=textures))
    other.paint()
    assert len(other.asked) == 1


def test_what_only_the_painting_has_is_told():
    desk = Desk()
    desk.post(q.Do(parse({"do": "texture", "name": "fur", "maker": "canvas", "rect": [0, 0, 0, 8, 8]})))
    desk.hand.take(settings.from_json({"ink": [{"texture": "fur"}]}))
    assert palette.belonging(desk) == ((), ("fur",))


def test_choosing_a_brush_leaves_the_colour_alone_unless_it_is_about_its_own():
    desk = SimpleNamespace(
        hand=Hand(), known=Known(), pointer=SimpleNamespace(pen=False), examples=SimpleNamespace(adopted=None)
    )
    before = desk.hand.colour
    red = Preset("Red", settings.from_json({"colour": "#ff0000", "ink": [{"texture": "rock"}]}))
    eraser = Preset("Eraser", settings.from_json({"mode": "erase", "radius": 24}))
    take_preset(desk, red)
    assert (desk.hand.preset, desk.hand.colour) == ("Red", before)
    take_preset(desk, eraser)
    desk.hand.resize(2.0)
    take_preset(desk, replace(red, coloured=True))
    assert desk.hand.colour == (1.0, 0.0, 0.0)
    take_preset(desk, eraser)
    assert desk.hand.brush.radius == 48.0
    take_preset(desk, red, keep_size=True)
    assert desk.hand.brush.radius == 48.0
