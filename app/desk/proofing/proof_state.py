"""By which tables the window's colours go to the screen."""

from __future__ import annotations

from dataclasses import dataclass

from engine.files.profiles.screen_table import ScreenTable


@dataclass(slots=True)
class ProofState:
    """`screen`: the table of the screen's profile, None where colours are sent as they are; `proof`: of what is
    imitated on it; `on`: it is imitated now."""

    screen: ScreenTable | None = None
    proof: ScreenTable | None = None
    on: bool = False

    @property
    def shown(self) -> ScreenTable | None:
        """Gives the table in force."""
        return self.proof if self.on and self.proof is not None else self.screen

    def words(self) -> tuple[str, str]:
        """Returns what the status line tells of it, and the hint."""
        table = self.shown
        if table is None:
            off = "Click to see the painting as by the profile that is chosen in Preferences"
            return ("", "") if self.proof is None else ("Proof off", off)
        hint = f"The window is shown by the screen’s profile, {table.title}; what is painted stays as it is"
        if not table.proof:
            return "Profile", hint
        return "Soft proof", f"Seen as by {table.proof}, on a screen of {table.title}; what is painted stays as it is"
