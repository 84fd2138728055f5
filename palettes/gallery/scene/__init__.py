"""The still life: wall, table, cloth, jug, fruit, and the light on them."""
