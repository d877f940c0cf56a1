"""Sections: what a long actuator does far from its ends, from its cross-section alone."""
