"""The member `mask` of a layer's `set`: the name of a selection, what is selected, none, or a change of the mask."""

from __future__ import annotations

from dataclasses import dataclass

from engine.files.strict_json import Fields, is_name

MASK_FULL, MASK_EMPTY, MASK_INVERT, MASK_APPLY, MASK_OFF, MASK_ON = "full", "empty", "invert", "apply", "off", "on"
MASK_LAY = "lay"
MASK_OPS = MASK_FULL, MASK_EMPTY, MASK_INVERT, MASK_APPLY, MASK_OFF, MASK_ON, MASK_LAY


@dataclass(frozen=True, slots=True)
class MaskOp:
    """What is to be done to a mask, one of MASK_OPS: one that shows all or nothing instead, what does not show shown
    and the other way round, the paint that it hides taken off, the mask put aside and used again, or a placement's
    laid anew where it is seen, which was turned with it."""

    op: str


MaskValue = str | bool | MaskOp  # a selection that is kept; True: what is selected; False: none


def read_mask(members: Fields, name: str) -> MaskValue:
    """Returns what a command sets; FieldError if it is none of these."""
    wanted = members.take(name)
    if wanted is None or wanted is True:
        return wanted is True
    if isinstance(wanted, dict) and list(wanted) == ["op"] and wanted["op"] in MASK_OPS:
        return MaskOp(str(wanted["op"]))
    if not is_name(wanted):
        ops = ", ".join(MASK_OPS)
        expected = (
            f"the name of a selection, true for what is selected, null for none, or an object with an op of {ops}"
        )
        raise members.fault(name, expected)
    return str(wanted)


def write_mask(value: MaskValue) -> object:
    """Returns the member that `read_mask` makes the same of."""
    return {"op": value.op} if isinstance(value, MaskOp) else value or None
