"""Pictures of meshes and states, rendered without a graphics card."""
