"""The switch of a colour that goes along with the one painted with, or keeps its own."""

from __future__ import annotations

from app import icons
from app.panels.controls import widgets as w

_FOLLOWS = "Goes along with the colour you paint with; click to keep this one"
_KEPT = "Keeps its colour whatever you paint with; click to let it go along"


def kept_switch(kept: bool) -> bool:
    """Draws it; returns whether the colour is kept from now on."""
    icon, hint = (icons.UNLINK, _KEPT) if kept else (icons.LINK, _FOLLOWS)
    return kept != w.icon_button("kept colour", icon, hint, on=not kept)
