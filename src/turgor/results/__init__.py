"""Results: measures, files, pictures, plots and the report of a solution."""

from turgor.results.fields import StateFields
from turgor.results.measures import (
    MEASURES,
    STANDARD_MEASURES,
    Measure,
    bending_angle,
    cavity_volume,
    check_measures,
    find_measure,
    maximum_principal_stretch,
    maximum_von_mises,
    measure,
    reaction,
    smallest_gap,
    tip_displacement,
    tip_displacement_x,
    tip_displacement_y,
    tip_displacement_z,
    twist_angle,
    volume_of,
)
from turgor.results.pictures import picture_title, shared_view, write_picture
from turgor.results.plots import plot_response, response_figure, write_plot
from turgor.results.rendering import View
from turgor.results.report import Picture, Report, write_report
from turgor.results.vtu import write_series, write_vtu

__all__ = [
    "MEASURES",
    "STANDARD_MEASURES",
    "Measure",
    "Picture",
    "Report",
    "StateFields",
    "View",
    "bending_angle",
    "cavity_volume",
    "check_measures",
    "find_measure",
    "maximum_principal_stretch",
    "maximum_von_mises",
    "measure",
    "picture_title",
    "plot_response",
    "reaction",
    "response_figure",
    "shared_view",
    "smallest_gap",
    "tip_displacement",
    "tip_displacement_x",
    "tip_displacement_y",
    "tip_displacement_z",
    "twist_angle",
    "volume_of",
    "write_picture",
    "write_plot",
    "write_report",
    "write_series",
    "write_vtu",
]
