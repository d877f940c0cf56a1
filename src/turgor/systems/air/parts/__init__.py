"""Parts of a network: each states the mass flow between two nodes."""
