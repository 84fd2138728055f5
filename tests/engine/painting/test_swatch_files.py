"""Pictures of brushes in files: the same pixels, and painted anew whenever a file is not what it should be."""

import numpy as np
import pytest
from immutables import Map

from engine.brush.settings import Brush
from engine.painting import commands as c
from engine.painting.value import Painting
from engine.studio import requests as q
from engine.studio import results
from engine.studio.studio import Studio
from engine.studio.textures import swatch_files

ASKED = q.Swatch("it", Brush(radius=6.0, colour="#804020"), (40, 20), kept=True)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    return tmp_path / "swatches"


def painted(request):
    """The picture that a studio sends."""
    sent = []
    studio = Studio(sent.append, lambda request: None)
    studio.do(request)
    studio.close()
    [picture] = [result for result in sent if isinstance(result, results.Picture)]
    return picture.pixels


def test_a_second_studio_takes_it_from_its_file(folder, monkeypatch):
    first = painted(ASKED)
    assert len(list(folder.iterdir())) == 1
    monkeypatch.setattr("engine.studio.textures.swatches.painted", None)  # it cannot be painted any more
    assert np.array_equal(painted(ASKED), first)
    assert not painted(ASKED).flags.writeable


@pytest.mark.parametrize("damage", [b"", b"not an array", None], ids=["empty", "other", "half"])
def test_a_damaged_file_is_painted_anew(folder, damage):
    first = painted(ASKED)
    [path] = folder.iterdir()
    whole = path.read_bytes()
    path.write_bytes(whole[: len(whole) // 2] if damage is None else damage)
    assert np.array_equal(painted(ASKED), first)
    assert path.read_bytes() == whole


@pytest.mark.parametrize(
    "other",
    [{"size": (41, 20)}, {"kind": "fill"}, {"zoom": 1}, {"brush": Brush(radius=6.0, colour="#804021")}],
    ids=["size", "kind", "zoom", "colour"],
)
def test_another_picture_has_another_file(folder, other):
    painted(ASKED)
    painted(q.Swatch(**{**{name: getattr(ASKED, name) for name in q.Swatch.__slots__}, **other}))
    assert len(list(folder.iterdir())) == 2


def test_what_may_change_is_not_kept(folder, tmp_path):
    lost = c.DefineTexture("Photo", "image", Map(path=str(tmp_path / "gone.png")))
    assert swatch_files.kept(ASKED, Painting(textures=Map({"own": None}))) is None
    for request in (
        q.Swatch("it", ASKED.brush, (40, 20)),
        q.Swatch("it", ASKED.brush, (40, 20), textures=(lost,), kept=True),
    ):
        swatch_files.keep(request, Painting(), np.zeros((20, 40, 4), np.uint8))
        assert not folder.exists()


def test_with_pictures_it_is_kept_until_one_of_them_changes(folder, tmp_path):
    path, other = tmp_path / "photo.png", tmp_path / "other.png"
    path.write_bytes(b"one")
    other.write_bytes(b"one")
    mixed = c.DefineTexture("Mixed", "mix", Map(path=str(path), pattern=str(other)))
    request = q.Swatch("it", ASKED.brush, (40, 20), textures=(mixed,), kept=True)
    pixels = np.full((20, 40, 4), 7, np.uint8)
    swatch_files.keep(request, Painting(), pixels)
    assert np.array_equal(swatch_files.kept(request, Painting()), pixels)
    other.write_bytes(b"two and more")
    assert swatch_files.kept(request, Painting()) is None


def test_there_are_never_too_many(folder, monkeypatch):
    monkeypatch.setattr(swatch_files, "MOST_KEPT", 5)
    for radius in range(1, 20):
        swatch_files.keep(
            q.Swatch("it", Brush(radius=radius), (8, 8), kept=True), Painting(), np.zeros((8, 8, 4), "u1")
        )
        assert len(list(folder.iterdir())) <= 5


def test_a_folder_that_cannot_be_written_to_is_done_without(tmp_path, monkeypatch):
    (tmp_path / "file").write_bytes(b"")
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "file"))
    assert painted(ASKED).shape == (20, 40, 4)
