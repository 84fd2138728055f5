"""Ladders written by the processes of a real Dask cluster: the same bytes, whoever dies meanwhile."""

import os
import signal

import pytest
from distributed import Client

from app.__main__ import main
from engine.archive.export import Picture
from engine.archive.ladder.cluster import LOCAL, connected, write_on_cluster
from engine.archive.ladder.ladder_files import write_folder
from engine.archive.ladder.on_workers import Order, version, write_block
from engine.archive.ladder.rungs import Ladder
from engine.archive.saving import Snapshot, save
from engine.canvas.tile_cache import TileCache
from engine.files.fault import Cancelled, WriteError
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.session.apply import Painting
from engine.session.session import Session

RECT = Rect.at(77, 41, 2040, 1990)


@pytest.fixture(scope="module")
def address(tmp_path_factory):
    """A cluster of a process for each core."""
    with connected("a", LOCAL) as client:
        yield client.scheduler.address


@pytest.fixture(scope="module")
def painted(tmp_path_factory):
    """A painting, and the bytes of its file."""
    session = Session(Painting(Rect.at(0, 0, 900, 600), 3), TileCache(64 << 20))
    ink = [{"texture": "rock", "amount": 0.8, "colour": "#ffffff", "period": 16}]
    for layer, level, radius in (("a", -3, 20), ("b", 1, 90)):
        session.do(c.parse({"do": "layer", "add": layer}))
        brush = {"radius": radius, "colour": "#3070c0", "ink": ink, "opacity": 0.8}
        points = [[0, 0], [600, 300, 0.6]]
        session.do(c.parse({"do": "stroke", "level": level, "origin": [9, 9], "points": points, "brush": brush}))
    path = tmp_path_factory.mktemp("painted") / "a.ora"
    save(path, Snapshot(session.painting))
    return session.painting, path.read_bytes()


def content(folder):
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize(("ending", "dead"), [("zarr", 1), ("dzi", None)])
def test_workers_die_and_not_a_bit_differs(painted, tmp_path, address, ending, dead):
    """One of them, or all, with the painting that they had."""
    painting, data = painted
    picture = Picture(painting, 2, RECT, layer="b")
    for name in ("one", "many"):
        (tmp_path / name).mkdir()
    write_folder(tmp_path / "one" / f"a.{ending}", picture)
    seen = []

    def tell(part):
        if not seen:
            with Client(address, set_as_default=False) as client:
                for number in list(client.run(os.getpid).values())[:dead]:
                    os.kill(number, signal.SIGKILL)
        seen.append(part)

    write_on_cluster(tmp_path / "many" / f"a.{ending}", picture, data, address, tell)
    assert seen == sorted(seen)
    assert seen[-1] == 1.0
    assert len(seen) > 20
    one, many = content(tmp_path / "one"), content(tmp_path / "many")
    assert set(one) == set(many)
    assert all(one[path] == many[path] for path in one)


def test_who_gives_up_leaves_nothing(painted, tmp_path, address):
    painting, data = painted
    seen = []
    with pytest.raises(Cancelled):
        write_on_cluster(
            tmp_path / "a.zarr", Picture(painting, 2, RECT), data, address, seen.append, lambda: bool(seen)
        )
    assert list(tmp_path.iterdir()) == []


def test_the_command_line_asks_a_cluster(painted, tmp_path, address, capsys):
    (tmp_path / "a.ora").write_bytes(painted[1])
    one, many = tmp_path / "one.zarr", tmp_path / "many.zarr"
    words = ["export", str(tmp_path / "a.ora"), "--rect", "1,5,5,700,400", "--depth", "16"]
    for out, *more in ((one,), (many, "--dask", address), (many, "--dask", address, "--salvage")):
        assert main([*words, str(out), *more]) == 0
        assert {path: data for path, data in content(out).items() if path.name != "zarr.json"} == {
            path: data for path, data in content(one).items() if path.name != "zarr.json"
        }
    capsys.readouterr()
    assert main([*words, str(tmp_path / "a.png"), "--dask", address]) == 2
    assert capsys.readouterr().err == "inkfall: --dask: found it for .png, expected it for .zarr or .dzi\n"


def test_what_goes_wrong_is_told_in_a_line(painted, tmp_path):
    painting, data = painted
    ladder = Ladder.of("a", 0, Rect.at(0, 0, 9, 9), 8, 512, 512)
    block = next(ladder.blocks())
    target = str(tmp_path / "elsewhere" / "a.zarr")
    with pytest.raises(WriteError, match="a folder that all workers share"):
        write_block(block, Order("1", ladder, None, target, ".zarr", version()), data)
    with pytest.raises(WriteError, match="another version of Inkfall"):
        write_block(block, Order("2", ladder, None, str(tmp_path), ".zarr", "0"), data)
    with pytest.raises(WriteError, match="no Dask scheduler answers at 'nothing://here'"):
        write_on_cluster(tmp_path / "a.zarr", Picture(painting), data, "nothing://here")
    assert list(tmp_path.iterdir()) == []
