"""The program with a window in which something fails wherever the artist turns: `python -m faulty_window`."""

import sys

from imgui_bundle import imgui

from app import news
from app.__main__ import main
from app.actions import actions
from app.panels.layers.layers_panel import LayersPanel
from app.panels.strip import StripPanel
from app.tools.tools import TOOLS
from engine.studio import results


def broken_key(_desk):
    raise KeyError("missing key")


def broken_drop(*_):
    raise KeyError("missing panel")


def broken_result(*_):
    raise KeyError("missing file")


def broken_panel(*_):
    imgui.push_style_var(imgui.StyleVar_.alpha, 0.5)
    imgui.begin_child("half built")
    imgui.push_id("a name")
    imgui.begin_disabled()
    raise KeyError("missing layer")


def broken_gesture(_desk, _first):
    yield
    raise KeyError("missing point")


if __name__ == "__main__":
    actions.ACTIONS["turn_left"] = actions.ACTIONS["turn_left"]._replace(do=broken_key)
    TOOLS["turn"] = TOOLS["turn"]._replace(gesture=broken_gesture)
    LayersPanel.draw = broken_panel
    StripPanel.dropped = broken_drop
    news.HEARS[results.Saved] = broken_result
    sys.exit(main())
