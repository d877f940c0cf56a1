"""Results: measures, files, pictures, plots and the report of a solution."""

from typing import TYPE_CHECKING

from turgor._lazy import public

if TYPE_CHECKING:
    from turgor.results.fields.state_fields import StateFields as StateFields
    from turgor.results.files.vtu import write_series as write_series
    from turgor.results.files.vtu import write_state as write_state
    from turgor.results.files.vtu import write_vtu as write_vtu
    from turgor.results.measures.field_measures import maximum_principal_stretch as maximum_principal_stretch
    from turgor.results.measures.field_measures import maximum_von_mises as maximum_von_mises
    from turgor.results.measures.field_measures import principal_stretch_in as principal_stretch_in
    from turgor.results.measures.field_measures import principal_stretch_p99 as principal_stretch_p99
    from turgor.results.measures.field_measures import von_mises_in as von_mises_in
    from turgor.results.measures.field_measures import von_mises_p99 as von_mises_p99
    from turgor.results.measures.measures import MEASURES as MEASURES
    from turgor.results.measures.measures import STANDARD_MEASURES as STANDARD_MEASURES
    from turgor.results.measures.measures import Measure as Measure
    from turgor.results.measures.measures import bending_angle as bending_angle
    from turgor.results.measures.measures import cavity_volume as cavity_volume
    from turgor.results.measures.measures import check_measures as check_measures
    from turgor.results.measures.measures import find_measure as find_measure
    from turgor.results.measures.measures import measure as measure
    from turgor.results.measures.measures import reaction as reaction
    from turgor.results.measures.measures import smallest_gap as smallest_gap
    from turgor.results.measures.measures import tip_displacement as tip_displacement
    from turgor.results.measures.measures import tip_displacement_x as tip_displacement_x
    from turgor.results.measures.measures import tip_displacement_y as tip_displacement_y
    from turgor.results.measures.measures import tip_displacement_z as tip_displacement_z
    from turgor.results.measures.measures import twist_angle as twist_angle
    from turgor.results.measures.measures import volume_of as volume_of
    from turgor.results.pictures.rendering import View as View
    from turgor.results.pictures.state_picture import picture_title as picture_title
    from turgor.results.pictures.state_picture import shared_view as shared_view
    from turgor.results.pictures.state_picture import write_picture as write_picture
    from turgor.results.plots.response_plots import plot_response as plot_response
    from turgor.results.plots.response_plots import response_figure as response_figure
    from turgor.results.plots.response_plots import write_plot as write_plot
    from turgor.results.report.page import Picture as Picture
    from turgor.results.report.page import Report as Report
    from turgor.results.report.page import write_report as write_report
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
