"""The two arithmetics in which pixels are worked out, by the number that a painting and its textures carry, and the two
grids on which they lie (engine/numeric/grid.py), by their bits behind the point.

1, LIBRARY: functions of the C library and of NumPy, whose last bits differ from processor to processor: that of
recordings of version 1, which keep their pixels.  2, EVERYWHERE: those of `elementary`, the same everywhere.  What a
function is given is part of what it is cached by, so the number is an argument wherever it counts; module `functions`
has what it stands for.  Light to import.
"""

LIBRARY, EVERYWHERE = 1, 2
NEWEST = EVERYWHERE  # of paintings that begin now
FINE, COARSE = 16, 12  # grids; paintings begin on the fine one unless they are asked for on the other
