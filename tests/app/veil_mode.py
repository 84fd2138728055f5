"""A stroke mode that only the tests know: all of it is this module and its row.

As a program, it is Inkfall with that row in the table.
"""

import sys

import numpy as np

from engine.brush.covered import Covered
from engine.brush.modes import MODES, Mode
from engine.brush.stamp import Stamp
from engine.numeric.grid import snapped


class Veil(Covered):
    """Lays the brush's colour, half as thick as paint: A = 1 - M/2."""

    def stamp(self, key, old):
        keep = None if self.locked else self.keep(key)
        if keep is None:
            return None
        veil = snapped((1 - keep) / 2)
        colour = np.array([*self.brush.rgb, 1.0], np.float32)
        return Stamp(1 - veil, snapped(veil * colour[:, None, None]), plain=True)


ROW = Mode("veil", "Veil", "Lays colour half as thick", "veil_mode:Veil")

if __name__ == "__main__":
    from app.__main__ import main

    MODES[ROW.name] = ROW
    sys.exit(main())
