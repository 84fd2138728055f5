"""imgui's texts and labels in the artist's language.

They are called as imgui's own; what is the artist's own, names of layers and files, is drawn by those.
"""

from __future__ import annotations

from imgui_bundle import ImVec2, ImVec4, imgui

from app.language.words import labelled, say


def text_unformatted(text: str) -> None:
    """Draws a text."""
    imgui.text_unformatted(say(text))


def own_text(text: str) -> None:
    """Draws a text that is the artist's own, as it is."""
    imgui.text_unformatted(text)


def text_disabled(text: str) -> None:
    """Draws a quiet text."""
    imgui.text_disabled(say(text))


def text_colored(colour: ImVec4, text: str) -> None:
    """Draws a text in a colour."""
    imgui.text_colored(colour, say(text))


def text_wrapped(text: str) -> None:
    """Draws a text in as many lines as it takes."""
    imgui.text_wrapped(say(text))


def button(text: str, size: ImVec2 | None = None) -> bool:
    """Draws a button; tells whether it was pressed."""
    return imgui.button(labelled(text), size)


def small_button(text: str) -> bool:
    """Draws a button as high as a line; tells whether it was pressed."""
    return imgui.small_button(labelled(text))


def menu_item(text: str, keys: str, on: bool, enabled: bool = True) -> tuple[bool, bool]:
    """Draws a row of a menu.  (pressed, on)"""
    return imgui.menu_item(labelled(text), keys, on, enabled)


def begin_menu(text: str, enabled: bool = True) -> bool:
    """Begins a menu; tells whether it is open."""
    return imgui.begin_menu(labelled(text), enabled)


def selectable(text: str, on: bool, flags: int = 0, size: ImVec2 | None = None) -> tuple[bool, bool]:
    """Draws a row of a list.  (pressed, on)"""
    return imgui.selectable(labelled(text), on, flags, size)


def checkbox(text: str, on: bool) -> tuple[bool, bool]:
    """Draws a box to tick.  (changed, on)"""
    return imgui.checkbox(labelled(text), on)


def radio_button(text: str, on: bool) -> bool:
    """Draws one of several of which one is on; tells whether it was pressed."""
    return imgui.radio_button(labelled(text), on)


def begin_combo(name: str, shown: str, flags: int = 0) -> bool:
    """Begins a list that drops down; tells whether it is open."""
    return imgui.begin_combo(name, say(shown), flags)


def begin_popup_modal(title: str, flags: int) -> bool:
    """Begins a dialog; tells whether it is open."""
    return imgui.begin_popup_modal(labelled(title), None, flags)[0]


def tree_node(text: str, flags: int) -> bool:
    """Draws what folds; tells whether it is open."""
    return imgui.tree_node_ex(labelled(text), flags)


def input_text_with_hint(name: str, hint: str, text: str, flags: int = 0) -> tuple[bool, str]:
    """Draws a field, with a hint while it is empty.  (changed, text)"""
    return imgui.input_text_with_hint(name, say(hint), text, flags)


def calc_text_size(text: str, hide: bool = False, wrap: float = -1.0) -> ImVec2:
    """Returns how much room a text takes."""
    return imgui.calc_text_size(say(text), hide, wrap)


def add_text(painter: imgui.ImDrawList, at: ImVec2, colour: int, text: str, size: float | None = None) -> None:
    """Draws a text at a place, as large as all texts unless told, pixels."""
    painter.add_text(imgui.get_font(), size or imgui.get_font_size(), at, colour, say(text))
