"""The programs of the card, as text."""

from __future__ import annotations

from pathlib import Path


def shader_source(name: str) -> str:
    """Returns a file of the `shaders` folder, which lies beside the packages, in a checkout as in an installation."""
    return (Path(__file__).resolve().parents[2] / "shaders" / name).read_text("utf-8")
