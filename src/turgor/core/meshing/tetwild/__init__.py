"""Tetrahedra in a part that is given by facets: made within an envelope of its surface, then drawn onto it."""
