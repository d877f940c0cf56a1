"""Learning: reduced models as functions with derivatives, and as an environment."""
