"""Outlines of a section: the sheets and threads on them, how shells bend, and the loops around cavities."""
