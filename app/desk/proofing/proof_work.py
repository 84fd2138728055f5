"""The tables are made beside the window: of the profile that the system or the artist has chosen for the screen."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from app.desk.desk import Desk, FileWork
from app.input.x_profile import x_profile
from engine.files.profiles.screen_table import ScreenTable
from engine.keeping.preferences import Preferences

BY_SYSTEM, BY_NONE = "screen", "none"
PROFILES = (".icc", ".icm")
Tables = tuple[ScreenTable | None, ScreenTable | None]


@dataclass(frozen=True, slots=True)
class MakeTables(FileWork):
    """`profile` and `proof` as of the preferences."""

    profile: str
    proof: str

    def carry_out(self) -> Tables:
        """Reads both and makes their tables."""
        held = x_profile() if self.profile == BY_SYSTEM else b""
        if not (held or self.proof or self.profile not in (BY_SYSTEM, BY_NONE)):
            return None, None
        from engine.files.profiles.icc_profile import profile_of, read_profile  # here: it takes its time to load
        from engine.files.profiles.screen_table import screen_table

        screen = None
        if held:
            screen = profile_of(held, "the screen's profile")
        elif self.profile not in (BY_SYSTEM, BY_NONE):
            screen = read_profile(Path(self.profile))
        table = None if screen is None else screen_table(screen)
        return table, screen_table(screen, read_profile(Path(self.proof))) if self.proof else None

    def arrive(self, desk: Desk, found: Tables) -> None:
        """Has the window shown by them."""
        desk.proofing.screen, desk.proofing.proof = found
        desk.proofing.on = desk.proofing.on and found[1] is not None

    def fail(self, desk: Desk, fault: str) -> None:
        """Sends colours as they are, and tells why."""
        desk.proofing.screen = desk.proofing.proof = None
        desk.say(f"Colours are shown as they are: {fault}", bad=True)


def make_tables(desk: Desk, told: Preferences) -> None:
    """Asks for the tables that preferences want."""
    desk.work(MakeTables(told.profile, told.proof))
