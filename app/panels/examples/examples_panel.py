"""The examples: thumbnails to choose from, the region of the one chosen, and how it is grown (Ritter et al. 2006)."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from imgui_bundle import ImVec2, imgui

from app import icons, theme
from app.actions.action import Action
from app.desk.desk import Desk
from app.desk.examples import cutting_work, example_pictures, example_state, example_use, example_work, thumbnails
from app.desk.examples.example_state import Entry
from app.language import said
from app.language.words import say
from app.panels.controls import widgets as w
from app.panels.controls.widgets import Col
from app.panels.examples.finding_panel import FindingPanel
from app.panels.examples.growth_settings import GrowthSettings
from app.panels.examples.maps_panel import MapsPanel
from app.panels.examples.own_examples import OwnExamples
from app.panels.examples.region_panel import RegionPanel
from app.panels.panel import Painting, Panel
from app.tools.painting_gestures import draw_map, mark_region, paint_region
from engine.studio.results import Picture, Scene
from engine.studio.textures.cut_records import CutFound
from engine.studio.textures.texture_results import RegionScene

TILE = 68.0  # side of a thumbnail, points, at least
NAME = 0.82  # of the font's size
_SIDE = 250.0  # width of what is told of the one chosen, points
_STILL = imgui.WindowFlags_.no_scrollbar | imgui.WindowFlags_.no_scroll_with_mouse
_PICTURED = "region", "maps"  # tabs that show the example's own picture
_TABS = (
    ("palette", "Palette", "All examples: click one to paint with it"),
    ("region", "Region", "Paint which part of the picture is grown"),
    ("maps", "Maps", "Tell which way it runs, and how wide its rim is"),
    ("settings", "Settings", "How it is grown: pieces, rim, seams"),
)


class ExamplesPanel(Panel):
    """Draws the strip."""

    def __init__(self) -> None:
        self._finding = FindingPanel()
        self._region, self._settings, self._own = RegionPanel(), GrowthSettings(), OwnExamples()
        self._maps = MapsPanel()
        self._defined: Sequence[Any] | None = None  # what the painting defined when it was last listed
        self.hears = {Scene: self._heard, Picture: _sampled, RegionScene: _painted, CutFound: cutting_work.hear}

    def wants(self, desk: Desk, now: float) -> None:
        """Thumbnails, and the sample stroke where it is seen."""
        state, side = desk.examples, thumbnails.side(desk.scale)
        example_use.prepare(desk, now)
        desk.thumbnails(state.entries, side)
        # Not while examples are made ready, or the engine would wait for it, and strokes for the engine.
        if desk.known.preparing is None and state.tab not in _PICTURED:
            example_pictures.ask_sample(state, desk.post, now)
        example_pictures.ask_thumbnails(state, desk.post, side)

    def stroke(self, desk: Desk, x: float, y: float) -> Painting | None:
        """Returns a stroke in the region."""
        if not desk.examples.over(x, y):
            return None
        if desk.examples.tab == "maps":
            return draw_map
        return paint_region if cutting_work.finding_of(desk) is None else mark_region

    def takes(self, desk: Desk, action: Action) -> bool:
        """Undo and redo over the region are its own, and so is the size of its brush."""
        at = desk.pointer
        if desk.examples.tab == "maps":
            return desk.examples.over(at.x, at.y) and self._maps.takes(desk, action)
        page = self._region if cutting_work.finding_of(desk) is None else self._finding
        return desk.examples.over(at.x, at.y) and page.takes(desk, action)

    def dropped(self, desk: Desk, path: Path, x: float, y: float) -> bool:
        """A picture is an example of the artist's own."""
        return example_work.dropped(desk, path)

    def _heard(self, desk: Desk, scene: Scene, now: float) -> None:
        """Lists the painting's own examples when it has others."""
        if self._defined != scene.definitions:
            self._defined = scene.definitions
            example_use.gather(desk)
            example_use.prepare(desk, now)

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        state = desk.examples
        state.spot = None
        if state.tab in _PICTURED and state.region is None and _has_files(state.entry):
            example_work.edit(desk)
        if not _has_files(state.entry) or (state.tab == "region" and state.region is None):
            state.tab = "palette"
        finding = cutting_work.finding_of(desk)
        if state.tab == "region" and finding is not None:
            self._finding.draw(desk, finding)
        elif state.tab == "region":
            self._region.draw(desk)
        elif state.tab == "maps" and state.region is not None:
            self._maps.draw(desk)
        elif state.tab == "settings":
            self._settings.draw(desk)
        else:
            self._palette(desk)

    def bar(self, desk: Desk) -> None:
        """Draws the three sides of the panel, in the strip's title line."""
        state, scale = desk.examples, desk.scale
        wide = 280 * scale
        imgui.same_line(imgui.get_window_width() - wide - imgui.get_frame_height() - 28 * scale)
        imgui.begin_disabled(not _has_files(state.entry))
        imgui.begin_child("tabs", ImVec2(wide, imgui.get_frame_height()))
        state.tab = w.segments("tab", state.tab, _TABS, wide) or state.tab
        imgui.end_child()
        imgui.end_disabled()

    # --- the palette -------------------------------------------------------------------------------------------------

    def _palette(self, desk: Desk) -> None:
        gap = imgui.get_style().item_spacing.x
        left = imgui.get_content_region_avail().x - _SIDE * desk.scale - gap
        imgui.begin_child("all examples", ImVec2(left, 0), 0, _STILL)
        self._filters(desk)
        imgui.begin_child("thumbnails", ImVec2(0, 0))
        self._thumbnails(desk)
        imgui.end_child()
        imgui.end_child()
        imgui.same_line()
        imgui.begin_child("chosen", ImVec2(0, 0), 0, _STILL)
        self._chosen(desk)
        imgui.end_child()
        self._own.draw(desk)

    def _filters(self, desk: Desk) -> None:
        """Draws which group is listed; a button to add one."""
        state, side, gap = desk.examples, imgui.get_frame_height(), 3 * desk.scale
        groups = [(example_state.ALL, f"All {len(state.entries)}"), *((group, group) for group in state.groups())]
        picked = w.choice("group", state.group, groups, "Which examples are listed", 150 * desk.scale)
        if picked is not None:
            state.group = picked
        imgui.same_line(0, gap)
        if w.icon_button("add", icons.ADD, "Add a picture of your own, or drop one on the window", size=side):
            desk.asked.show("example picture")

    def _thumbnails(self, desk: Desk) -> None:
        listed, gap = desk.examples.listed(), 6 * desk.scale
        room, tall = imgui.get_content_region_avail().x - imgui.get_style().scrollbar_size, _below(desk)
        wide = tile(len(desk.examples.entries), (room, imgui.get_content_region_avail().y), gap, tall, desk.scale)
        across = max(1, int((room + gap) / (wide + gap)))
        gap = (room - across * wide) / (across - 1) if across > 1 else gap
        imgui.push_style_var(imgui.StyleVar_.item_spacing, ImVec2(gap, 4 * desk.scale))
        for i, entry in enumerate(listed):
            if i % across:
                imgui.same_line()
            self._thumbnail(desk, entry, wide)
        imgui.pop_style_var()
        if not listed:
            said.text_disabled("No examples here yet: drop a picture on the window")

    def _thumbnail(self, desk: Desk, entry: Entry, wide: float) -> None:
        corner, tall = imgui.get_cursor_screen_pos(), wide + _below(desk)
        if imgui.invisible_button(entry.ident, ImVec2(wide, tall), imgui.ButtonFlags_.enable_nav):
            example_use.choose(desk, entry)
        w.named(entry.title)
        chosen, hovered = desk.examples.chosen == entry.ident, imgui.is_item_hovered()
        own = "\nDouble click to rename it, right click for more" if entry.own else ""
        w.tooltip(f"{entry.title}\n{entry.group}: click to paint with it{own}")
        if entry.own:
            self._own.menu(desk, entry)
        painter, end = imgui.get_window_draw_list(), ImVec2(corner.x + wide, corner.y + wide)
        rounding, white = 5 * desk.scale, theme.packed((1.0, 1.0, 1.0))
        painter.add_rect_filled(corner, end, theme.packed(theme.look.field), rounding)
        picture = desk.pictures.get(thumbnails.ident(entry))
        if picture is not None:
            painter.add_image_rounded(picture, corner, end, ImVec2(0, 0), ImVec2(1, 1), white, rounding)
        if chosen or hovered:
            colour = theme.packed(theme.look.accent if chosen else theme.look.edge)
            painter.add_rect(corner, end, colour, rounding, thickness=(2.5 if chosen else 1.5) * desk.scale)
        grey = theme.look.text if chosen else theme.look.soft
        _named(
            example_state.label(entry, desk.examples.entries), ImVec2(corner.x, end.y + 1.5 * desk.scale), wide, grey
        )

    # --- the one chosen ----------------------------------------------------------------------------------------------

    def _chosen(self, desk: Desk) -> None:
        state, entry = desk.examples, desk.examples.entry
        room, gap = imgui.get_content_region_avail(), imgui.get_style().item_spacing
        line, top = imgui.get_frame_height_with_spacing(), imgui.get_cursor_pos_y()
        imgui.align_text_to_frame_padding()
        said.text_unformatted(_short(entry, room.x - 2 * imgui.get_frame_height()) if entry else "Choose an example")
        if entry is not None and entry.own:
            self._own.buttons(desk, entry)
        imgui.set_cursor_pos_y(top + line)  # with buttons and without
        tall = room.y - 2 * line
        state.sampled = max(1, round(room.x)), max(1, round(tall))
        shown = desk.pictures.get(example_pictures.SAMPLE) if entry else None
        hint = "A stroke with this example" if entry else "Click on one to try it"
        corner = w.picture(shown, (room.x, tall), hint, name="sample")
        if shown is not None and state.seen != state.chosen:  # it is of another one yet
            end = ImVec2(corner.x + room.x, corner.y + tall)
            veil = theme.packed(theme.look.field, 0.75)
            imgui.get_window_draw_list().add_rect_filled(corner, end, veil, imgui.get_style().frame_rounding)
        if shown is None and entry is not None and desk.known.preparing is not None:
            _in_middle("Getting ready…", corner, (room.x, tall))
        wide = (room.x - gap.x) / 2
        imgui.push_style_color(Col.button, theme.vec(theme.look.accent_soft))
        painting = entry is not None and desk.hand.stroke_mode().grows and desk.hand.tool == "brush"
        text = f"{icons.BRUSH} Painting" if painting else f"{icons.BRUSH} Paint"
        if w.text_button(f"{text}###paint", "Paint with this example", enabled=entry is not None, width=wide):
            example_use.take_example(desk)
        imgui.pop_style_color()
        imgui.same_line()
        hint = "Then click on a painted texture: it becomes like this one"
        imgui.push_style_color(Col.button, theme.vec(theme.look.accent_soft if state.swapping else theme.look.raised))
        if w.text_button(f"{icons.SWAP} Swap", hint, enabled=entry is not None, width=wide):
            state.swapping = not state.swapping
        imgui.pop_style_color()


def _painted(desk: Desk, scene: RegionScene, now: float) -> None:
    example_work.take_scene(desk, scene)


def _sampled(desk: Desk, picture: Picture, _now: float) -> None:
    """The picture of a stroke is of the example that it was asked for with."""
    if picture.ident == example_pictures.SAMPLE:
        desk.examples.seen = desk.examples.sampling


def _has_files(entry: Entry | None) -> bool:
    """Tells whether it has a region and settings that may be changed: only the palette's own have."""
    return entry is not None and entry.here is None


def _below(desk: Desk) -> float:
    """Returns the height of a name under a thumbnail."""
    return imgui.get_font_size() * NAME + 4 * desk.scale


def tile(count: int, room: tuple[float, float], gap: float, name: float, scale: float) -> float:
    """Returns the side of thumbnails: as large as lets all be seen at once, between two bounds."""
    side = int(thumbnails.LARGE * scale)
    while side > TILE * scale:
        across = max(1, int((room[0] + gap) / (side + gap)))
        if -(-count // across) * (side + name + gap) <= room[1]:
            break
        side -= 1
    return float(max(side, round(TILE * scale)))


def _short(entry: Entry, wide: float) -> str:
    """Returns the name of one, as much of it as there is room for beside two buttons if it is the artist's own."""
    return _fitting(entry.title, wide) if entry.own else entry.title


def _fitting(name: str, wide: float) -> str:
    """Returns a name no wider than that; a long one ends with dots."""
    while len(name) > 1 and said.calc_text_size(name).x > wide:
        name = name.removesuffix("…")[:-1].rstrip() + "…"
    return name


def _in_middle(text: str, corner: ImVec2, size: tuple[float, float]) -> None:
    """Draws a word where a picture is to come."""
    half = said.calc_text_size(text) / 2
    at = ImVec2(corner.x + size[0] / 2 - half.x, corner.y + size[1] / 2 - half.y)
    said.add_text(imgui.get_window_draw_list(), at, theme.packed(theme.look.quiet), text)


def _named(name: str, at: ImVec2, wide: float, grey: tuple[float, float, float]) -> None:
    """Draws a name below its picture, in the middle."""
    size = imgui.get_font_size() * NAME
    scale = size / imgui.get_font_size()
    name = _fitting(say(name), (wide + 2) / scale)
    left = at.x + max(0.0, (wide - said.calc_text_size(name).x * scale) / 2)
    imgui.get_window_draw_list().add_text(imgui.get_font(), size, ImVec2(left, at.y), theme.packed(grey), name)
