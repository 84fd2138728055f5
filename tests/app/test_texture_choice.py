"""The textures that panels offer: built in, of the painting, of the brushes."""

from types import SimpleNamespace

import pytest
from immutables import Map

from app.desk.hand import Hand
from app.desk.known import Known
from app.desk.presets import Preset
from app.panels.controls import texture_rows
from engine.brush.settings import Brush
from engine.painting.commands import parse
from engine.studio.ready import ready

FUR = parse({"do": "texture", "name": "fur", "maker": "sparse", "size": [8, 8], "density": 20.0})
LINEN = parse({"do": "texture", "name": "linen", "maker": "spectrum", "size": [8, 8], "period": 77})


def desk(*defined):
    scene = SimpleNamespace(
        textures=tuple(name for name, _, _ in defined),
        texture_kinds=tuple((name, kind) for name, kind, _ in defined),
        definitions=defined,
        texture_widths=tuple((name, 48) for name, _, _ in defined),
    )
    presets = (Preset("Cat", Brush(), textures=(FUR,)), Preset("Cloth", Brush(), textures=(LINEN, FUR)))
    return SimpleNamespace(known=Known(tables=ready(), scene=scene, presets=presets), hand=Hand())


def test_each_texture_is_offered_once_and_the_paintings_own_is_meant():
    made = desk(("linen", "sparse", Map({"period": 9.0})))
    names = [name for name, _ in texture_rows.names(made)]
    assert names.count("linen") == names.count("fur") == names.count("rock") == 1
    assert "image" not in names
    assert texture_rows.texture_kind(made, "linen") == "sparse"
    assert texture_rows.texture_kind(made, "fur") == "sparse"
    assert texture_rows.texture_kind(made, "rock") == "rock"
    assert texture_rows.texture_kind(made, "no such") == "no such"


def test_a_texture_of_the_brushes_is_brought_once_and_not_where_it_is_already():
    made = desk()
    for _ in range(2):
        texture_rows.bring(made, "fur")
        texture_rows.bring(made, "rock")
    assert made.hand.needs == (FUR,)
    made = desk(("fur", "sparse", Map()))
    texture_rows.bring(made, "fur")
    assert made.hand.needs == ()


@pytest.mark.parametrize("name", [row.name for row in ready().kinds])
def test_every_parameter_of_every_kind_has_a_slider(name):
    made = desk(("it", name, Map()))
    for row in texture_rows.rows(made, "it"):
        assert row.name == "seed" or float(row.lo) < float(row.hi)
        assert float(row.lo) <= float(row.default) <= float(row.hi)


def test_sliders_begin_at_what_the_texture_was_defined_with():
    assert texture_rows.own(desk(), "linen")["period"] == 77
    assert texture_rows.own(desk(("linen", "spectrum", Map({"period": 5}))), "linen")["period"] == 5
    assert texture_rows.own(desk(("linen", "spectrum", Map())), "linen")["period"] == 48  # its picture's width
    assert texture_rows.own(desk(), "fur")["period"] == 8
    assert texture_rows.own(desk(), "rock") == {}


def test_a_picture_is_asked_for_again_only_where_a_name_means_another_texture():
    made = desk()
    made.lab = SimpleNamespace(scene=None)
    made.known.scene.serial = 1
    known = {texture_rows.meant(made, name) for name in ("rock", "fur", "linen")}
    assert len(known) == 3
    assert texture_rows.meant(made, "fur") in known
    assert texture_rows.brought(made, "fur") == (FUR,)
    here = desk(("fur", "sparse", Map({"density": 3.0})))
    here.lab, here.known.scene.serial = SimpleNamespace(scene=SimpleNamespace(using="fur", version=4)), 1
    first = texture_rows.meant(here, "fur")
    assert first not in known
    here.lab.scene.version = 5
    assert texture_rows.meant(here, "fur") != first
    assert texture_rows.brought(here, "fur") == ()
    assert [title for title, _ in texture_rows.groups(here)] == ["Of this painting", "Built in", "Of the brushes"]


def test_a_texture_of_the_program_is_called_the_same_before_the_engine_is_there():
    early = SimpleNamespace(known=Known())
    assert texture_rows.label(early, "rock") == texture_rows.label(desk(), "rock") == "Rock"
