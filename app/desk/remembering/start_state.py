"""The page that the first start shows."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(slots=True)
class StartState:
    """`shown`: whether it is on the screen; `welcomed`: whether it was once, and so never comes by itself again."""

    shown: bool = False
    welcomed: bool = False

    def show(self) -> None:
        """Shows it, which counts as its one time."""
        self.shown = self.welcomed = True

    def welcome(self) -> None:
        """Shows it, if it never was."""
        if not self.welcomed:
            self.show()

    def leave(self) -> None:
        """Takes it from the screen."""
        self.shown = False
