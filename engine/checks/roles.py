"""The roles that layers and placements may have.  Light: it imports nothing."""

REFERENCE = "reference"  # of what is looked at while one paints, and is no part of the picture
COPIED = "copied"  # of what was copied last, hidden in the painting until it is pasted
ROLES = "", REFERENCE, COPIED
