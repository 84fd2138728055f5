"""Steps that set nothing but the symmetry that one paints with: for the hand that is no step to be taken back."""

from __future__ import annotations

from engine.painting.guiding.guides import Guides
from engine.session.session import Session


def steps_over_symmetry(session: Session, back: bool) -> int:
    """Counts the steps to go from one that sets more than the symmetry to the next, back or forth: those that only set
    it after a step belong to it, so that doing again undoes what undoing did."""
    count = 1 + _symmetries(session, back, 0)
    return count if back else count + _symmetries(session, back, count)


def _symmetries(session: Session, back: bool, first: int) -> int:
    """Counts the steps in a row that only set the symmetry, beyond the first so many."""
    count, way = first, -1 if back else 1
    near = _guides(session, way * count)
    while near is not None and (far := _guides(session, way * (count + 1))) is not None and _only_symmetry(near, far):
        count, near = count + 1, far
    return count - first


def _guides(session: Session, by: int) -> Guides | None:
    """Returns the guides so many steps on, or back; None where that is not held."""
    found = session.history.at(by) if by else session.painting
    return None if found is None else found.guides


def _only_symmetry(before: Guides, after: Guides) -> bool:
    """Tells whether a step set nothing but the symmetry: commands that set guides do nothing else."""
    changed = [name for name in {*before, *after} if before.get(name) is not after.get(name)]
    return {guides[name].kind for name in changed for guides in (before, after) if name in guides} == {"symmetry"}
