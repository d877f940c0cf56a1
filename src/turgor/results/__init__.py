"""Results: measures, files, pictures, plots and the report of a solution."""

from turgor.results.fields.state_fields import StateFields
from turgor.results.files.vtu import write_series, write_state, write_vtu
from turgor.results.measures.field_measures import (
    maximum_principal_stretch,
    maximum_von_mises,
    principal_stretch_in,
    principal_stretch_p99,
    von_mises_in,
    von_mises_p99,
)
from turgor.results.measures.measures import (
    MEASURES,
    STANDARD_MEASURES,
    Measure,
    bending_angle,
    cavity_volume,
    check_measures,
    find_measure,
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
from turgor.results.pictures.rendering import View
from turgor.results.pictures.state_picture import picture_title, shared_view, write_picture
from turgor.results.plots.response_plots import plot_response, response_figure, write_plot
from turgor.results.report.page import Picture, Report, write_report

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
    "principal_stretch_in",
    "principal_stretch_p99",
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
    "von_mises_in",
    "von_mises_p99",
    "write_picture",
    "write_plot",
    "write_report",
    "write_series",
    "write_state",
    "write_vtu",
]
