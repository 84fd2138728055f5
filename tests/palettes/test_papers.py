"""The bundled papers: each can be painted on, holds a light touch by its peaks alone, and is chosen by its name."""

from __future__ import annotations

import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from app.desk import presets
from app.desk.hand import Hand
from app.desk.known import Known
from app.panels.controls import texture_rows
from engine.brush.relief import resolve
from engine.brush.settings import Brush
from engine.numeric.address import TileKey
from engine.painting.value import Painting
from engine.session.apply import apply
from engine.studio.requests import Swatch
from engine.studio.textures.swatches import painted

PAPERS, FAULTS = presets.load_papers(presets.papers_folder())


def test_there_are_papers_to_choose_from():
    assert not FAULTS
    assert len(PAPERS) >= 6
    assert len({paper.name for paper in PAPERS}) == len(PAPERS)


@pytest.mark.parametrize("paper", PAPERS, ids=lambda paper: paper.name)
def test_light_touches_meet_the_peaks_and_firm_ones_all(paper):
    size = (128, 96)
    # Beyond its period the surface would only repeat.
    brush = Brush(radius=60.0, grain=paper.grain)
    light = painted(Swatch("", replace(brush, opacity=0.3), size, textures=paper.textures), Painting())
    seen = light[3, 30:70, 30:100]
    # The thumbnail's stroke rises to full pressure and falls: bare paper and touched peaks side by side.
    assert float((seen < 0.02).mean()) > 0.03, paper.name
    assert float((seen > 0.15).mean()) > 0.05, paper.name
    firm = painted(Swatch("", brush, size, "fill", textures=paper.textures), Painting())
    assert float(firm[3].min()) > 0.99


@pytest.mark.parametrize("level", [-2, 0, 3])
@pytest.mark.parametrize("paper", PAPERS, ids=lambda paper: paper.name)
def test_papers_lie_still_and_repeat_by_their_size_at_every_level(paper, level):
    """A virtual surface is indexed by the place, modulo its size (Lewis 1984, section 6.1)."""
    painting = Painting()
    for definition in paper.textures:
        painting = apply(painting, definition)
    surface = resolve(Brush(grain=paper.grain), painting.textures, level, (7, 7)).grain
    tiles = int(paper.grain.parameters["period"]) << (level + 2)  # across 512 of its periods
    here, far = (surface.plane(TileKey(level, 1 + n * tiles, -2 - n * tiles)) for n in (0, 10**30))
    assert np.array_equal(here, far)
    assert here.std() > 0.01


def test_one_name_is_one_texture_wherever_it_comes_from():
    found, _ = presets.load_brushes(presets.bundled_folder())
    first: dict[str, object] = {}
    for source in (*found, *PAPERS):
        for command in source.textures:
            assert first.setdefault(command.name, command) == command, (command.name, source.name)


def test_papers_are_offered_and_come_along():
    desk = SimpleNamespace(known=Known(papers=tuple(PAPERS)), hand=Hand())
    for paper in PAPERS:
        assert paper.grain.texture in dict(texture_rows.names(desk))
        texture_rows.bring(desk, paper.grain.texture)
    assert {command.name for command in desk.hand.needs} == {paper.grain.texture for paper in PAPERS}


def test_what_is_no_paper_is_told_in_a_line(tmp_path):
    (tmp_path / "a.json").write_text("[]")
    (tmp_path / "b.json").write_text(json.dumps({"name": "b", "grain": {"amount": 1}}))
    found, faults = presets.load_papers(tmp_path)
    assert not found
    assert [fault.split(":")[0] for fault in faults] == ["a.json", "b.json"]
    assert "expected a paper" in faults[0]
    assert "grain.texture" in faults[1]
    assert np.all(["\n" not in fault for fault in faults])
