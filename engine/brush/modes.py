"""The stroke modes: what a stroke may do where it goes, as one table.

A row tells everything about a mode that others ask; what it does to pixels stands in the module that the row names.
So a mode is added by a module of its own and a row.  Light on purpose: brushes are checked by the table, and panels
show it before anything is compiled.
"""

from __future__ import annotations

from dataclasses import dataclass

HEAPS_UP, CHANGES_HEAPS = "heaps", "changes"


@dataclass(frozen=True, slots=True)
class Mode:
    """A row of the table.

    `name`: in recordings; `label` and `tooltip`: of its button, and in `inkfall play --help`.
    `edit`: "module:class" of its edits, a `covered.Covered`; "" for a mode that makes none, since it grows an example.
    `lays_ink`: it lays the brush's own colour and ink.  `takes_away`: it erases, what is
    painted with examples too, wholly where it goes; strokes of other modes make paint of that where they meet it.
    `uses_op`: it does what the brush's `op` says.  `in_lab`: it makes sense on a spectrum.
    `eraser`: the mode that the eraser, or the pen's other end, has with such a brush.
    `section`: what the brush panel shows for it alone, by name.  `unfelt`: members of the brush that do not count.
    `ground`: what small pictures of its strokes are painted on: "" for nothing, "bars" or "colours".
    `heaps`: what it does to heights that lie beside the paint: HEAPS_UP, or CHANGES_HEAPS as it does the paint, or "".
    """

    name: str
    label: str
    tooltip: str
    edit: str = ""
    lays_ink: bool = False
    takes_away: bool = False
    uses_op: bool = False
    in_lab: bool = False
    eraser: str = "erase"
    section: str = ""
    unfelt: frozenset[str] = frozenset()
    ground: str = ""
    heaps: str = ""

    @property
    def places(self) -> bool:
        """Tells whether its strokes place things, as a written texture tells."""
        return self.name == "generate"

    @property
    def grows(self) -> bool:
        """Tells whether its strokes are regions in which an example grows."""
        return not self.edit


MODES: dict[str, Mode] = {
    row.name: row
    for row in (
        Mode(
            "paint",
            "Paint",
            "Lays paint over what is there",
            "engine.brush.paint_edit:Painting",
            lays_ink=True,
            in_lab=True,
            heaps=HEAPS_UP,
        ),
        Mode(
            "erase",
            "Erase",
            "Takes paint away, at all depths",
            "engine.brush.erase_edit:Erasing",
            takes_away=True,
            in_lab=True,
            section="eraser",
            ground="bars",
            heaps=CHANGES_HEAPS,
        ),
        Mode(
            "smooth",
            "Smooth",
            "Softens the paint and takes away the detail that zooming would show",
            "engine.brush.smooth_edit:Smoothing",
            in_lab=True,
            eraser="smooth",
            ground="bars",
            heaps=CHANGES_HEAPS,
        ),
        Mode(
            "raster",
            "Change",
            "Changes the paint that is there: darker, another hue, blurred, copied…",
            "engine.brush.raster_edit:Raster",
            uses_op=True,
            in_lab=True,
            section="operations",
            ground="colours",
        ),
        Mode(
            "generate",
            "Generate",
            "Places trees, houses, stones… along the stroke, as its texture tells",
            "engine.brush.generated_edit:Generating",
            lays_ink=True,
            unfelt=frozenset(("opacity", "flow", "density", "grain", "edge")),
        ),
        Mode(
            "example",
            "Grow",
            "Grows a texture like an example where you paint, rim and all",
            section="example",
            unfelt=frozenset(("opacity", "flow", "density", "grain", "edge")),
        ),
    )
}
