"""Files for programs that work in space, read back by other libraries."""

import io

import numpy as np
import OpenEXR
import pygltflib
import pytest
import tifffile
import trimesh

from engine.files.spatial.exr_writer import write_exr
from engine.files.spatial.geotiff_writer import write_geotiff
from engine.files.spatial.glb_writer import GlbMesh, write_glb
from engine.files.spatial.stl_writer import write_stl


@pytest.mark.parametrize("size", [(1, 1), (37, 53), (64, 16)])
def test_exr_holds_the_bits(tmp_path, size):
    width, height = size
    pixels = np.random.default_rng(2).normal(0, 1e3, (height, width, 4)).astype(np.float32)
    pixels[0, 0] = [np.float32(1e-42), -0.0, 3e38, np.inf]
    pixels[height // 2 :, :, 2] = 0.25
    path = tmp_path / "a.exr"
    with open(path, "wb") as file:
        write_exr(file, size, "RGBA", (pixels[y : y + 7] for y in range(0, height, 7)), {"metresPerPixel": 2.5})
    with OpenEXR.File(str(path), separate_channels=True) as read:
        for i, name in enumerate("RGBA"):
            seen = read.channels()[name].pixels
            assert seen.dtype == np.float32
            assert np.array_equal(seen.view(np.uint32), pixels[:, :, i].view(np.uint32))
        assert read.header()["metresPerPixel"] == 2.5


def test_rows_that_are_missing_are_no_exr():
    with pytest.raises(ValueError, match="missing"):
        write_exr(io.BytesIO(), (4, 9), "Y", [np.zeros((8, 4, 1), np.float32)])
    with pytest.raises(ValueError, match="rows"):
        write_exr(io.BytesIO(), (4, 9), "Y", [np.zeros((10, 4, 1), np.float32)])


@pytest.mark.parametrize("shape", [(1, 1), (300, 530)])
def test_geotiff_holds_the_heights_with_scale_and_place(shape):
    heights = np.random.default_rng(5).normal(800, 300, shape).astype(np.float32)
    file = io.BytesIO()
    write_geotiff(file, heights, 2.5, (1000.0, -40.0))
    with tifffile.TiffFile(io.BytesIO(file.getvalue())) as read:
        assert read.is_geotiff
        page = read.pages[0]
        assert page.is_tiled
        assert np.array_equal(page.asarray(), heights)
        tags = page.geotiff_tags
        assert tags["ModelPixelScale"] == [2.5, 2.5, 0.0]
        assert tags["ModelTiepoint"] == [0, 0, 0, 1000.0, -40.0, 0]
        assert int(tags["ProjLinearUnitsGeoKey"]) == 9001


CORNERS = np.array([[0, 0, 0], [4, 0, 0], [4, 1, 3], [0, 2, 3]], float)
FACES = np.array([[0, 2, 1], [0, 3, 2]])


def test_glb_holds_positions_normals_and_colours(tmp_path):
    normals = np.tile([0.0, 1.0, 0.0], (4, 1))
    colours = np.linspace(0, 1, 12).reshape(4, 3)
    path = tmp_path / "a.glb"
    with open(path, "wb") as file:
        write_glb(file, GlbMesh(CORNERS, normals, FACES, colours, extras={"metres_per_pixel": 2.0}))
    document = pygltflib.GLTF2().load(str(path))
    attributes = document.meshes[0].primitives[0].attributes
    assert document.accessors[attributes.POSITION].max == [4, 2, 3]
    assert document.accessors[attributes.COLOR_0].normalized
    assert document.nodes[0].extras == {"metres_per_pixel": 2.0}
    mesh = trimesh.load(path, force="mesh", process=False)
    assert np.array_equal(mesh.vertices, CORNERS)
    assert np.array_equal(mesh.faces, FACES)
    assert np.array_equal(held(document, attributes.NORMAL, "<f4").reshape(4, 3), normals)
    words = held(document, attributes.COLOR_0, "<u2").reshape(4, 4)
    assert np.abs(words[:, :3] / 65535 - colours).max() < 1e-5
    assert (words[:, 3] == 65535).all()


def held(document, accessor, kind):
    """The numbers of an accessor of a GLB."""
    view = document.bufferViews[document.accessors[accessor].bufferView]
    return np.frombuffer(document.binary_blob()[view.byteOffset : view.byteOffset + view.byteLength], kind)


def test_stl_holds_the_triangles(tmp_path):
    path = tmp_path / "a.stl"
    with open(path, "wb") as file:
        write_stl(file, CORNERS, FACES)
    mesh = trimesh.load(path, process=False)
    assert np.array_equal(mesh.triangles, CORNERS[FACES])
