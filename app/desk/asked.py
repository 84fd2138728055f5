"""What is asked of the artist, and what goes on after the answer."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from engine.studio.results import Overtaken

Then = Callable[[], None]


@dataclass(slots=True)
class Asked:
    """`dialog`: a row of app.panels.dialogs.DIALOGS that is to be shown; `shown`: the one that is; `then`: goes on once
    unsaved changes are dealt with, `otherwise` if they are not to be, `why`: what would take the painting's place;
    `after_save`: goes on once the painting is saved; `overtaken`: the save that is asked about; `quit`: the window is
    to go; `export_level`: how deep the exported picture goes; `texture`: a name under which one is being made, which
    joins the ink when the painting has it."""

    dialog: str = ""
    shown: str = ""
    then: Then | None = None
    otherwise: Then | None = None
    why: str = ""
    after_save: Then | None = None
    overtaken: Overtaken | None = None
    quit: bool = False
    export_level: int = 0
    texture: str = ""

    def show(self, dialog: str) -> None:
        """Opens a dialog by its name."""
        self.dialog = dialog

    def taken(self) -> str:
        """Gives the dialog that is to be shown, once."""
        self.shown, self.dialog = self.dialog, ""
        return self.shown

    def about_changes(self, then: Then, otherwise: Then | None = None, why: str = "") -> None:
        """Asks what is to become of unsaved changes, before `then`, or `otherwise` if the answer is to go back."""
        self.then, self.otherwise, self.why = then, otherwise, why
        self.show("unsaved")

    def about_overtaken(self, told: Overtaken) -> None:
        """Asks what is to become of a save; what follows it waits for the answer."""
        self.overtaken = told
        self.show("overtaken")

    def close(self) -> None:
        """Lets the window go."""
        self.quit = True

    def go_on(self) -> None:
        """Lets the changes go, and does what was to follow."""
        then, self.then, self.otherwise = self.then, None, None
        if then is not None:
            then()

    def give_up(self) -> None:
        """Lets nothing follow a save: it was given up, or went wrong."""
        if self.after_save is not None:
            self.after_save = None
            self.go_back()

    def go_back(self) -> None:
        """Leaves the painting as it is, changes and all."""
        otherwise, self.otherwise = self.otherwise, None
        if otherwise is not None:
            otherwise()

    def saved(self) -> None:
        """Goes on after a save, once."""
        then, self.after_save, self.otherwise = self.after_save, None, None
        if then is not None:
            then()
