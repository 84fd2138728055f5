"""The quick mask as the window is told it: while a stroke is painted on it, and when that is selected."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.brush.copies import symmetric
from engine.brush.settings import Brush
from engine.numeric.address import Rect
from engine.painting import commands as c
from engine.painting.points import rounded
from engine.painting.select_commands import Line
from engine.studio.easel import Easel
from engine.studio.selecting.mask_tint import TintFinder
from engine.studio.selecting.tint_records import AskTint, MaskBegin, MaskEnd, MaskPoints

AREA = Rect(-40, -100, 260, 190)
OVAL = {"do": "select", "ellipse": [0, 20, 10, 90, 80], "feather": 5}


class Seen:
    """What the window has of the mask."""

    def __init__(self, *told):
        self.easel = Easel(self._hear)
        self.finder, self.alpha, self.parts = TintFinder(self.easel), None, []
        for command in told:
            self.easel.carry_out(c.parse(command))

    def _hear(self, tint):
        if not hasattr(tint, "alpha"):
            return
        self.parts.append(tint.part)
        if tint.alpha.shape == (AREA.height, AREA.width):
            self.alpha = tint.alpha.copy()
        else:
            self.alpha[tint.part.slices(Rect(0, 0, AREA.width, AREA.height))] = tint.alpha

    def ask(self, request):
        self.finder.handlers[type(request)](request)
        while self.finder.pending:
            self.finder.step()


@given(
    points=st.lists(st.tuples(st.integers(0, 150), st.integers(-60, 90)), min_size=1, max_size=5),
    radius=st.integers(2, 50),
    hardness=st.sampled_from([0.1, 1.0]),
    takes=st.booleans(),
    copies=st.sampled_from([(), symmetric((40.0, 30.0), 3, (1.0, 2.0))]),
    inverse=st.booleans(),
)
@settings(max_examples=8, deadline=None)
def test_what_is_seen_of_a_stroke_is_what_it_selects(points, radius, hardness, takes, copies, inverse):
    seen = Seen(OVAL, *([{"do": "select", "invert": True}] if inverse else []))
    seen.ask(AskTint(0, AREA))
    before = seen.alpha.copy()
    brush = Brush(radius=float(radius), hardness=hardness)
    table = rounded(np.array([[x, y, 1.0, 0.0, 0.0, 0.1 * n] for n, (x, y) in enumerate(points)]))
    table.flags.writeable = False
    seen.ask(MaskBegin(0, (10, -20), brush, takes, copies))
    for row in table:
        seen.ask(MaskPoints(row[None]))
    painted = seen.alpha.astype(int)
    assert ((painted >= before) if takes else (painted <= before)).all()
    assert all(part.area < AREA.area for part in seen.parts[1:])  # while it is painted, no more than it changes
    seen.easel.carry_out(c.Select(Line(0, (10, -20), table, brush, copies), "subtract" if takes else "add"))
    seen.ask(MaskEnd())
    assert np.abs(seen.alpha - painted).max() <= 1
    chosen = seen.easel.session.painting.selection.part(0, AREA.grown(0), None)
    assert np.abs(255 - 255 * np.broadcast_to(chosen, seen.alpha.shape) - seen.alpha).max() <= 1


def test_where_nothing_is_selected_all_is_tinted_and_a_dropped_stroke_leaves_no_trace():
    seen = Seen()
    assert not seen.finder.pending
    seen.ask(AskTint(0, AREA))
    assert (seen.alpha == 255).all()
    seen.ask(MaskBegin(0, (0, 0), Brush(radius=30.0), False))
    seen.ask(MaskPoints(np.array([[50.0, 40.0, 1.0, 0.0, 0.0, 0.0]])))
    assert not seen.alpha.all()
    seen.ask(MaskEnd())
    assert (seen.alpha == 255).all()
    seen.ask(AskTint(0, None))
    seen.easel.carry_out(c.parse(OVAL))
    assert not seen.finder.pending
