"""What the panels share about textures: which there are, what they are called, sliders for their parameters."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import dataclass
from typing import Any

from immutables import Map

from app import icons
from app.desk.desk import Desk
from app.language import said
from app.panels.controls import widgets as w
from engine.checks.values import is_number
from engine.makers import definitions
from engine.painting.commands import DefineTexture
from engine.painting.layering.painting_member import A_FILE, HOLDS


@dataclass(frozen=True, slots=True)
class KindRow:
    """A parameter that several kinds of textures have, 0..1, as the table of kinds tells others."""

    name: str
    tooltip: str
    default: float = 1.0
    lo: float = 0.0
    hi: float = 1.0
    unit: str = ""
    whole: bool = False


_SLIDER_MOST = {"period": 512.0, "angle": 180.0}
_WORDS = {
    "period": "Size",
    "mean": "Brightness",
    "spread": "Contrast",
    "quantise": "Steps",
    "strength": "Detail",
}  # for artists
_STRENGTH = KindRow("strength", "How much detail follows below the picture's own pixels; 0 is smooth")
_WHOLE_CURVE = ("period", "density")  # sliders that are finer where they are small


def names(desk: Desk) -> list[tuple[str, str]]:
    """Returns names and hints: those built in, those that the painting defines, those that the bundled brushes
    bring."""
    return [row for _, rows in groups(desk) for row in rows]


def groups(desk: Desk) -> list[tuple[str, list[tuple[str, str]]]]:
    """Returns the same by where they come from, under a title each; a name that several have means the first's."""
    defined = desk.known.scene.definitions if desk.known.scene else ()
    files = {name for name, _, parameters in defined if parameters.get(HOLDS) == A_FILE}
    here = [name for name in (desk.known.scene.textures if desk.known.scene else ()) if name not in files]
    sources = (
        ("Of this painting", [(name, "A texture of this painting") for name in here]),
        ("Built in", [(row.name, row.tooltip) for row in desk.known.tables.kinds if not row.pictured]),
        ("Of the brushes", [(name, "The painting gets it when you paint with it") for name in _bringable(desk)]),
    )
    seen: set[str] = set()
    found = []
    for title, rows in sources:
        rows = [row for row in rows if row[0] not in seen]
        seen |= {name for name, _ in rows}
        if rows:
            found.append((title, rows))
    return found


def bring(desk: Desk, name: str) -> None:
    """Has the painting get a texture of the brushes that it lacks, as soon as it is painted with."""
    if all(other.name != name for other in desk.hand.needs):
        desk.hand.bring(*brought(desk, name))


def _bringable(desk: Desk) -> dict[str, DefineTexture]:
    """By name, what the brush came with and what presets and papers come with; the first of a name counts."""
    found: dict[str, DefineTexture] = {}
    bundled = [one for preset in desk.known.presets for one in preset.textures]
    bundled += [one for paper in desk.known.papers for one in paper.textures]
    for command in (*desk.hand.needs, *bundled):
        found.setdefault(command.name, command)
    return found


def label(desk: Desk, texture: str) -> str:
    """Returns what a texture is called: one of the program's own with a capital, also before the engine tells which
    those are."""
    kinds = desk.known.tables.kinds
    return texture.capitalize() if not kinds or any(row.name == texture for row in kinds) else texture


def meant(desk: Desk, name: str) -> Hashable:
    """Returns what a name means now: another value when it means another texture."""
    if desk.known.scene and name in desk.known.scene.textures:
        given = next((parameters for known, _, parameters in desk.known.scene.definitions if known == name), None)
        lab = desk.lab.scene
        return desk.known.scene.serial, given, lab.version if lab is not None and lab.using == name else 0
    return _bringable(desk).get(name, name)


def brought(desk: Desk, name: str) -> tuple[DefineTexture, ...]:
    """Returns the definition of a texture that the painting lacks and the brushes have."""
    command = _bringable(desk).get(name)
    here = desk.known.scene is not None and name in desk.known.scene.textures
    return () if command is None or here else (command,)


def rows(desk: Desk, texture: str) -> tuple[Any, ...]:
    """Returns the parameters of a texture, from the table of its kind."""
    kind = texture_kind(desk, texture)
    return next((tuple(row.parameters) for row in desk.known.tables.kinds if row.name == kind), ())


def texture_kind(desk: Desk, texture: str) -> str:
    """Returns the kind of a texture: of the painting, of those still to come into it, or built in."""
    defined = dict(desk.known.scene.texture_kinds) if desk.known.scene else {}
    if texture in defined:
        return defined[texture]
    command = _bringable(desk).get(texture)
    return texture if command is None else definitions.kind_of(command)


def sliders(desk: Desk, texture: str, parameters: Map[str, Any]) -> Map[str, Any]:
    """Returns a slider for each parameter and a button for another seed; the parameters as they are now."""
    found, usual, kind = rows(desk, texture), own(desk, texture), texture_kind(desk, texture)
    for row in found:
        still = row.name != "weight" or is_number(parameters.get("weight", 0.0))
        if row.name not in ("seed", "stages") and still:
            parameters = _slider(parameters, row, usual.get(row.name, row.default))
    if usual.get("detail") == "learnt":
        parameters = _slider(parameters, _STRENGTH, usual.get("strength", 1.0))
    if any(row.name == kind and row.endless for row in desk.known.tables.kinds):
        renewed = parameters.get("renew", usual.get("renew", True)) is not False
        changed, renew = _renewed(renewed)
        parameters = parameters.set("renew", renew) if changed else parameters
    seeded = any(row.name == "seed" for row in found)
    if seeded and w.text_button(f"{icons.DICE} Another grain", "The same texture from another seed", width=-1):
        parameters = parameters.set("seed", (int(parameters.get("seed", 0) or 0) * 31 + 17) % 99991)
    return parameters


def _renewed(renewed: bool) -> tuple[bool, bool]:
    """Shows whether octaves are renewed: whether that was changed, and how it is now."""
    changed, lasting = said.checkbox("For heights", not renewed)
    w.named("For heights")
    w.tooltip("What is seen from afar stays as it is when you come nearer: for land. Contrast fades deep down")
    return changed, not lasting


def own(desk: Desk, texture: str) -> Mapping[str, Any]:
    """Returns the parameters that a texture was defined with, with which a brush paints that says nothing; the
    period is the width of its picture where the definition says nothing either."""
    width, given = 0, None
    if desk.known.scene:
        width = dict(desk.known.scene.texture_widths).get(texture, 0)
        given = next((parameters for name, _, parameters in desk.known.scene.definitions if name == texture), None)
    command = _bringable(desk).get(texture)
    if given is None and command is not None:
        given, size = command.arguments, command.arguments.get("size")
        width = size[0] if isinstance(size, tuple) and size else 0
    return {**({"period": width} if width else {}), **(given or {})}


def _slider(parameters: Map[str, Any], row: Any, usual: Any) -> Map[str, Any]:
    value = parameters.get(row.name, usual)
    value = float(value if is_number(value) else row.default)  # files may say anything; the engine refuses it
    lo, hi = float(row.lo), min(float(row.hi), _SLIDER_MOST.get(row.name, float(row.hi)))
    form = (
        "%.0f°"
        if row.unit in ("degrees", "°")
        else "%.1f px"
        if row.name == "period"
        else "%.0f"
        if row.whole
        else "%.2f"
    )
    curved = row.name in _WHOLE_CURVE
    changed, value = w.slider(
        _WORDS.get(row.name, row.name.capitalize()), value, (lo, hi), row.tooltip, form=form, curved=curved
    )
    if not changed:
        return parameters
    value = min(max(round(value, 0 if row.whole else 3), float(row.lo)), float(row.hi))
    return parameters.set(row.name, int(value) if row.whole else value)
