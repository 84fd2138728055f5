"""`inkfall solid`: objects of solids as pictures, and what is refused."""

import json

import numpy as np
import pygltflib
import pytest
import trimesh
from command_line import pixels, refused
from PIL import Image

from app.__main__ import main
from engine.solids.baked import colours_baked
from engine.solids.mesh import Mesh, open_edges
from engine.solids.mesh_files import read_mesh
from engine.solids.solid_lookup import Cubed, Procedural
from engine.solids.solid_rendering import Body, turning
from engine.terrain.drape import linear

POINTS = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1))
BOX = POINTS + "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"
SMALL = ("--size", "48x36", "--samples", "1")


def test_a_material_on_an_object(tmp_path, capsys):
    """The same words give the same picture; the object stands out, casts a shadow, and turns."""
    seen = {}
    (tmp_path / "m.obj").write_text(BOX)
    for name, words in {
        "one": ("--seed", "4"),
        "same": ("--seed", "4"),
        "seed": ("--seed", "5"),
        "turn": ("--seed", "4", "--turn", "-80,20.5"),
        "slider": ("--seed", "4", "--set", "bands=60"),
    }.items():
        out = tmp_path / f"{name}.png"
        assert main(["solid", "agate", str(out), "--on", str(tmp_path / "m.obj"), *SMALL, *words, "--json"]) == 0
        assert json.loads(capsys.readouterr().out)["size"] == [48, 36]
        seen[name] = pixels(out).astype(int)
    assert np.array_equal(seen["one"], seen["same"])
    for other in ("seed", "turn", "slider"):
        assert np.abs(seen[other] - seen["one"]).mean() > 1.0
    light = seen["one"].sum(axis=-1)
    assert light[24, 39] < 0.8 * light[24, 3]  # the lamp is on the left


def test_a_cube_on_a_mesh(tmp_path):
    """Red where the cube is red, through the object's own place in it."""
    cube = np.zeros((4, 4, 4, 3), np.uint8)
    cube[:2, ..., 0], cube[2:, ..., 2] = 255, 255  # red below the middle, blue above
    np.save(tmp_path / "c.npy", cube)
    (tmp_path / "m.obj").write_text("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\nf 4 3 2 1\n")
    out = tmp_path / "o.png"
    words = ["--on", str(tmp_path / "m.obj"), "--turn", "0,0", "--scale", "0.35", *SMALL]
    assert main(["solid", str(tmp_path / "c.npy"), str(out), *words]) == 0
    found = pixels(out).astype(int)
    assert found[12, 24, 2] > 2 * found[12, 24, 0]
    assert found[27, 24, 0] > 2 * found[27, 24, 2]


def test_a_cube_is_the_same_from_an_array_slices_and_their_picture(tmp_path):
    voxels = np.random.default_rng(4).integers(0, 256, (8, 8, 8, 3)).astype(np.uint8)
    np.save(tmp_path / "c.npy", voxels)
    Image.fromarray(voxels.reshape(64, 8, 3)).save(tmp_path / "c.png")
    (tmp_path / "c").mkdir()
    for z, slice_ in enumerate(voxels):
        Image.fromarray(slice_).save(tmp_path / "c" / f"slice-{z:04}.png")
    (tmp_path / "m.obj").write_text(BOX)
    seen = []
    for name in ("c.npy", "c.png", "c"):
        out = tmp_path / f"of-{name}.png"
        assert main(["solid", str(tmp_path / name), str(out), "--on", str(tmp_path / "m.obj"), *SMALL]) == 0
        seen.append(pixels(out))
    assert np.array_equal(seen[0], seen[1])
    assert np.array_equal(seen[0], seen[2])


def test_an_object_shows_what_was_painted_on_its_solid(tmp_path, capsys):
    red = {"do": "touch", "solid": "marble", "points": [[128, 128, 128]], "brush": {"radius": 96, "colour": "#ff0000"}}
    lines = [{"inkfall": 2, "frame": [0, 0, 64, 64], "seed": 1}, red]
    (tmp_path / "r.jsonl").write_text("".join(json.dumps(line) + "\n" for line in lines))
    (tmp_path / "m.obj").write_text(BOX)
    painting, out = tmp_path / "p.ora", tmp_path / "o.png"
    assert main(["play", str(tmp_path / "r.jsonl"), "--save", str(painting)]) == 0
    words = ["--on", str(tmp_path / "m.obj"), "--scale", "0.2", "--touches", str(painting), *SMALL]
    assert main(["solid", "marble", str(out), *words]) == 0
    middle = pixels(out).astype(int)[18, 24]
    assert middle[0] > 3 * middle[1]
    assert "no paint" in refused(capsys, "solid", "wood", str(out), *words)


def test_a_mesh_in_the_colours_of_the_solid(tmp_path, capsys):
    """Read back: turned, closed, upright, and at each corner the solid's colour as linear light."""
    (tmp_path / "m.obj").write_text(BOX)
    out = tmp_path / "o.glb"
    words = ["--on", str(tmp_path / "m.obj"), "--turn", "30,0", "--triangles", "4000", "--json"]
    assert main(["solid", "marble", str(out), *words]) == 0
    told = json.loads(capsys.readouterr().out)
    mesh = trimesh.load(out, force="mesh", process=False)
    assert told["triangles"] == len(mesh.faces)
    assert 2000 < len(mesh.faces) <= 4000
    whole = mesh.copy()
    whole.merge_vertices(merge_tex=True, merge_norm=True)
    assert whole.is_watertight
    assert abs(whole.volume - 8.0) < 1e-5
    assert abs(mesh.bounds[0, 1]) < 1e-6  # it stands on the ground, y upwards
    document = pygltflib.GLTF2().load(str(out))
    view = document.bufferViews[document.accessors[document.meshes[0].primitives[0].attributes.COLOR_0].bufferView]
    words16 = np.frombuffer(document.binary_blob(), "<u2", view.byteLength // 2, view.byteOffset).reshape(-1, 4)
    x, y, z = mesh.vertices.T
    inside = np.stack([x, -z, y - 1.0], axis=1) @ turning(30.0, 0.0)
    finest = 0.7 * np.sqrt(24.0 / 4000) * 0.42
    seen = Procedural("marble").colours(inside * 0.42 + 0.5, finest)
    assert np.abs((words16[:, :3] / 65535.0) ** (1 / 2.4) - linear(seen) ** (1 / 2.4)).max() < 2e-3
    assert seen.std() > 0.03


def test_edges_are_halved_where_colours_bend(tmp_path):
    """Two halves of one colour each: triangles gather where they meet, and none gapes."""
    cube = np.full((48, 2, 2, 3), 0.2, np.float32)
    cube[24:] = 0.9
    (tmp_path / "m.obj").write_text(BOX)
    made = colours_baked(Body(read_mesh(str(tmp_path / "m.obj")), Cubed(cube)), 60_000)
    height = made.points[made.faces].mean(axis=1)[:, 2]
    assert made.error < 0.05
    assert 15_000 < len(made.faces) <= 60_000
    assert open_edges(Mesh(made.points, made.normals, made.faces)) == 0
    assert (np.abs(height) < 0.2).mean() > 0.25  # of the surface 0.13


def test_what_cannot_be_is_refused(tmp_path, capsys):
    out = tmp_path / "o.png"
    np.save(tmp_path / "flat.npy", np.zeros((4, 4)))
    np.save(tmp_path / "text.npy", np.array([[["a"] * 2] * 2] * 2))
    np.save(tmp_path / "nan.npy", np.full((4, 4, 4), np.nan, np.float32))
    (tmp_path / "no.npy").write_bytes(b"nothing")
    (tmp_path / "m.obj").write_text("f 1 2 3")
    for words in (
        ("slate", out),
        ("wood", tmp_path / "o.jpg"),
        ("wood", out, "--on", "tree"),
        ("wood", out, "--on", tmp_path / "m.obj"),
        ("wood", out, "--set", "rings=1"),
        ("wood", out, "--set", "colour=1"),
        ("wood", out, "--turn", "1"),
        ("wood", out, "--scale", "0"),
        ("wood", out, "--size", "100000x100000"),
        ("wood", tmp_path / "o.glb", "--size", "9x9"),
        ("wood", tmp_path / "o.glb", "--on", "bust", "--triangles", "1000"),
        ("wood", out, "--triangles", "5000"),
        ("wood", out, "--map"),
        *((tmp_path / f"{name}.npy", out) for name in ("flat", "text", "nan", "no")),
        (tmp_path / "m.obj", out),
    ):
        assert "expected" in refused(capsys, "solid", *words) or "no such file" in refused(capsys, "solid", *words)
        assert not out.exists()
        assert not (tmp_path / "o.glb").exists()


def test_a_picture_is_wrapped_around_an_object(tmp_path):
    y, x = np.mgrid[:32, :32]
    picture = np.stack([128 + 100 * np.sin(2 * np.pi * x / 32), 90 + 0.0 * x, 200 - 2.0 * y], axis=2)
    Image.fromarray(picture.astype(np.uint8)).save(tmp_path / "e.png")
    assert main(["solid", str(tmp_path / "e.png"), str(tmp_path / "o.png"), "--map", "--on", "torus", *SMALL]) == 0
    assert pixels(tmp_path / "o.png")[:, :, 0].std() > 15.0


@pytest.mark.nightly
def test_a_cube_grows_from_an_example(tmp_path):
    rng = np.random.default_rng(0)
    Image.fromarray(rng.integers(0, 255, (32, 32, 3), dtype=np.uint8)).save(tmp_path / "e.png")
    out = tmp_path / "o.png"
    assert main(["solid", str(tmp_path / "e.png"), str(out), *SMALL]) == 0
    assert pixels(out).std() > 5.0
