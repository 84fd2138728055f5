"""The lab's settings: what to begin with, phases, which part becomes the texture, how it fills the plane."""

from __future__ import annotations

from typing import Any

from imgui_bundle import imgui
from immutables import Map

from app import icons
from app.desk.desk import Desk
from app.desk.lab_state import PAINTED, SIZES
from app.desk.outside import pictured
from app.language import said
from app.panels.controls import widgets as w

_SIGNS = {"ring": icons.RING, "wedge": icons.WEDGE, "points": icons.GRID, "noise": icons.CLOUD}
_WORDS = {"b": "Softness", "noise": "Clouds"}  # for those whose own names say little
_PICTURES = (
    ("texture", "In view", "The spectrum of what the canvas shows: its texture, without its picture"),
    ("image", "File…", "The spectrum of a picture file: a photograph of sand, bark, cloth"),
)
_PHASES = (
    ("random", "Random", "Every frequency begins anywhere: an even texture"),
    ("zero", "Zero", "All begin together in the middle: a star, a flower, a lattice"),
    ("painted", "Painted", "Paint the phases too: pushes features to one side or the other"),
)
_OWN = ("own", "Own", "Those of the picture: its features stay, and Endless scatters them")
_SHEETS = (
    ("amplitude", "Paint strength", "The brush paints how strong each frequency is"),
    ("phase", "Paint phase", "The brush turns phases: warm one way, cold the other; the other side turns back"),
)
_PARTS = (
    ("real", "Real part", "The texture itself"),
    ("imaginary", "Imaginary part", "Another texture of the same spectrum; flat unless phases are random"),
    ("magnitude", "Magnitude", "Ripples folded upwards: veins and cells"),
    ("log", "Log magnitude", "Dark veins in an even ground: cracks, marble"),
    ("phase", "Phase", "Ramps and whirls with sharp edges"),
)
_FIELDS = (
    ("tile", "Tile", "The sample, repeated without seams"),
    ("sparse", "Endless", "Scattered copies of the sample that never repeat (sparse convolution)"),
)
# name, label, hint, ends, default, form, curved; of all fields, then of endless ones alone
_NUMBERS: tuple[tuple[str, str, str, tuple[float, float], float, str], ...] = (
    ("period", "Width", "Of the sample in the stroke, in pixels: smaller is finer", (8, 1024), 256, "%.0f px"),
    ("roughness", "Roughness", "Detail that zooming in adds: 0 is smooth", (0, 1), 0.5, "%.2f"),
)
_ENDLESS = (
    ("density", "Density", "Copies on the area of one: few stay apart, many merge", (0.5, 100), 10, "%.1f"),
    ("spread", "Contrast", "How strongly it varies", (0, 4), 1, "%.2f"),
    ("mean", "Brightness", "What it varies around", (-1, 1), 0, "%.2f"),
    ("quantise", "Steps", "How many strengths copies have, lighter and darker ones; 0 is any", (0, 16), 0, "%.0f"),
    ("turn", "Turn", "How far copies are turned at random: 1 is any way round", (0, 1), 0, "%.2f"),
)
_WINDOW = ("Window", "Width of the round window under which the sample is scattered, in pixels: smaller is finer")
_CURVED, _WHOLE = ("period", "density"), ("period", "quantise")


class LabSettings:
    """Draws the column on the right of the lab.  `on_window`: whether the pointer is on the window's slider."""

    def __init__(self) -> None:
        self.on_window = False

    def draw(self, desk: Desk) -> None:
        """Draws it into the present window."""
        self._shapes(desk)
        self._shape_numbers(desk)
        self._phase(desk)
        self._part(desk)
        self._field(desk)

    def _shapes(self, desk: Desk) -> None:
        said.text_disabled("Begin with")
        lab = desk.lab
        held = [shape["shape"] for shape in lab.made.shapes]
        rows = lab.scene.shapes if lab.scene is not None else ()
        names: list[tuple[str, str, str]] = [
            (r.name, f"{_SIGNS.get(r.name, '')} {_WORDS.get(r.name, r.label)}", r.tooltip) for r in rows
        ]
        names += _PICTURES
        gap = 2 * desk.scale
        wide = (imgui.get_content_region_avail().x - gap) / 2
        for i, (name, label, hint) in enumerate(names):
            if i % 2:
                imgui.same_line(0, gap)
            hint += "\nShift adds it to the others, or takes it away"
            if w.lit_button(f"{label}##{name}", hint, name in held, wide):
                self._toggle(desk, name)

    def _toggle(self, desk: Desk, name: str) -> None:
        """Alone, or with Shift beside the others; away if it is all there is, or with Shift."""
        lab, shift = desk.lab, imgui.get_io().key_shift
        rest = tuple(shape for shape in lab.made.shapes if shape["shape"] != name)
        if len(rest) < len(lab.made.shapes) and (shift or not rest):
            lab.begin_with(rest)
        elif name == "image":
            desk.asked.show("lab picture")
        else:
            shape: dict[str, Any] = {"shape": name}
            if name == "texture":
                shape["texture"] = pictured.kept_view(desk)
            lab.begin_with((*rest, Map(shape)) if shift else (Map(shape),))

    def _shape_numbers(self, desk: Desk) -> None:
        lab = desk.lab
        rows = {row.name: row for row in lab.scene.shapes} if lab.scene is not None else {}
        several = len(lab.made.shapes) > 1
        for i, shape in enumerate(lab.made.shapes):
            row = rows.get(shape["shape"])
            if row is None:
                continue
            if several:
                said.text_disabled(_WORDS.get(row.name, row.label))
            imgui.push_id(i)
            for number in row.parameters:
                if number.name == "strength" and not several:
                    continue
                form = "%.0f°" if number.unit == "degrees" else "%.2f"
                value = float(shape.get(number.name, number.default))
                label = _WORDS.get(number.name, number.name.capitalize())
                changed, value = w.slider(label, value, (number.lo, number.hi), number.tooltip, form=form)
                if changed:
                    lab.shape(i, number.name, round(value, 4))
            imgui.pop_id()

    def _phase(self, desk: Desk) -> None:
        lab = desk.lab
        said.text_disabled("Phases")
        side, gap = imgui.get_frame_height(), 2 * desk.scale
        rows = (*_PHASES, _OWN) if lab.pictured else _PHASES
        picked = w.segments("phase", lab.made.phase, rows, imgui.get_content_region_avail().x - side - gap)
        imgui.same_line(0, gap)
        thrown = lab.made.phase == "random" or lab.endless
        hint = "The same spectrum with other random phases" if lab.made.phase == "random" else "Copies in other places"
        if w.icon_button("throw", icons.DICE, hint, enabled=thrown, size=side):
            lab.change(seed=(lab.made.seed * 31 + 17) % 99991)
        if picked:
            lab.phase(picked)
        if lab.made.phase in PAINTED:
            sheet = w.segments("sheet", lab.made.sheet, _SHEETS)
            if sheet:
                lab.change(sheet=sheet)

    def _part(self, desk: Desk) -> None:
        lab = desk.lab
        said.text_disabled("The texture is")
        options = [(name, label) for name, label, _ in _PARTS]
        hints = [hint for _, _, hint in _PARTS]
        hint = "Which part of the complex sample becomes the texture"
        gap, side = imgui.get_style().item_spacing.x, imgui.get_frame_height()
        wide = imgui.get_content_region_avail().x - said.calc_text_size("Forward").x - side - 2 * gap
        part = w.choice("part", lab.made.part, options, hint, wide, hints)
        if part:
            lab.change(part=part)
        imgui.same_line()
        hint = "The other way round: what you paint is a pattern, and the texture is its transform"
        changed, on = w.tick("Forward", lab.made.forward, hint)
        if changed:
            lab.turn(on)

    def _field(self, desk: Desk) -> None:
        lab = desk.lab
        said.text_disabled("It fills the plane as")
        held = lab.made.field
        picked = w.segments("field", str(held.get("field", "tile")), _FIELDS)
        if picked:
            lab.field("field", None if picked == "tile" else picked)
        for name, label, hint, ends, default, form in (*_NUMBERS, *(_ENDLESS if "field" in held else ())):
            usual = lab.made.size[0] if name == "period" else default
            label, hint = _WINDOW if name == "period" and lab.endless else (label, hint)
            value = float(held.get(name, usual))
            changed, value = w.slider(label, value, ends, hint, form=form, curved=name in _CURVED)
            if name == "period":
                self.on_window = imgui.is_item_hovered() or imgui.is_item_active()
            if changed:
                lab.field(name, round(value) if name in _WHOLE else round(value, 3))
        sizes = [(str(n), f"{n} × {n}", f"A sample of {n} pixels along a side") for n in SIZES]
        size = w.segments("size", str(lab.made.size[0]), sizes)
        if size:
            lab.change(size=(int(size), int(size)))
