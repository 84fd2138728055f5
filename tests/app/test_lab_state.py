"""What the window knows of the lab: places in the spectrum, the brush that paints there, when it has come to rest."""

from dataclasses import replace

import numpy as np
import pytest
from immutables import Map

from app.desk.holding import dipping
from app.desk.lab_state import PICTURED, SETTLE, LabState, only_with, with_texture
from app.panels.lab import lab_panel as panel
from engine.brush.parts import Component, Edge, Surface
from engine.brush.settings import Brush
from engine.makers import spectrum
from engine.numeric.spectra import radial_window
from engine.painting import commands as c
from engine.studio.textures import lab as engine_lab
from engine.studio.textures.texture_requests import LabRest, LabSet, LabUse

OWN = frozenset({"rock", "stripes"})


def test_places_on_the_screen_are_pixels_of_the_spectrum():
    lab = LabState(spot=(100.0, 50.0, 512.0))
    assert lab.place(100, 50) == (0, 0)
    assert lab.place(356, 306) == (128, 128)
    assert lab.over(100, 50)
    assert not lab.over(612, 60)
    lab.spot = None
    assert not lab.over(356, 306)


def test_the_brush_paints_white_with_what_every_painting_has():
    lab = LabState(made=LabSet((512, 512)), radius=6.0, strength=0.5)
    ink = (Component("rock", 0.5, "#ff0000"), Component("Photo"))
    brush = lab.brush(Brush(ink=ink, grain=Surface("Photo"), density=Surface("rock")), "#00ff00", False, OWN)
    assert (brush.colour, brush.radius, brush.opacity, brush.mode) == ("#ffffff", 12.0, 0.5, "paint")
    assert [(part.texture, part.colour) for part in brush.ink] == [("rock", "#000000")]
    assert brush.grain is None
    assert brush.density == Surface("rock")


def test_colour_and_the_eraser():
    lab = LabState(coloured=True)
    assert lab.brush(Brush(), "#00ff00", False, OWN).colour == "#00ff00"
    assert lab.brush(Brush(mode="example", example="moss"), "#00ff00", False, OWN).mode == "paint"
    assert lab.brush(Brush(), "#00ff00", True, OWN).mode == "erase"
    lab.change(sheet="phase")
    assert lab.brush(Brush(), "#00ff00", False, OWN).colour == "#ffffff"


def test_what_changes_pictures_changes_spectra_but_layers_are_not_copied():
    lab = LabState()
    painted = lab.brush(Brush(mode="raster", op=Map({"name": "contrast", "gain": 2.0})), "#00ff00", False, OWN)
    assert (painted.mode, painted.op["name"]) == ("raster", "contrast")
    copied = lab.brush(Brush(mode="raster", op=Map({"name": "clone", "layer": "Sky"})), "#00ff00", False, OWN)
    assert (copied.mode, copied.op) == ("paint", "toward")
    for op in ("multiply", Map({"name": "displace", "by": "texture"})):  # white and no texture would change nothing
        assert lab.brush(Brush(mode="raster", op=op), "#00ff00", False, OWN).mode == "paint"
    assert lab.brush(Brush(mode="raster", op=Map({"formula": "-pic"})), "#00ff00", False, OWN).mode == "raster"
    sheets = spectrum.begun(spectrum.Design((64, 64), (Map({"shape": "noise"}),)))
    stroke = c.Stroke(0, (0, 0), np.array([[20.0, 20, 1, 0, 0, 0], [30, 24, 1, 0, 0, 0]]), replace(painted, radius=5.0))
    loud = spectrum.with_stroke(sheets, stroke).amplitude
    changed = loud != sheets.amplitude
    assert changed[0, 20, 20]
    assert changed[0, 44, 44]
    assert not changed[0, 5:9].any()


def test_settings_are_posted_at_once_and_strokes_shown_at_rest():
    lab, posted = LabState(), []
    lab.ask(posted.append, 10.0, Brush())
    assert posted == [lab.made]
    lab.shape(0, "b", 2.0)
    lab.ask(posted.append, 10.1, Brush())
    assert posted[1].shapes == (Map({"shape": "noise", "b": 2.0}),)
    lab.ask(posted.append, 10.1 + SETTLE / 2, Brush())
    assert len(posted) == 2
    assert lab.waiting
    lab.ask(posted.append, 10.2 + SETTLE, Brush())
    lab.ask(posted.append, 20.0, Brush())
    assert [type(request) for request in posted] == [LabSet, LabSet, LabRest]
    assert not lab.waiting


def test_a_pattern_is_transformed_as_it_is():
    lab = LabState()
    lab.turn(True)
    assert (lab.made.forward, lab.made.phase) == (True, "zero")
    lab.turn(False)
    assert (lab.made.forward, lab.made.phase) == (False, "random")
    lab.phase("painted")
    lab.change(sheet="phase")
    lab.turn(True)
    assert (lab.made.phase, lab.made.sheet) == ("painted", "phase")
    lab.phase("zero")
    assert lab.made.sheet == "amplitude"


def test_phases_of_a_pictures_own_go_with_the_picture():
    lab = LabState()
    assert not lab.pictured
    lab.begin_with((Map({"shape": "texture", "texture": "View"}),))
    assert lab.pictured
    lab.phase("own")
    lab.begin_with((*lab.made.shapes, Map({"shape": "ring"})))
    assert lab.made.phase == "own"
    lab.begin_with((Map({"shape": "ring"}),))
    assert lab.made.phase == "random"


def test_the_window_of_an_endless_field_is_as_wide_as_its_sample():
    lab = LabState()
    assert (lab.endless, lab.window) == (False, 256)
    lab.field("field", "sparse")
    lab.field("period", 90)
    assert (lab.endless, lab.window) == (True, 90)
    window = radial_window(400)[200]
    assert abs((window > 0.5).mean() - panel.HALF) < 0.006
    assert engine_lab.FIELD.width == panel.FIELD
    assert spectrum.PICTURED == PICTURED


def test_numbers_at_their_default_are_left_out():
    lab = LabState()
    lab.field("density", 20.0)
    assert lab.made.field == Map({"density": 20.0})
    lab.field("density", None)
    lab.field("density", None)
    assert lab.made.field == Map()


@pytest.mark.parametrize(("follow", "names"), [(True, ["A"]), (False, ["A", ""])])
def test_a_texture_in_use_follows_or_is_let_go(follow, names):
    posted = []
    LabState(follow=follow).use(posted.append, "A")
    assert posted == [LabUse(name) for name in names]


def test_a_brush_takes_the_texture():
    brush = Brush(mode="erase", ink=(Component("rock"),))
    assert with_texture(brush, "ink", "A").ink == (dipping.fix(Component("A", 1.0, "#ffffff")),)  # white stays white
    assert with_texture(brush, "ink", "A").mode == "paint"
    assert with_texture(brush, "grain", "A").grain.texture == "A"
    assert with_texture(brush, "density", "A").ink == brush.ink
    assert only_with(with_texture(brush, "density", "A"), OWN) == brush


def test_a_paper_shows_at_once_though_full_coverage_would_hide_it():
    full = Brush(opacity=1.0)
    assert with_texture(full, "grain", "A").opacity < 0.8
    assert with_texture(full, "density", "A").opacity == 1.0
    assert with_texture(replace(full, opacity=0.5), "grain", "A").opacity == 0.5
    assert with_texture(full, "grain", "A", pen=True).opacity == 1.0  # its pressure changes the opacity
    assert with_texture(replace(full, dynamics=Map()), "grain", "A", pen=True).opacity < 0.8
    assert with_texture(replace(full, edge=Edge("wet")), "grain", "A").opacity == 1.0  # the inside is lighter already
