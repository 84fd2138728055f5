"""What is wrong with a pack, before the file and the member that hold it are known."""

from __future__ import annotations

from engine.files.fault import shown


class PackFault(Exception):
    """One line: the place in the pack, and what was found."""


def need(right: bool, what: str, found: object) -> None:
    """PackFault, unless it is right."""
    if not right:
        raise PackFault(f"{what}: found {shown(found)}")
