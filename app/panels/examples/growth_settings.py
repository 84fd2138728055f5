"""How an example is grown: the parameters of the synthesis, with a stroke that shows what they do."""

from __future__ import annotations

from typing import Any, NamedTuple

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.desk.desk import Desk
from app.desk.examples import example_work
from app.desk.examples.example_pictures import SAMPLE
from app.desk.examples.example_state import Entry
from app.language import said
from app.panels.controls import widgets as w
from app.panels.controls.widgets import Col

_SIDE = 0.46  # of the room for the settings
BROADEST = 1.6  # of the picture: width to height


class Slider(NamedTuple):
    """A row: a parameter that is a number, under an artist's word for it."""

    name: str
    label: str
    bounds: tuple[float, float]
    form: str
    hint: str
    whole: bool = True


class Choice(NamedTuple):
    """A row: a parameter that is one of some: (value, text, hint)."""

    name: str
    label: str
    options: tuple[tuple[Any, str, str], ...]


_SLIDERS = (
    Slider("kappa", "Coherence", (0.0, 12.0), "%.1f", "Higher: larger pieces of the example stay whole", False),
    Slider("block", "Patch size", (1, 64), "%.0f px", "Pieces of the example that are laid out first, coarsest of all"),
    Slider("e_max", "Rim strength", (0.0, 16.0), "%.1f", "How strictly the rim stays at the rim", False),
    Slider("smooth", "Even edge", (0.0, 32.0), "%.0f px", "Rounds the region’s edge in the example", False),
    Slider("feather", "Soft seams", (0, 3), "%.0f px", "Pixels over which pieces are blended"),
    Slider("passes", "Passes", (1, 4), "%.0f", "Corrections at each size: more is truer and slower"),
    Slider("levels", "Octaves", (0, 8), "%.0f", "Sizes of features that are matched one after the other; 0: by itself"),
)
_CHOICES = (
    Choice(
        "neighbourhood",
        "Looks at",
        tuple((n, f"{n} × {n}", f"{n} × {n} pixels around each are compared") for n in (3, 5, 7)),
    ),
    Choice(
        "channels",
        "Compares",
        (
            ("colour", "Colour", "Colours are compared"),
            ("luminance", "Light", "Only lightness is compared: faster, for grey and for one hue"),
        ),
    ),
    Choice(
        "boundary",
        "Rim",
        (
            ("auto", "Auto", "There is a rim unless the region fills the picture"),
            ("yes", "Always", "The region’s edge is a rim, also at the picture’s ends"),
            ("no", "Never", "No rim: strokes are cut out of the texture"),
        ),
    ),
)


class GrowthSettings:
    """Draws the strip's inside."""

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        entry = desk.examples.entry
        if entry is None:
            return
        room, gap = imgui.get_content_region_avail(), imgui.get_style().item_spacing.x
        wide = min((1 - _SIDE) * room.x, BROADEST * room.y)
        desk.examples.sampled = max(1, round(wide)), max(1, round(room.y))
        w.picture(desk.pictures.get(SAMPLE), (wide, room.y), "A stroke with these settings")
        imgui.same_line(0, gap)
        imgui.begin_child("growth", ImVec2(0, 0))
        imgui.push_style_var(imgui.StyleVar_.item_spacing, ImVec2(gap, 4 * desk.scale))
        imgui.begin_child("parameters", ImVec2(0, -imgui.get_frame_height_with_spacing()))
        self._rows(desk, entry)
        imgui.end_child()
        imgui.pop_style_var()
        self._uses(desk, entry)
        imgui.end_child()

    def _rows(self, desk: Desk, entry: Entry) -> None:
        state, now = desk.examples, desk.examples.draft(entry)
        for row in _SLIDERS:
            value = float(getattr(now, row.name))
            form = "auto" if row.name == "levels" and not value else row.form
            changed, value = w.slider(row.label, value, row.bounds, row.hint, form=form)
            if changed:
                state.set(entry, row.name, round(value) if row.whole else round(value, 1))
        label = 74 * desk.scale
        for choice in _CHOICES:
            imgui.align_text_to_frame_padding()
            said.text_disabled(choice.label)
            imgui.same_line(label)
            current = str(getattr(now, choice.name))
            options = [(str(value), text, hint) for value, text, hint in choice.options]
            picked = w.segments(choice.name, current, options)
            if picked is not None:
                state.set(entry, choice.name, next(v for v, _, _ in choice.options if str(v) == picked))

    def _uses(self, desk: Desk, entry: Entry) -> None:
        """Use, reset, and a copy of one's own."""
        state, gap = desk.examples, 2 * desk.scale
        room = imgui.get_content_region_avail().x
        tried = state.tried(entry)
        imgui.push_style_color(Col.button, theme.vec(theme.look.accent_soft))
        hint = "Paint with these settings" + (" from now on; the example keeps them" if entry.own else "")
        if w.text_button(f"{icons.BRUSH} Use", hint, enabled=tried, width=0.36 * (room - 2 * gap)):
            example_work.use_settings(desk)
        imgui.pop_style_color()
        imgui.same_line(0, gap)
        same = state.draft(entry) == entry.parameters
        if w.text_button("Reset", "The settings that it came with", enabled=not same, width=0.28 * (room - 2 * gap)):
            state.reset(entry)
        imgui.same_line(0, gap)
        hint = "Save it with these settings as an example of your own"
        if w.text_button("Save a copy", hint, width=0.36 * (room - 2 * gap)):
            example_work.keep_settings(desk)
