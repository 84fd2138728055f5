"""Files for programs that work in space: height maps, meshes."""
