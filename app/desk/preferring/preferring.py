"""Preferences are taken over at once where that can be, and written beside the window."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from app.desk.desk import Desk, FileWork
from app.desk.preferring.speaking import SpeakLanguage
from app.desk.proofing.proof_work import make_tables
from engine.keeping.preferences import Preferences, preferences_file
from engine.keeping.writing_preferences import write_preferences


@dataclass(frozen=True, slots=True)
class KeepPreferences(FileWork):
    """Writes them."""

    told: Preferences

    def carry_out(self) -> None:
        """Writes the file."""
        write_preferences(preferences_file(), self.told)

    def arrive(self, desk: Desk, found: None) -> None:
        """Tells nothing: they are seen."""

    def fail(self, desk: Desk, fault: str) -> None:
        """Tells that they are not kept."""
        desk.say(f"Preferences are not kept: {fault}", bad=True)


def prefer(desk: Desk, **told: Any) -> None:
    """Has other preferences from now on, by their names."""
    desk.preferred.now = replace(desk.preferred.now, **told)


def keep_preferences(desk: Desk, told: Preferences) -> None:
    """Writes others than those of the file; once nothing is dragged any more."""
    kept = desk.preferred.kept
    if told != kept:
        desk.preferred.kept = told
        desk.work(KeepPreferences(told))
        if (told.profile, told.proof) != (kept.profile, kept.proof):
            make_tables(desk, told)
        if told.language != kept.language:
            desk.work(SpeakLanguage(told.language))
