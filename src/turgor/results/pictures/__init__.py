"""Pictures: drawings of a mesh or a state without a graphics card."""
