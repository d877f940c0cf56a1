"""Draft of a part: its walls along a pull are tapered."""
