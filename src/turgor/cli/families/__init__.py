"""Commands ``turgor actuators`` and ``turgor init``."""
