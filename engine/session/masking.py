"""Which selection a layer is to have for its mask."""

from __future__ import annotations

from engine.canvas import layers
from engine.canvas.node_checks import LayerError
from engine.canvas.placing.placement import Placement
from engine.canvas.selecting.selection import Selection
from engine.painting import commands as c
from engine.painting.value import Painting


def mask_for(painting: Painting, command: c.SetLayer) -> Selection | None:
    """Returns the value of the mask that a command sets; None where it takes it away.  LayerError if there is none."""
    name, wanted = command.name, command.mask
    if isinstance(layers.find(painting.root, name), Placement):
        raise LayerError(f"layer {name!r}: found a placement, expected a layer or group to mask, as what it shows")
    if wanted is False:
        return None
    if wanted is True:
        if painting.selection is None:
            raise LayerError(f"layer {name!r}: mask: found nothing selected, expected a selection")
        return painting.selection
    if wanted is None or wanted not in painting.selections:
        raise LayerError(f"layer {name!r}: mask: found {wanted!r}, expected the name of a selection that is kept")
    return painting.selections[wanted]
