"""When the interpreter looks for garbage in cycles, which stops all threads for as long as it takes.

Its own full look goes through all that is alive: 0.7 s in a painting of strokes at 4,000 places, 2.2 s at 10,000.  What
has outlived one look is passed over by the next ones, which then take a few milliseconds however large the painting is.
What nobody holds goes at once nevertheless; only a cycle that is let go after it was passed over stays, until all is
looked at anew.  Painting makes none that hold pixels.
"""

from __future__ import annotations

import gc

_PASSES = 4  # of the interpreter's looks through young objects, some 7,000 each: so many new ones are looked through


def due() -> bool:
    """Tells whether there is so much that is new that it is worth a look."""
    return gc.isenabled() and gc.get_count()[2] >= _PASSES


def pass_over() -> None:
    """Looks through what is new, and has it passed over from then on.

    It is for moments at which nothing is half done: while nothing else is to be done, between strokes.
    """
    gc.collect()
    gc.freeze()


def look_anew() -> None:
    """Has all that is passed over looked at once more: what held a painting that is gone may be a cycle."""
    gc.unfreeze()
