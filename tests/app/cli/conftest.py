"""A recording, and the painting that it makes."""

import pytest
from command_line import HEADER, STROKES

from app.__main__ import main


@pytest.fixture(scope="session")
def script(tmp_path_factory):
    path = tmp_path_factory.mktemp("script") / "a.jsonl"
    path.write_text(HEADER + STROKES)
    return path


@pytest.fixture(scope="session")
def saved(script):
    path = script.with_suffix(".ora")
    assert main(["play", str(script), "--save", str(path)]) == 0
    return path
