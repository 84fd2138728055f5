"""The roles that layers and placements may have, and how long their names are.  Light: it imports nothing."""

REFERENCE = "reference"  # of what is looked at while one paints, and is no part of the picture
AS_HEIGHT = "height"  # of what is not looked at, but is how high the land lies
COPIED = "copied"  # of what was copied last, hidden in the painting until it is pasted
MAX_NAME = 200  # characters
ROLES = "", REFERENCE, AS_HEIGHT, COPIED
ASIDE = REFERENCE, AS_HEIGHT  # of what is no part of the picture
