"""Brushes of other programs become the artist's own, with a line that tells what was left out, or nothing does."""

import json
import struct
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

from app.canvas.view import Place, View
from app.desk import presets
from app.desk.desk import Desk
from app.desk.files import carried_out
from app.desk.holding import kept_desk
from app.desk.presets import DEFAULT
from app.desk.sharing import strangers
from app.desk.sharing.bundle import read_bundle, write_bundle
from app.desk.sharing.preset_work import BRUSHES, bring_preset
from app.desk.sharing.strangers import STRANGERS
from engine.brush.settings import to_json
from engine.files.brushes.brush_files import ENDINGS
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.recording import Header
from engine.painting.rendering import strips
from engine.painting.value import first_painting
from engine.session.session import Session

L_SHAPE = np.zeros((40, 20), np.uint8)
L_SHAPE[:, :6] = L_SHAPE[-6:, :] = 255


@pytest.fixture
def desk(tmp_path, monkeypatch):
    monkeypatch.setattr(presets, "own_folder", lambda: tmp_path / "brushes")
    monkeypatch.setattr(kept_desk, "kept_file", lambda: tmp_path / "desk.json")
    made = Desk(View(Place(0, 0, 0), 0, 0.0, 1280, 800), [].append)
    made.known = replace(made.known, presets=(DEFAULT,))
    made.work = lambda job: carried_out(job).arrive(made)
    return made


def gbr(pixels, name):
    told = name.encode() + b"\0"
    head = struct.pack(">5I4sI", 28 + len(told), 2, pixels.shape[1], pixels.shape[0], 1, b"GIMP", 25)
    return head + told + pixels.tobytes()


def abr(*tips):
    """Version 2, not packed."""
    out = struct.pack(">HH", 2, len(tips))
    for name, pixels in tips:
        told = (name + "\0").encode("utf-16-be")
        body = struct.pack(">IHI", 0, 25, len(told) // 2) + told + struct.pack(">B4h", 1, 0, 0, 0, 0)
        body += struct.pack(">4iHB", 0, 0, *pixels.shape, 8, 0) + pixels.tobytes()
        out += struct.pack(">HI", 2, len(body)) + body
    return out


def on_disk():
    found, faults = presets.load_brushes(presets.own_folder())
    assert not faults
    return {preset.name: preset for preset in found}


def test_the_window_offers_all_that_can_be_read():
    assert STRANGERS == ENDINGS
    assert (".inkbrush", *ENDINGS) == BRUSHES


def test_a_tip_becomes_a_brush_that_paints_it(desk, tmp_path):
    (tmp_path / "l.gbr").write_bytes(gbr(L_SHAPE, "Ell"))
    for name in ("Ell", "Ell 2"):
        bring_preset(desk, tmp_path / "l.gbr")
        assert (desk.message.text, desk.hand.preset) == (f"Brought in the brush “{name}”", name)
    brush, *_ = (preset for preset in desk.known.presets if preset.name == "Ell")
    assert on_disk()["Ell"].brush == brush.brush
    session = Session(first_painting(Header((0, 0, 100, 100))))
    for texture in brush.textures:
        session.do(texture)
    told = {**to_json(brush.brush), "dynamics": {}}
    session.do(c.parse({"do": "stroke", "points": [[50, 50]], "brush": told}))
    seen = np.concatenate([band.copy() for band in strips(session.painting.root, 0, Rect(0, 0, 100, 100))], axis=1)[3]
    assert np.abs(seen[30:70, 40:60] - L_SHAPE / 255).mean() < 0.06
    assert seen.sum() == pytest.approx(L_SHAPE.sum() / 255, rel=0.03)


def test_many_brushes_of_a_file_lie_in_a_group_of_its_name_and_can_be_shared(desk, tmp_path):
    (tmp_path / "Set of two.abr").write_bytes(abr(("One", L_SHAPE), ("Two", L_SHAPE.T)))
    bring_preset(desk, tmp_path / "Set of two.abr")
    assert desk.message.text == "Brought in 2 brushes of Set of two.abr"
    assert {name: preset.group for name, preset in on_disk().items()} == {"One": "Set of two", "Two": "Set of two"}
    write_bundle(on_disk()["Two"], tmp_path / "two.inkbrush")
    shared = read_bundle(tmp_path / "two.inkbrush", tmp_path / "elsewhere", set())
    square = np.asarray(Image.open(shared.textures[0].arguments["path"]))
    assert square.sum() == L_SHAPE.sum(dtype=int)


def test_what_was_left_out_is_told_in_a_line_that_stays(desk, tmp_path):
    settings = {
        "slow_tracking": {"base_value": 2.0, "inputs": {}},
        "radius_logarithmic": {"base_value": 1.0, "inputs": {}},
    }
    (tmp_path / "Blend.myb").write_text(json.dumps({"version": 3, "settings": settings}))
    bring_preset(desk, tmp_path / "Blend.myb")
    (notice,) = desk.notices.rows
    assert (notice.text, notice.bad) == ("Brought in the brush “Blend”, without slow tracking", False)
    assert desk.hand.brush.radius == pytest.approx(np.e)
    (tmp_path / "l.gbr").write_bytes(gbr(L_SHAPE, "Ell"))
    bring_preset(desk, tmp_path / "l.gbr")
    assert not desk.notices.rows, "it is of the brush before"


def test_one_that_cannot_be_written_leaves_none_of_its_file(desk, tmp_path, monkeypatch):
    keep, left = presets.save_brush, [1]

    def full(*given):
        if not left:
            raise OSError(28, "No space left on device", "brushes")
        left.pop()
        return keep(*given)

    monkeypatch.setattr(presets, "save_brush", full)
    (tmp_path / "two.abr").write_bytes(abr(("One", L_SHAPE), ("Two", L_SHAPE.T)))
    bring_preset(desk, tmp_path / "two.abr")
    assert (desk.message.text, desk.message.bad) == ("No brush was brought in: brushes: the disk is full", True)
    assert not list(presets.own_folder().iterdir())


@pytest.mark.parametrize("ending", strangers.STRANGERS)
def test_what_is_no_brush_is_refused_in_a_line_and_leaves_nothing(ending, desk, tmp_path):
    path = tmp_path / f"bad{ending.upper()}"
    path.write_bytes(b"\0\1\2 nothing")
    bring_preset(desk, path)
    assert desk.message.bad
    assert desk.message.text.startswith(f"No brush was brought in: {path.name}: ")
    assert "\n" not in desk.message.text
    assert "fault" not in desk.message.text
    assert not presets.own_folder().exists()
