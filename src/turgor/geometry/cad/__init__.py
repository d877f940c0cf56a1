"""CAD files: parts drawn elsewhere, with their cavities found and their faces named."""
