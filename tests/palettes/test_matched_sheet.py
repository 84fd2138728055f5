"""The sheet of matched textures shows what its script says: examples, mixtures of them, and solids."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import pytest


@pytest.fixture(scope="module")
def sheet(script_of):
    return script_of("make_matched")


def test_rows_of_examples_and_mixtures_are_as_long(sheet):
    found = sheet.examples()
    mixtures = sheet.mixtures(found)
    assert len(found) == len(mixtures) == 7
    assert {picture.shape[1:] for picture in (*found.values(), *mixtures)} == {(sheet.SIDE, sheet.SIDE)}
    first = mixtures[0].mean((1, 2))
    assert first[1] > max(first[0], first[2])  # green, as moss is


def test_a_solid_is_shown_by_slices_and_faces_that_fit(sheet):
    with ThreadPoolExecutor(2) as threads:
        body = sheet.voxels(sheet.examples()["moss"], threads, 8)
    assert body.shape == (8, 8, 8, 3)
    shown = sheet.shown(body)
    width = 7 * (sheet.SIDE + sheet.GAP) - sheet.GAP
    assert len(sheet.SOLIDS) * (shown.shape[1] + sheet.GAP // 2) <= width + sheet.GAP // 2
    assert (shown[:, : sheet.SLICE].min(axis=2) < 1.0).sum() == 2 * sheet.SLICE**2
    assert shown[len(shown) // 2, -10].max() < 1.0
