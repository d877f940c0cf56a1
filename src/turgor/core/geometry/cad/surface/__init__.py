"""Parts that come as facets: repaired, grouped into faces, and named like CAD parts."""
