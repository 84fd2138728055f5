"""The artist's preferences in force, and as they were written last."""

from __future__ import annotations

from dataclasses import dataclass

from engine.keeping.preferences import Preferences


@dataclass(slots=True)
class Preferred:
    """`now`: in force; `kept`: as the file has them."""

    now: Preferences = Preferences()  # noqa: RUF009  # it never changes
    kept: Preferences = Preferences()  # noqa: RUF009  # likewise
