"""Motions and states of a deck that are no faces with a load: temperatures, rigid bodies, loose bodies."""
