"""Exports in the light: any rectangle is the same part of a larger one, however it is cut."""

from dataclasses import replace

import numpy as np
import pytest
import tifffile

from app.__main__ import main
from engine.archive.export import Picture, export, lighting_of, shown_root
from engine.archive.ladder.blocks import Source
from engine.archive.ladder.ladder_files import write_tiff_ladder
from engine.archive.ladder.rungs import Ladder
from engine.archive.saving import Snapshot, save
from engine.canvas.node_checks import LayerError
from engine.canvas.tile_cache import TileCache
from engine.files.images import read_image
from engine.light.light import Light
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8
from engine.painting import commands as c
from engine.painting.lighting import pictured
from engine.painting.rendering import piece_reader
from engine.session.apply import Painting
from engine.session.session import Session

FRAME = Rect.at(-20, -10, 400, 200)
LIGHT = Light(300, 35, 20, 0.3)


@pytest.fixture(scope="module")
def painting():
    session = Session(Painting(FRAME, 3), TileCache(64 << 20))
    ink = [{"texture": "rock", "amount": 0.8, "colour": "#ffffff", "period": 16}]
    for layer, at in (("low", (20, 20)), ("high", (160, 60))):
        session.do(c.parse({"do": "layer", "add": layer}))
        brush = {"radius": 70, "colour": "#3070c0", "ink": ink, "opacity": 0.8}
        points = [[0, 0], [130, 30, 0.6]]
        session.do(c.parse({"do": "stroke", "level": 0, "origin": list(at), "points": points, "brush": brush}))
    return session.painting


def whole(picture):
    """The picture in one piece."""
    area = picture.area
    read = piece_reader(picture.level, area.grown(1))
    return pictured(shown_root(picture), picture.level, area, read, lighting_of(picture))


@pytest.mark.parametrize("height", ["composite", "alpha", "high"])
def test_strips_and_blocks_are_cut_from_one_picture(painting, tmp_path, monkeypatch, height):
    monkeypatch.setattr("engine.painting.rendering._COLUMNS", 100)
    monkeypatch.setattr("engine.archive.ladder.blocks._COLUMNS", 130)
    light = Light(300, 35, 20, 0.3, height)
    picture = Picture(painting, 1, light=light)
    expected = to_rgba8(whole(picture))
    assert (expected != to_rgba8(whole(Picture(painting, 1, light=LIGHT)))).any() == (height != "composite")
    export(tmp_path / "a.png", picture)
    assert np.array_equal(read_image(tmp_path / "a.png")[0], expected)
    part = Rect.at(77, 31, 301, 190)
    export(tmp_path / "b.tif", Picture(painting, 1, part, light=light))
    assert np.array_equal(tifffile.imread(tmp_path / "b.tif"), expected[part.slices(FRAME.zoomed(1))])
    ladder = Ladder.of("a", 1, FRAME.zoomed(1), 8, 128, 128)
    source = Source(shown_root(picture), ladder, lighting_of(picture))
    assert np.array_equal(source.pixels(0, Rect.at(90, 40, 200, 150)), expected[40:190, 90:290])


def test_every_level_of_a_pyramid_is_lit_by_its_own_pixels(painting, tmp_path):
    write_tiff_ladder(tmp_path / "a.tif", Picture(painting, 1, light=LIGHT))
    with tifffile.TiffFile(tmp_path / "a.tif") as found:
        coarser = found.series[0].levels[1].asarray()
    assert np.array_equal(coarser, to_rgba8(whole(Picture(painting, 0, light=LIGHT))))


def test_the_command_line_lights_what_it_exports(painting, tmp_path, capsys):
    save(tmp_path / "a.ora", Snapshot(painting))
    words = ["export", str(tmp_path / "a.ora"), str(tmp_path / "a.png"), "--light", "-60,35,20.0", "--gloss", "0.3"]
    assert main(words) == 0
    assert np.array_equal(read_image(tmp_path / "a.png")[0], to_rgba8(whole(Picture(painting, light=LIGHT))))
    assert main([*words, "--height", "high"]) == 0
    by_layer = whole(Picture(painting, light=replace(LIGHT, height="high")))
    assert np.array_equal(read_image(tmp_path / "a.png")[0], to_rgba8(by_layer))
    capsys.readouterr()


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--light", "1,2"], "argument --light: found '1,2', expected AZIMUTH,ALTITUDE,DEPTH: three numbers"),
        (["--light", "0,95,3"], "--light: altitude: found 95, expected 1 to 90"),
        (["--light", "0,45,3", "--gloss", "nan"], "--light: gloss: found nan, expected 0 to 1"),
        (["--light", "0,45,3", "--height", "gone"], "--height: layer: found 'gone', expected one of 'low', 'high'"),
        (["--gloss", "0.5"], "--gloss: found it without --light, expected both"),
    ],
)
def test_a_light_that_cannot_be_is_told_in_a_line(painting, tmp_path, capsys, words, told):
    save(tmp_path / "a.ora", Snapshot(painting))
    assert main(["export", str(tmp_path / "a.ora"), str(tmp_path / "a.png"), *words]) == 2
    found = capsys.readouterr().err
    assert found.startswith(f"inkfall: {told}")
    assert found.count("\n") == 1
    assert not (tmp_path / "a.png").exists()


def test_no_light_and_no_depth_leave_the_picture_as_it_is(painting, tmp_path):
    export(tmp_path / "a.png", Picture(painting, depth=16))
    export(tmp_path / "b.png", Picture(painting, depth=16, light=Light(20, 40, 0)))
    export(tmp_path / "c.png", Picture(painting, depth=16, light=LIGHT))
    plain = (tmp_path / "a.png").read_bytes()
    assert plain == (tmp_path / "b.png").read_bytes() != (tmp_path / "c.png").read_bytes()


def test_heights_of_no_layer_are_refused(painting, tmp_path):
    with pytest.raises(LayerError):
        export(tmp_path / "a.png", Picture(painting, light=Light(height="gone")))
    assert list(tmp_path.iterdir()) == []
