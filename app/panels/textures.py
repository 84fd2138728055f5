"""What the panels share about textures: which there are, what they are called, sliders for their parameters."""

from __future__ import annotations

from typing import Any

from immutables import Map

from app import icons
from app.desk import Desk
from app.panels import widgets as w

_SLIDER_MOST = {"period": 512.0, "angle": 180.0}
_WHOLE_CURVE = ("period", "density")  # sliders that are finer where they are small


def names(desk: Desk) -> list[tuple[str, str]]:
    """Names and hints: those built in, then those that the painting defines."""
    own = [(row.name, row.tooltip) for row in desk.kinds if not row.pictured]
    return own + [(name, "A texture of this painting") for name in (desk.scene.textures if desk.scene else ())]


def label(desk: Desk, texture: str) -> str:
    return texture.capitalize() if any(row.name == texture for row in desk.kinds) else texture


def chooser(desk: Desk, texture: str, hint: str, width: float = -1.0) -> str | None:
    """A drop-down of all textures but plain white; the name chosen now, or None."""
    found = [(name, tip) for name, tip in names(desk) if name != "white"]
    options = [(name, label(desk, name)) for name, _ in found]
    if texture not in dict(options):
        options.append((texture, f"{texture} (not here)"))
    return w.choice("texture", texture, options, hint, width, [tip for _, tip in found])


def rows(desk: Desk, texture: str) -> tuple[Any, ...]:
    """The parameters of a texture, from the table of its kind."""
    defined = dict(desk.scene.texture_kinds) if desk.scene else {}
    kind = defined.get(texture, texture)
    return next((tuple(row.parameters) for row in desk.kinds if row.name == kind), ())


def sliders(desk: Desk, texture: str, parameters: Map[str, Any]) -> Map[str, Any]:
    """A slider for each parameter and a button for another seed; the parameters as they are now."""
    found = rows(desk, texture)
    for row in found:
        if row.name != "seed":
            parameters = _slider(parameters, row)
    seeded = any(row.name == "seed" for row in found)
    if seeded and w.text_button(f"{icons.DICE} Another grain", "The same texture from another seed", width=-1):
        parameters = parameters.set("seed", (int(parameters.get("seed", 0) or 0) * 31 + 17) % 99991)
    return parameters


def _slider(parameters: Map[str, Any], row: Any) -> Map[str, Any]:
    value = float(parameters.get(row.name, row.default))
    lo, hi = float(row.lo), min(float(row.hi), _SLIDER_MOST.get(row.name, float(row.hi)))
    form = "%.0f°" if row.unit in ("degrees", "°") else "%.1f px" if row.name == "period" else "%.2f"
    curved = row.name in _WHOLE_CURVE
    changed, value = w.slider(row.name.capitalize(), value, (lo, hi), row.tooltip, form=form, curved=curved)
    if not changed:
        return parameters
    value = min(max(round(value, 0 if row.whole else 3), float(row.lo)), float(row.hi))
    return parameters.set(row.name, int(value) if row.whole else value)
