"""`inkfall terrain`: height maps, meshes, and the line that says what is wrong; EXR of a painting's colours."""

import json

import numpy as np
import OpenEXR
import pytest
import tifffile
import trimesh
from command_line import pixels, refused

from app.__main__ import main
from engine.archive.opening import open_painting
from engine.numeric.address import Rect
from engine.terrain.plane import land

PLACE = "2,60,60,65,33"
RECT = Rect.at(60, 60, 65, 33)


@pytest.fixture(scope="module")
def heights(saved):
    """Heights of that place, in pixels of its level."""
    return 4.0 * land(open_painting(saved).painting, "Sky", 40).height(2, RECT)


def terrain(saved, out, *words, height=("--height", "Sky", "--scale", "40")):
    return main(["terrain", str(saved), str(out), "--rect", PLACE, *height, *map(str, words)])


def test_how_far_the_land_is_from_a_mesh_is_told(tmp_path, capsys):
    """Triangles are at most so far from the land four levels below as was said."""
    ink = {"texture": "rock", "amount": 1, "period": 64, "roughness": 0.7, "renew": False, "colour": "#ffffff"}
    lines = (
        {"inkfall": 2, "frame": [0, 0, 64, 64], "seed": 3},
        {"do": "stroke", "points": [[32, 32]], "brush": {"radius": 60, "colour": "#404040", "ink": [ink]}},
    )
    (tmp_path / "a.jsonl").write_text("\n".join(map(json.dumps, lines)))
    assert main(["play", str(tmp_path / "a.jsonl"), "--save", str(tmp_path / "a.ora")]) == 0
    words = "--rect", "1,40,40,32,32", "--scale", "40"
    capsys.readouterr()
    assert main(["terrain", str(tmp_path / "a.ora"), str(tmp_path / "a.stl"), *words, "--error", "0.5"]) == 0
    told = capsys.readouterr().out.splitlines()[1].split()
    assert " ".join(told).startswith("the land, at any depth, is at most ")
    promised = float(told[told.index("most") + 1])
    deep = land(open_painting(tmp_path / "a.ora").painting, scale=40).height(5, Rect.at(41 << 4, 41 << 4, 480, 480))
    mesh = trimesh.load(tmp_path / "a.stl")
    some = np.arange(3, 477, 43)
    x, y = (axis.ravel() for axis in np.meshgrid(*2 * [(some + 0.5) / 16 + 0.5]))  # from the first sample
    corners = mesh.triangles[mesh.face_normals[:, 2] > 1e-6]
    parts = trimesh.triangles.points_to_barycentric(
        np.repeat(corners * [1, 1, 0], x.size, axis=0), np.tile(np.stack([x, -y, 0 * x], 1), (len(corners), 1))
    ).reshape(len(corners), x.size, 3)
    within = parts.min(axis=2).argmax(axis=0)
    z = (parts[within, np.arange(x.size)] * corners[within, :, 2]).sum(axis=1)
    off = np.abs(z - 2.0 * deep[np.ix_(some, some)].ravel()).max()
    assert 0.1 * promised < off <= promised


@pytest.mark.parametrize("target", ["godot", "unreal", "unity", "blender", "gis"])
def test_height_maps_for_programs(saved, heights, tmp_path, capsys, target):
    metres = (2.5 * heights.astype(np.float32)).astype(np.float32)
    words = "--for", target, "--metres-per-pixel", 2.5
    for name in ("a.exr", "a.tif", "a.png"):
        out = tmp_path / name
        assert terrain(saved, out, *words) == 0
        facts = json.loads(out.with_suffix(".json").read_text())
        assert (facts["for"], facts["file"], facts["size"]) == (target, name, [65, 33])
        assert facts["code_0"] == facts["height_min"] == pytest.approx(metres.min())
        assert facts["code_65535"] == pytest.approx(metres.max())
        assert facts["metres_per_pixel"] == 2.5
    with OpenEXR.File(str(tmp_path / "a.exr")) as file:
        assert np.array_equal(file.channels()["Y"].pixels, metres)
    assert np.array_equal(tifffile.imread(tmp_path / "a.tif"), metres)
    codes = facts["code_0"] + pixels(out) / 65535 * (facts["code_65535"] - facts["code_0"])
    assert np.abs(codes - metres).max() < 1e-5 * np.ptp(metres)
    told = capsys.readouterr().err
    assert (f"{target} takes sides of" in told) == (target in ("unreal", "unity"))


def test_meshes_keep_their_error(saved, heights, tmp_path, capsys):
    assert terrain(saved, tmp_path / "a.stl", "--error", 0.3, "--base", 7, "--metres-per-pixel", 2) == 0
    triangles = int(capsys.readouterr().out.split()[0])
    body = trimesh.load(tmp_path / "a.stl")
    assert len(body.faces) == triangles
    assert body.is_watertight
    assert body.volume > 0
    assert body.bounds[0, 2] == pytest.approx(2 * (heights.min() - 7), rel=0.01)
    assert np.ptp(body.bounds[:, :2], axis=0).tolist() == [130, 66]
    assert terrain(saved, tmp_path / "a.glb", "--triangles", 500) == 0
    told = capsys.readouterr().out
    mesh = trimesh.load(tmp_path / "a.glb", force="mesh", process=False)
    assert 300 < len(mesh.faces) <= 500
    assert told.startswith(f"{len(mesh.faces)} triangles")
    assert mesh.face_normals[:, 1].min() > 0
    x, z = (mesh.vertices[:, i].astype(int) for i in (0, 2))
    inside = (x < 65) & (z < 33)
    assert np.allclose(mesh.vertices[inside, 1], heights[z[inside], x[inside]], atol=1e-4)


def test_a_mesh_with_a_base_is_closed_as_glb(saved, tmp_path):
    assert terrain(saved, tmp_path / "a.glb", "--base", 4) == 0
    mesh = trimesh.load(tmp_path / "a.glb", force="mesh", process=False)
    mesh.merge_vertices(merge_norm=True, merge_tex=True)
    assert mesh.is_watertight
    assert mesh.volume > 0


def test_colours_as_floats(saved, tmp_path):
    assert main(["export", str(saved), str(tmp_path / "a.exr")]) == 0
    assert main(["export", str(saved), str(tmp_path / "a.png"), "--depth", "16"]) == 0
    with OpenEXR.File(str(tmp_path / "a.exr"), separate_channels=True) as file:
        seen = np.stack([file.channels()[name].pixels for name in "RGBA"], 2)
    assert seen.dtype == np.float32
    assert seen.shape == (48, 64, 4)
    shown = pixels(tmp_path / "a.png")
    if shown.dtype == np.uint8:  # Pillow reads 16-bit RGBA as 8
        shown = shown.astype(float) * 257
    alpha = shown[:, :, 3] / 65535
    assert np.abs(seen[:, :, 3] - alpha).max() < 0.005
    straight = shown[:, :, :3] / 65535
    light = np.where(straight <= 0.04045, straight / 12.92, ((straight + 0.055) / 1.055) ** 2.4)
    assert np.abs(seen[:, :, :3] - light * alpha[:, :, None]).max() < 0.02
    assert seen[:, :, :3].max() > 0.1


def test_pictures(saved, tmp_path):
    out = tmp_path / "a.png"
    words = "--size", "48x30", "--samples", 2, "--sea", 0.1
    assert terrain(saved, out, *words, "--fit") == 0
    whole = pixels(out)
    assert whole.shape == (30, 48, 3)
    assert np.ptp(whole) > 60
    assert terrain(saved, out, *words, "--camera", f"40,{30 << 40},{25 << 40},20,-30,-15", "--sun", "200,40") == 0
    assert not np.array_equal(pixels(out), whole)


GREY = {"radius": 400, "hardness": 1, "colour": "#808080", "dynamics": {}}
PLAIN = {
    "empty": [],
    "transparent": [{"do": "layer", "add": "Height"}, {"do": "layer", "set": "Height", "role": "height"}],
    "flat": [
        {"do": "layer", "add": "Height"},
        {"do": "stroke", "brush": GREY, "points": [[20, 20], [40, 30]]},
        {"do": "layer", "set": "Height", "role": "height"},
    ],
}


@pytest.mark.parametrize("name", PLAIN)
def test_land_without_hills_is_ground_below_a_paler_sky(tmp_path, name):
    painting, out = str(tmp_path / "a.ora"), tmp_path / "a.png"
    recording = tmp_path / "a.jsonl"
    head = {"inkfall": 1, "frame": [0, 0, 64, 48], "seed": 1}
    recording.write_text("".join(json.dumps(line) + "\n" for line in (head, *PLAIN[name])))
    assert main(["play", str(recording), "--save", painting]) == 0
    words = "--size", "32x40", "--samples", "1", "--camera", "0,32,40,20,0,0,50"
    assert main(["terrain", painting, str(out), *words]) == 0
    seen = pixels(out).astype(int)
    assert (seen[:4] - seen[-4:]).mean(axis=(0, 1))[2] > 20  # the sky is bluer than the ground
    assert np.abs(np.diff(seen[-12:], axis=1)).max() < 40  # nothing stands on it


WRONG = {
    "below the ground": (["a.png", "--camera", "0,1,1,-5"], "--camera: found a height of -5, expected one above"),
    "a camera too deep": (["a.png", "--camera", "4000,1,1,5"], "--camera: found level 4000, expected at most 1000"),
    "no camera": (["a.png", "--camera", "here"], "or the name of a bookmark"),
    "no sun": (["a.png", "--sun", "20,-4"], "altitude above 0"),
    "a camera of a map": (["a.png", "--for", "gis", "--fit"], "--fit: found it for .png"),
    "less than no haze": (["a.png", "--haze", "-1"], "--haze: found -1"),
    "no samples": (["a.png", "--samples", "0"], "--samples: found 0"),
    "another ending": (["a.obj"], "expected .png or"),
    "no such layer": (["a.stl", "--height", "None"], "--height: layer: found 'None'"),
    "error of a map": (["a.exr", "--for", "gis", "--error", "1"], "--error: found it for .exr"),
    "a map of nobody": (["a.tif"], "--for"),
    "both": (["a.glb", "--error", "1", "--triangles", "9"], "expected one of them"),
    "for a mesh": (["a.glb", "--for", "gis"], "--for: found it for .glb"),
    "too few": (["a.stl", "--triangles", "3"], "--triangles: found 3 triangles, expected at least"),
    "too large": (["a.stl", "--rect", "0,0,0,9000,9"], "at most 8193"),
    "too deep": (["a.stl", "--rect", "4000,0,0,9,9"], "found level 4000, expected at most 1000"),
    "a scale beyond": (["a.stl", "--scale", "1e99"], "expected a number"),
    "a negative size": (["a.stl", "--metres-per-pixel", "-1"], "above 0"),
    "onto itself": (["{saved}"], "expected .png or"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_is_told(saved, tmp_path, capsys, name):
    (out, *words), told = WRONG[name]
    assert told in refused(capsys, "terrain", saved, tmp_path / out.format(saved=saved), *words)
    assert list(tmp_path.iterdir()) == []


def test_nothing_half_written_is_left(saved, tmp_path, capsys):
    (tmp_path / "a.json").mkdir()
    out = tmp_path / "a.exr"
    assert "a.json" in refused(capsys, "terrain", saved, out, "--rect", PLACE, "--for", "gis", status=1)
    assert not out.exists()


@pytest.mark.parametrize("place", ["0,100000,100000,5,4", f"40,{30 << 40},{25 << 40},9,9"])
def test_places_where_nothing_is_painted_or_that_are_deep(saved, tmp_path, place):
    for name, *words in (("a.stl",), ("a.glb",), ("a.png", "--for", "unity")):
        assert main(["terrain", str(saved), str(tmp_path / name), "--rect", place, *words]) == 0
        assert (tmp_path / name).stat().st_size > 60
