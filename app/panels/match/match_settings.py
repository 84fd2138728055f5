"""The settings of a match: how two examples are mixed, the pyramid, axes of colour, and every subband's histogram."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui

from app.desk.desk import Desk
from app.desk.match_state import ITERATIONS, LEVELS, ORIENTATIONS
from app.language import said
from app.panels.controls import widgets as w
from app.panels.controls.curve_editor import CurveEditor
from app.panels.match import subbands

_HOWS = (
    ("average", "Average", "Everything between the two, as the weight says"),
    ("palette", "Palette", "The colours of the first with the pattern of the second"),
    ("bands", "Bands", "The coarse features of the first with the fine ones of the second"),
)
_STRUCTURES = (
    ("none", "None", "Grain alone, of the right colours; its subbands can be changed"),
    ("statistics", "Statistics", "Nothing is copied: wood, bark, sand, fur, marble"),
    ("coarse", "Coarse", "Large shapes lie as in the example, the rest is new: walls, bricks"),
    ("objects", "Objects", "Stones, leaves and bricks stay what they are; hardly anything is copied"),
    ("full", "Full", "As near to the example as can be; small pieces of it are copied"),
    ("pieces", "Pieces", "Large pieces of the example that agree at their edges: bricks, cloth, leaves"),
)
_AXES = (
    ("Light", "The first axis of the example's colours, along which they differ most"),
    ("Tint", "The second axis: mostly warm against cold"),
    ("Rest", "The third axis, of the finest differences"),
    ("Last", "The fourth axis, which examples with transparency have"),
)


class MatchSettings:
    """Draws the column on the right of the panel."""

    def __init__(self) -> None:
        self._curves = CurveEditor()

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        if desk.match.mixing:
            self._mixture(desk)
        self._structure(desk)
        if desk.match.kept == "none":
            self._subbands(desk)
            self._colours(desk)
            self._pyramid(desk)

    def _structure(self, desk: Desk) -> None:
        match, scene = desk.match, desk.match.scene
        if match.mixing and match.how != "average":
            return
        said.text_disabled("Structure")
        picked = w.segments("structure", match.kept, _STRUCTURES)
        if picked:
            match.keep(picked)
        if match.kept != "none" and scene is not None and scene.copied >= 0.0:
            said.text_disabled(f"{scene.copied:.0%} copied from the example")
            w.tooltip("So many of its pieces of 7 x 7 pixels are the example's own; even faces count, too")

    def _mixture(self, desk: Desk) -> None:
        match = desk.match
        said.text_disabled("Mixture of both")
        how = w.segments("how", match.how, _HOWS)
        match.how = how or match.how
        if match.how == "average":
            hint = "From the first example to the second"
            changed, value = w.slider("Weight", match.weight * 100, (0.0, 100.0), hint, form="%.0f%%")
            match.weight = round(value / 100, 3) if changed else match.weight
            hint = "The harder the pen is pressed, the more of the second example it paints"
            _, match.pressed = w.tick("Pen pressure sets the weight", match.pressed, hint)
        elif match.how == "bands":
            hint = "Features finer than this many pixels are the second example's"
            match.split = _whole("Finer than", match.split, (0, match.levels), hint, f"{2 << match.split} px")

    def _subbands(self, desk: Desk) -> None:
        match, scene = desk.match, desk.match.scene
        levels = scene.levels if scene is not None and scene.done > 0 else match.levels
        orientations = scene.orientations if scene is not None and scene.done > 0 else match.orientations
        said.text_disabled("Subbands")
        if match.bands:
            imgui.same_line()
            imgui.set_cursor_pos_x(imgui.get_cursor_pos_x() + imgui.get_content_region_avail().x - 44 * desk.scale)
            if said.small_button("Reset"):
                match.bands = {}
            w.tooltip("All subbands as the example has them")
        subbands.draw(match, levels, orientations)
        gain, curve = match.bands.get(match.chosen, (1.0, None))
        hint = "A curve for the sizes of the marked subband's values: which of its features stand out, which vanish"
        changed, curve = self._curves.row(
            f"Shape of {_named(match.chosen, levels)}", curve, desk.known.tables.curves, hint
        )
        if changed:
            match.bands[match.chosen] = gain, curve

    def _colours(self, desk: Desk) -> None:
        match, scene = desk.match, desk.match.scene
        colours = scene.colours if scene is not None else ()
        if not colours:
            return
        said.text_disabled("Axes of colour")
        side, gap = imgui.get_frame_height(), 2 * desk.scale
        wide = (imgui.get_content_region_avail().x - gap * (len(colours) - 1)) / len(colours)
        for k, colour in enumerate(colours[: len(_AXES)]):
            if k:
                imgui.same_line(0, gap)
            name, hint = _AXES[k]
            imgui.begin_child(f"axis {k}", ImVec2(wide, side))
            w.swatch(f"axis {k}", colour, hint, (side * 0.5, side))
            imgui.same_line(0, gap)
            changed, value = w.slider(f"{name}##{k}", match.axes[k] * 100, (0.0, 200.0), hint, form="%.0f%%")
            match.axes[k] = round(value / 100, 2) if changed else match.axes[k]
            imgui.end_child()

    def _pyramid(self, desk: Desk) -> None:
        match = desk.match
        said.text_disabled("Pyramid")
        gap = 2 * desk.scale
        wide = (imgui.get_content_region_avail().x - 2 * gap) / 3
        found = []
        rows = (
            ("Levels", match.levels, (1, 6), f"How many octaves are matched: more for larger features ({LEVELS})"),
            ("Directions", match.orientations, (1, 8), f"Orientations that are told apart ({ORIENTATIONS})"),
            ("Rounds", match.iterations, (1, 12), f"How often noise is brought nearer to the example ({ITERATIONS})"),
        )
        for i, (label, value, ends, hint) in enumerate(rows):
            if i:
                imgui.same_line(0, gap)
            imgui.begin_child(label, ImVec2(wide, imgui.get_frame_height()))
            found.append(_whole(label, value, ends, hint, "%.0f"))
            imgui.end_child()
        match.reshape(found[0], found[1])
        match.iterations = found[2]


def _whole(label: str, value: int, ends: tuple[int, int], hint: str, form: str) -> int:
    changed, found = w.slider(label, float(value), (float(ends[0]), float(ends[1])), hint, form=form)
    return round(found) if changed else value


def _named(spot: tuple[int, int | None], levels: int) -> str:
    level, orientation = spot
    if orientation is None:
        return "the finest grain" if level < 0 else "the base"
    return f"{2 << level} px, direction {orientation + 1}"
