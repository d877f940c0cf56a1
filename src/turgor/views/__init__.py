"""Views: pictures, plots, the viewer, the report and notebooks."""
