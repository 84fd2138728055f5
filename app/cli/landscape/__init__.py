"""`inkfall terrain`: pictures, maps and meshes."""
