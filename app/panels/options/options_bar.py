"""What the tool in hand can be set to, in a bar above the canvas: it takes the place of nothing."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from app.desk.desk import Desk
from app.desk.framing.frame_state import FRAME_TOOL
from app.panels.options import fill_options, mask_options
from app.panels.options.frame_options import FRAME_OPTIONS_WIDTH, draw_frame_options
from app.panels.options.pick_options import PICK_OPTIONS_WIDTH, draw_pick
from app.tools.tools import TOOLS


class Options(NamedTuple):
    """What a bar shows; `width`: of the bar, ems; `lines`: how many it is high."""

    width: float
    draw: Callable[[Desk], None]
    lines: int = 1


_OF_TOOLS = {
    "fill": Options(48.0, fill_options.draw),
    "enclose": Options(49.0, fill_options.draw),
    "gradient": Options(49.0, fill_options.draw),
    "wand": Options(35.5, fill_options.draw),
    "pick": Options(PICK_OPTIONS_WIDTH, draw_pick),
    FRAME_TOOL: Options(FRAME_OPTIONS_WIDTH, draw_frame_options),
}
_MASK = Options(49.0, mask_options.draw_mask)


def options_of(desk: Desk) -> Options | None:
    """Returns what is to be set now; None for nothing."""
    if not desk.panels:
        return None
    return _MASK if desk.selecting.masking and TOOLS[desk.hand.tool].outline else _OF_TOOLS.get(desk.hand.tool)
