"""What the journal's threads post: light, as `requests`."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Tend:
    """There may be something to be done for the journal, or beside it."""
