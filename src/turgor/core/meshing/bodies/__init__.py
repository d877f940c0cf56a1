"""Bodies: meshes placed, mirrored and put together."""
