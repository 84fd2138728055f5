"""What was painted with examples, saved and opened: the same regions, and the same pixels once grown."""

import io
import json
import signal
import subprocess
import sys
import time
import zipfile
from collections import deque
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from PIL import Image
from sown import (
    DEFINED,
    FRAME,
    MANIFEST,
    altered,
    assert_same,
    begun,
    folder,
    forged,
    grow,
    grown,
    members,
    opened,
    rewritten,
    saved,
    session,
    stroke,
)

from engine.archive import plot_files as files
from engine.archive.export import Picture, export
from engine.archive.opening import open_painting
from engine.archive.saving import Snapshot, save
from engine.canvas import layers
from engine.canvas.reading import layer_planes
from engine.canvas.tile_cache import TileCache
from engine.numeric.address import Rect
from engine.numeric.colour import to_rgba8
from engine.painting import commands as c
from engine.painting.grown import settled
from engine.session.session import Session
from engine.studio import results
from engine.studio.studio import Studio
from engine.texture.example import SYNTHESIS
from engine.texture.example import region as regions
from engine.texture.example.tiles import NONE
from opens import Watch, opens

__all__ = ["folder", "members", "saved", "session"]

# ---- ours ----


def test_round_trip(session, saved):
    found = open_painting(saved)
    assert (found.native, found.notes) == (True, ())
    assert_same(session.painting, found.painting)
    assert len(grown(session.painting)) == 7
    assert {plot.level for plot in grown(session.painting)} == {0, 1, 80}
    assert {plot.name: plot.region.exemplar.pixels.dtype for plot in grown(found.painting)} == {
        "stripes": np.uint16,
        "spots": np.uint16,
    }
    assert not any(plot.settled for plot in grown(found.painting))  # nothing is grown by opening


def test_textures_come_back_whether_they_were_used_or_not(session, saved):
    one, other = session.painting.textures, open_painting(saved).painting.textures
    assert set(one) == set(other)
    for name, texture in one.items():
        assert (texture.kind, texture.parameters) == (other[name].kind, other[name].parameters)
        for own, found in ((texture.source, other[name].source), (texture.mask, other[name].mask)):
            assert own == found
            assert own is None or np.array_equal(own.data, found.data)
    assert other["idle"].kind == "example"
    assert other["idle"].mask is None


def test_each_example_is_stored_once(members):
    manifest = json.loads(members[MANIFEST])
    told = manifest["examples"]
    assert len(told) == 3  # stripes with and without detail for zooming in, spots as they were
    assert len({(e["picture"], e.get("mask")) for e in told.values()}) == 2
    assert len(manifest["pictures"]) == 3
    assert sum(name.startswith("inkfall/pictures/") for name in members) == 3


def test_the_same_painting_gives_the_same_bytes(session, saved, tmp_path):
    """However far it is grown when it is saved, and after it was opened."""
    again = tmp_path / "b.ora"
    save(again, Snapshot(settled(session.painting, 2), session.recording()))
    assert again.read_bytes() == saved.read_bytes()
    reopened = open_painting(saved)
    save(again, Snapshot(reopened.painting, reopened.recording))
    assert again.read_bytes() == saved.read_bytes()


def test_painting_goes_on_after_opening_as_it_would_have_without(session, saved):
    """Strokes with the same example join the plots that were opened."""
    reopened, straight = (
        Session(painting, TileCache(16 << 20)) for painting in (open_painting(saved).painting, session.painting)
    )
    for command in (
        grow([[120, 20], [150, 30]], "stripes", example_detail=1),
        stroke([[30, 30]], mode="erase", radius=11),
        grow([[70, 62]], "stripes", level=1, depth=3, radius=7),
        grow([[0, 100], [100, 100]], "idle", depth=1.5, radius=6),
    ):
        for one in (reopened, straight):
            one.do(c.parse({**command, "layer": "Layer 1"}))
    assert_same(straight.painting, reopened.painting)
    assert len(grown(straight.painting)) == 8


def test_another_way_of_growing_is_told(members, tmp_path):
    found = opened(rewritten(members, altered(members, ("synthesis",), 99)), tmp_path)
    assert found.native
    assert len(found.notes) == 1
    assert f"(revision 99, now {SYNTHESIS})" in found.notes[0]


@pytest.mark.parametrize("depth", [0.1, -(2.0**31), 1e-300])
def test_depths_come_back_exactly(folder, tmp_path, depth):
    session = begun(folder)
    session.do(c.parse(grow([[5, 5]], "stripes", depth=depth)))
    save(tmp_path / "a.ora", Snapshot(session.painting))
    assert [plot.depth for plot in grown(open_painting(tmp_path / "a.ora").painting)] == [depth]


# ---- grown again ----


def test_plots_that_grow_otherwise_are_noticed(members, saved, tmp_path):
    found = open_painting(saved)
    assert len(found.marks) == 7
    assert not files.otherwise(found.marks, found.painting.root)  # nothing is grown yet
    assert not files.otherwise(found.marks, settled(found.painting).root)
    other = opened(forged(members), tmp_path)
    assert other.notes == ()
    assert files.otherwise(other.marks, settled(other.painting).root)
    painted = Session(other.painting, TileCache(1 << 24))
    for radius in (500, 9):
        painted.do(c.parse(stroke([[20, 20]], mode="erase", radius=radius, layer="Layer 1")))
        painted.do(c.parse(grow([[60, 90]], "stripes", radius=9, layer="Layer 1")))
    assert not files.otherwise(other.marks, settled(painted.painting).root)  # it is no longer that plot


@pytest.mark.parametrize("lying", [False, True])
def test_the_window_grows_what_is_opened(session, members, tmp_path, lying):
    path = tmp_path / "a.ora"
    path.write_bytes(forged(members) if lying else rewritten(members))
    sent, posted = [], deque()
    studio = Studio(sent.append, posted.append)
    opens(studio, posted, path)
    while studio.pending:
        studio.step()
    studio.close()
    notes = [result.text for result in sent if isinstance(result, results.Note)]
    assert notes == ([files.OTHERWISE] if lying else [])
    assert not studio.easel.modified
    painting = studio.easel.session.painting
    assert all(plot.settled for plot in grown(painting))
    assert_same(session.painting, painting)


# ---- at random ----

POINT = st.tuples(st.integers(-30, 200), st.integers(-20, 130)).map(list)
STROKES = st.one_of(
    st.builds(
        grow,
        st.lists(POINT, min_size=1, max_size=2),
        st.sampled_from(["stripes", "spots"]),
        depth=st.sampled_from([0, 2]),
        example_level=st.sampled_from([0, 1, -1]),
        example_detail=st.sampled_from([0, 1]),
        radius=st.integers(2, 30),
        layer=st.sampled_from(["below", "above"]),
    ),
    st.builds(
        stroke,
        st.lists(POINT, min_size=1, max_size=2),
        mode=st.sampled_from(["erase", "paint"]),
        radius=st.integers(2, 20),
        layer=st.sampled_from(["below", "above"]),
    ),
)


@given(st.lists(STROKES, min_size=1, max_size=5), st.lists(STROKES, max_size=2))
@settings(deadline=None, max_examples=12)
@example([grow([[0, 0]], "spots", layer="above"), stroke([[0, 0]], mode="erase", layer="above", radius=30)], [])
def test_anything_painted(folder, tmp_path_factory, painted, later):
    path = tmp_path_factory.mktemp("any") / "a.ora"
    session = begun(folder)
    for command in ({"do": "layer", "add": "below"}, {"do": "layer", "add": "G", "kind": "group"}):
        session.do(c.parse(command))
    session.do(c.parse({"do": "layer", "add": "above", "group": "G"}))
    for command in painted:
        session.do(c.parse(command))
    save(path, Snapshot(session.painting))
    written = path.read_bytes()
    reopened = Session(open_painting(path).painting, TileCache(16 << 20))
    assert_same(session.painting, reopened.painting)
    save(path, Snapshot(reopened.painting))
    assert path.read_bytes() == written
    for command in later:
        session.do(c.parse(command))
        reopened.do(c.parse(command))
    assert_same(session.painting, reopened.painting)


# ---- for others ----


def shown(png):
    pixels = np.asarray(Image.open(io.BytesIO(png)).convert("RGBA")).astype(float)
    return np.dstack([pixels[..., :3] * pixels[..., 3:] / 255, pixels[..., 3:]])


def test_others_see_what_is_grown(session, saved, members, tmp_path):
    export(tmp_path / "a.png", Picture(settled(session.painting)))
    ours = shown((tmp_path / "a.png").read_bytes())
    assert np.abs(ours - shown(members["mergedimage.png"])).max() <= 2
    export(tmp_path / "b.png", Picture(open_painting(saved).painting))
    assert (tmp_path / "b.png").read_bytes() == (tmp_path / "a.png").read_bytes()
    for layer in layers.layers(settled(session.painting).root):
        frame = next(e for e in stack_entries(members) if e.src == f"data/L{layer.id}.png")
        png = shown(members[f"data/L{layer.id}.png"])
        place = Rect.at(FRAME.x0 + frame.x, FRAME.y0 + frame.y, png.shape[1], png.shape[0])
        planes = layer_planes(layer, 0, place)
        expected = np.zeros((*png.shape[:2], 4), np.uint8) if planes is None else to_rgba8(planes)
        file = io.BytesIO()
        Image.fromarray(expected).save(file, "PNG")
        assert np.abs(png - shown(file.getvalue())).max() <= 2, layer.name
        assert layer.name == "deep" or png.any()


def stack_entries(members):
    from engine.files.stack_xml import parse_stack

    return list(parse_stack(members["stack.xml"], "a").root.layers())


def test_a_picture_below_stays_what_it_was(folder, tmp_path):
    """A layer that began as a picture: other programs see it grown over, the picture itself comes back."""
    Image.fromarray(np.full((60, 80, 4), 200, np.uint8)).save(tmp_path / "in.png")
    from engine.studio.filing.documents import opened as document

    own = document(tmp_path / "in.png", False, False, Watch())
    own = Session(own.painting, TileCache(16 << 20), folder=folder)
    own.do(c.parse(DEFINED[0]))
    bare = next(layers.layers(own.painting.root))
    own.do(c.parse(grow([[20, 20], [60, 30]], "stripes")))
    save(tmp_path / "a.ora", Snapshot(own.painting))
    found = open_painting(tmp_path / "a.ora")
    assert_same(own.painting, found.painting)
    layer = next(layers.layers(found.painting.root))
    assert bare.pyramid.ground is not None
    assert layer.pyramid.ground.pixels == bare.pyramid.ground.pixels
    again = replace(layer, growth=())
    assert np.array_equal(*(layer_planes(one, 0, Rect(0, 0, 80, 60)) for one in (bare, again)))
    with zipfile.ZipFile(tmp_path / "a.ora") as file:
        assert shown(file.read(f"data/L{layer.id}.png")).std() > 5
    own.do(c.parse({"do": "undo"}))
    save(tmp_path / "b.ora", Snapshot(own.painting))
    assert_same(own.painting, open_painting(tmp_path / "b.ora").painting)


def test_a_region_is_as_if_it_had_been_painted(session):
    """Its coarser masks too."""
    for plot in grown(session.painting):
        made = files.region_of(plot.region.exemplar, plot.region.seed, plot.region.masks[0])
        assert len(made.masks) == len(plot.region.masks) == len(plot.region.exemplar.levels)
        for one, other in zip(made.masks, plot.region.masks, strict=True):
            assert set(one) == set(other)
            assert all(np.array_equal(one[key].data, other[key].data) for key in one)
    empty = regions.empty(plot.region.exemplar)
    assert files.region_of(plot.region.exemplar, 0, NONE).masks == empty.masks


# ---- being killed ----

ROOT = Path(__file__).parents[3]
CHILD = """
import sys
from engine.archive.saving import Snapshot, save
from engine.archive.opening import open_painting
painting = open_painting(sys.argv[1]).painting
print("opened", flush=True)
for _ in range(100):
    save(sys.argv[2], Snapshot(painting))
    print("saved", flush=True)
"""


def test_killed_while_saving_the_file_is_whole(session, saved, tmp_path):
    target = tmp_path / "a.ora"
    target.write_bytes(saved.read_bytes())
    child = subprocess.Popen([sys.executable, "-c", CHILD, saved, target], stdout=subprocess.PIPE, cwd=ROOT)
    assert child.stdout.readline() == b"opened\n"
    assert child.stdout.readline() == b"saved\n"
    time.sleep(0.07)
    child.send_signal(signal.SIGKILL)
    child.wait()
    child.stdout.close()
    assert_same(session.painting, open_painting(target).painting)
