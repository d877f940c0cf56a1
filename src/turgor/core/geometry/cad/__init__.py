"""CAD files: import of parts, detection of their cavities, and names of their faces."""
