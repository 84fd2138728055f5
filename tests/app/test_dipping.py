"""The colour is the artist's: choosing brushes leaves it alone, and inks and tints of a rim go along with it."""

import json
from dataclasses import replace

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from immutables import Map

from app.desk import presets
from app.desk.colours import from_hex, gone_along, to_hex, to_oklch
from app.desk.hand import Hand, mixed_now, radius_of
from app.desk.holding import dipping
from app.desk.presets import Preset
from engine.brush.parts import Edge
from engine.brush.settings import Brush, Component, from_json, to_json

COLOURS = st.integers(0, 0xFFFFFF).map(lambda n: f"#{n:06x}")
INKS = st.lists(st.builds(Component, st.just("rock"), st.just(0.5), COLOURS, st.sampled_from([Map(), Map(fixed=True)])))
EDGES = st.none() | st.builds(Edge, colour=st.none() | COLOURS, extra=st.sampled_from([Map(), Map(fixed=True)]))
BRUSHES = st.builds(lambda c, ink, edge: Brush(colour=c, ink=tuple(ink[:8]), edge=edge), COLOURS, INKS, EDGES)
OCHRE, BLUE = "#d79b2f", "#2050c0"


def held(hand, brush, name):
    hand.take(brush, name, ())
    hand.change(radius=hand.sizes.of(name, brush))


def bundled(name):
    found, _ = presets.load_brushes(presets.bundled_folder())
    return next(preset for preset in found if preset.name == name)


@settings(deadline=None)
@example("#006d00", "#fff600", "#00006e")
@given(COLOURS, COLOURS, COLOURS)
def test_a_colour_that_goes_along_keeps_at_least_half_of_its_contrast_and_stays_a_colour(part, old, new):
    made = gone_along(from_hex(part), from_hex(old), from_hex(new))
    assert all(0.0 <= v <= 1.0 for v in made)
    by = abs(to_oklch(from_hex(part))[0] - to_oklch(from_hex(old))[0])
    off = abs(to_oklch(made)[0] - to_oklch(from_hex(new))[0])
    assert by / 2 - 0.05 <= off <= by + 0.05  # near black a rounding of what can be shown is 0.04
    assert gone_along(from_hex(part), from_hex(old), from_hex(old)) == from_hex(part)


@settings(deadline=None)
@given(COLOURS, st.integers(0, 255))
def test_along_with_a_grey_all_is_grey_where_the_brush_was_mixed_for_a_colour(part, grey):
    made = gone_along(from_hex(part), from_hex(OCHRE), (grey / 255,) * 3)
    assert to_oklch(made)[1] < 2e-3


def test_blue_gouache_has_no_ochre_marks():
    hand = Hand()
    gouache = bundled("Gouache")
    hand.take(gouache.brush, gouache.name, gouache.textures)
    hand.colour = from_hex(BLUE)
    painted = hand.dipped()
    hue = to_oklch(from_hex(BLUE))[2]
    assert painted.colour == BLUE
    assert painted.edge is not None
    for colour in (painted.ink[0].colour, painted.edge.colour):
        assert abs(to_oklch(from_hex(colour))[2] - hue) < 30
    before, _, _ = to_oklch(from_hex(BLUE))
    assert to_oklch(painted.ink[0].rgb)[0] > before > to_oklch(painted.edge.rgb)[0]


@settings(deadline=None)
@given(BRUSHES, COLOURS)
def test_a_dipped_brush_tells_nothing_of_what_is_fixed_and_has_that_as_it_was(brush, colour):
    painted = dipping.dipped(brush, colour)
    assert from_json(to_json(painted)) == painted
    assert "fixed" not in json.dumps(to_json(painted))
    assert painted.colour == colour
    for before, after in zip(brush.ink, painted.ink, strict=True):
        if dipping.is_fixed(before):
            assert after.colour == before.colour
    assert dipping.dipped(brush, brush.colour) == replace(
        brush,
        ink=tuple(dipping.fix(part, on=False) for part in brush.ink),
        edge=brush.edge and dipping.fix_rim(brush.edge, on=False),
    )


@settings(deadline=None)
@given(BRUSHES.filter(lambda brush: brush.ink), COLOURS, COLOURS, st.data())
def test_an_ink_that_is_changed_is_as_it_was_set_and_the_others_as_they_were(brush, colour, wanted, data):
    i = data.draw(st.integers(0, len(brush.ink) - 1))
    shown = dipping.in_colour(brush, colour).ink
    for part in (
        replace(shown[i], colour=wanted),
        replace(shown[i], amount=0.25),
        dipping.fix(shown[i]),
        dipping.fix(shown[i], on=False),
    ):
        made = dipping.with_ink(brush, colour, i, part)
        assert dipping.in_colour(made, colour).ink == (*shown[:i], part, *shown[i + 1 :])
    assert dipping.with_ink(brush, colour, i, replace(shown[i], amount=0.25)).colour == brush.colour


@settings(deadline=None)
@given(BRUSHES, COLOURS, EDGES)
def test_a_rim_that_is_changed_is_as_it_was_set(brush, colour, edge):
    made = dipping.with_rim(brush, colour, edge)
    assert dipping.in_colour(made, colour).edge == edge
    assert dipping.in_colour(made, colour).ink == dipping.in_colour(brush, colour).ink


def test_none_of_the_bundled_brushes_is_about_its_colour_and_an_option_of_a_preset_says_so(tmp_path):
    found, faults = presets.load_brushes(presets.bundled_folder())
    assert not faults
    assert not any(preset.coloured for preset in found)
    presets.save_brush(Preset("Sanguine", Brush(colour=OCHRE), coloured=True), tmp_path)
    (tmp_path / "old.json").write_text(json.dumps({"name": "Old", "brush": {"radius": 3}}))
    (tmp_path / "wrong.json").write_text(json.dumps({"name": "Wrong", "coloured": 1, "brush": {"radius": 3}}))
    own, faults = presets.load_brushes(tmp_path)
    assert {preset.name: preset.coloured for preset in own} == {"Sanguine": True, "Old": False}
    assert faults == ["wrong.json: coloured: found 1, expected true or false"]


@pytest.mark.parametrize("mode", ["erase", "smooth"])
def test_a_brush_that_lays_no_paint_has_the_size_that_it_had(mode):
    hand = Hand()
    held(hand, Brush(radius=24.0, mode=mode), "Eraser")
    hand.change(radius=70.0)
    held(hand, Brush(radius=5.0), "Pen")
    assert hand.brush.radius == 5.0
    held(hand, Brush(radius=24.0, mode=mode), "Eraser")
    assert hand.brush.radius == 70.0


def test_erasing_has_a_size_of_its_own_and_so_has_the_other_end_of_the_pen():
    hand = Hand()
    hand.take(Brush(radius=10.0), "Pen", ())
    hand.erase()
    assert hand.brush.radius == 10.0
    hand.change(radius=40.0)
    hand.erase()
    assert hand.brush.radius == 40.0
    hand.use("pan")
    assert (hand.brush.radius, radius_of(hand, False), radius_of(hand, True)) == (10.0, 10.0, 40.0)
    hand.change(radius=12.0)
    hand.erase()
    assert hand.brush.radius == radius_of(hand, True) == 40.0
    hand.erase(False)
    assert hand.brush.radius == 12.0


def test_colours_of_the_window_are_those_of_the_brush():
    hand = Hand()
    hand.take(Brush(colour=OCHRE, ink=(Component("rock", 0.5, "#f6d67e"),)), "Gouache", ())
    hand.colour = from_hex(OCHRE)
    assert hand.dipped() == hand.brush
    assert to_hex(hand.colour) == mixed_now(hand).colour
