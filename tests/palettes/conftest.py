"""Scripts that draw the pictures of the README, loaded as modules."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def script_of():
    """Loads a script of palettes/pictures by its name; the search path stays as it is."""

    def loaded(name):
        before = list(sys.path)
        path = Path(__file__).resolve().parents[2] / "palettes" / "pictures" / f"{name}.py"
        spec = importlib.util.spec_from_file_location(name, path)
        assert spec is not None
        assert spec.loader is not None
        made = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(made)
        sys.path[:] = before
        return made

    return loaded
