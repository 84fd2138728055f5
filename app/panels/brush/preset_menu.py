"""The menu of a brush in the list: copied, shared; one of the artist's own is named, put into groups, deleted."""

from __future__ import annotations

from dataclasses import dataclass, replace

from imgui_bundle import imgui

from app.desk import presets
from app.desk.desk import Desk
from app.desk.holding.favourites import digit_of, star
from app.desk.presets import Preset
from app.desk.sharing.preset_work import ChangePreset, DeletePreset, duplicate
from app.language import said
from app.panels.controls import widgets as w


@dataclass(slots=True)
class _Typed:
    """What is typed about the brush whose menu is open."""

    name: str = ""
    group: str = ""
    tags: str = ""


_typed = _Typed()


def draw_menu(desk: Desk, preset: Preset) -> None:
    """Draws the menu of the brush just drawn while it is open; a right click opens it."""
    if not imgui.begin_popup_context_item(f"brush {preset.name}"):
        return
    if imgui.is_window_appearing():
        _typed.name, _typed.group, _typed.tags = preset.name, preset.group, ", ".join(preset.tags)
    rows = [
        (
            "No favourite" if digit_of(desk, preset) else "Favourite",
            "A digit takes it; it lies under the pen",
            star,
        ),
        ("Duplicate", "A copy among your own brushes, to change", duplicate),
        ("Share…", "Write it with all that it needs as one file", _share),
    ]
    for text, hint, do in rows:
        if said.selectable(text, False)[0]:
            do(desk, preset)
        w.named(text)
        w.tooltip(hint)
    if presets.is_own(preset):
        _own(desk, preset)
    imgui.end_popup()


def _share(desk: Desk, preset: Preset) -> None:
    desk.asked.brush = preset
    desk.asked.show("share brush")


def _own(desk: Desk, preset: Preset) -> None:
    """Draws what can be done to one of the artist's own."""
    imgui.separator()
    entered = False
    for name, hint in (
        ("name", "Its name"),
        ("group", "The group that it is listed in: one that is there, or a new one"),
        ("tags", "Words to find it by, with commas between"),
    ):
        imgui.set_next_item_width(imgui.get_font_size() * 12)
        flags = imgui.InputTextFlags_.enter_returns_true
        done, text = said.input_text_with_hint(f"##{name}", name.capitalize(), getattr(_typed, name), flags)
        setattr(_typed, name, text)
        entered = entered or done
        w.named(f"brush {name}")
        w.tooltip(hint)
    if w.text_button("Keep", "Under this name, in this group") or entered:
        desk.work(ChangePreset(preset, _told(desk, preset)))
        imgui.close_current_popup()
    imgui.same_line()
    if w.text_button("Delete", f"Delete “{preset.name}”"):
        desk.work(DeletePreset(preset))
        imgui.close_current_popup()


def _told(desk: Desk, preset: Preset) -> Preset:
    """Returns the brush as it is typed."""
    others = (one.name for one in desk.known.presets if one is not preset)
    words = (" ".join(tag.split())[: presets.NAME_CAP] for tag in _typed.tags.split(","))
    tags = tuple(dict.fromkeys(tag for tag in words if tag))[: presets.TAGS_CAP]
    group = " ".join(_typed.group.split())[: presets.NAME_CAP] or presets.OWN
    return replace(preset, name=presets.free_among(_typed.name, others), group=group, tags=tags)
