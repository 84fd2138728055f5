"""Meshes of strangers: the three formats give the same object, and what is wrong is refused in one line."""

import json
import struct

import numpy as np
import pytest

from engine.files.fault import FileError
from engine.solids.mesh import open_edges, volume
from engine.solids.mesh_files import read_mesh

# A wedge that no turn or mirroring leaves alike, z up.
POINTS = np.array([(0, 0, 0), (2, 0, 0), (0, 1, 0), (0, 0, 4)], float)
FACES = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))
Y_UP = POINTS[:, [0, 2, 1]] * (1.0, 1.0, -1.0)


def obj(points=Y_UP):
    lines = [f"v {x} {y} {z} 1.0" for x, y, z in points]
    return "\n".join(lines + [f"f {a + 1}/1/1 {b - 4}//2 {c + 1}" for a, b, c in FACES]).encode()


def stl():
    kind = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
    rows = np.zeros(4, kind)
    rows["corners"] = POINTS[np.array(FACES)]
    return bytes(80) + (4).to_bytes(4, "little") + rows.tobytes()


def stl_text():
    rows = [
        f"facet\nouter loop\n{''.join('vertex {:g} {:g} {:g} '.format(*POINTS[n]) for n in f)}endloop" for f in FACES
    ]
    return "\n".join(["solid a", *rows, "endsolid"]).encode()


def glb(**changes):
    places = (Y_UP * 0.5 - 1.0).astype("<f4").tobytes()
    names = np.array(FACES, "<u2").tobytes()
    members = {
        "nodes": [{"children": [1]}, {"mesh": 0, "scale": [2, 2, 2], "translation": [2, 2, 2]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4},
            {"bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": 12},
        ],
        "bufferViews": [{"byteLength": len(places)}, {"byteOffset": len(places), "byteLength": len(names)}],
    }
    text = json.dumps(members | changes).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
    chunks += struct.pack("<II", len(places + names), 0x004E4942) + places + names
    return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks


def written(tmp_path, name, data):
    path = tmp_path / name
    path.write_bytes(data)
    return str(path)


@pytest.mark.parametrize(
    ("name", "data"), [("a.obj", obj()), ("a.stl", stl()), ("b.STL", stl_text()), ("a.glb", glb())]
)
def test_each_format_gives_the_same_upright_object(tmp_path, name, data):
    mesh = read_mesh(written(tmp_path, name, data))
    assert open_edges(mesh) == 0
    assert volume(mesh) == pytest.approx(8.0 / 6.0 / 8.0)
    expected = (POINTS - (1.0, 0.5, 2.0)) / 2.0
    assert {tuple(np.round(point, 6) + 0.0) for point in mesh.points} == {tuple(point + 0.0) for point in expected}


NODES = [{"children": [1]}, {"children": [0]}]
WRONG = {
    "a.txt": b"v 1 2 3",
    "a.obj": b"v 1 2",
    "b.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9",
    "c.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n",
    "d.obj": b"",
    "e.obj": b"v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3",
    "f.obj": b"v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3",
    "g.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -9",
    "h.obj": b"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 2",
    "a.stl": stl()[:-3],
    "b.stl": bytes(80) + b"\xff\xff\xff\xff",
    "c.stl": b"solid a vertex 1 2 3 vertex 1 2 x",
    "d.stl": b"",
    "a.glb": b"glTF" + b"\1\0\0\0" + bytes(20),
    "b.glb": glb()[:60],
    "c.glb": glb(nodes=[{"children": [1]}, {"children": [2]}, {"children": [1]}]),
    "d.glb": glb(accessors=[{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 10**8}] * 2),
    "e.glb": glb(meshes=[{"primitives": [{"attributes": {"POSITION": 9}}]}]),
    "f.glb": glb(meshes=7),
    "g.glb": glb(nodes=[*NODES, {"children": ["x"]}]),
    "h.glb": glb(accessors=[{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 1.5}] * 2),
    "i.glb": glb(nodes=[{"mesh": 0, "scale": [1, "x", 1]}]),
    "j.glb": glb(bufferViews=[{"byteStride": 1}, {}]),
    "k.glb": glb(nodes=[{"mesh": 0, "scale": [0, 0, 0]}]),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_is_told_in_one_line(tmp_path, name):
    path = written(tmp_path, name, WRONG[name])
    with pytest.raises(FileError) as told:
        read_mesh(path)
    assert str(told.value).startswith(path)
    assert "\n" not in str(told.value)


def test_what_is_not_there_is_told(tmp_path):
    with pytest.raises(FileError, match="cannot be read"):
        read_mesh(str(tmp_path / "none.obj"))
