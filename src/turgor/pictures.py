"""Pictures and plots of meshes, states and responses."""

from typing import TYPE_CHECKING

from turgor._lazy import public

if TYPE_CHECKING:
    from turgor.results.pictures.colors import FIELDS as FIELDS
    from turgor.results.pictures.colors import Field as Field
    from turgor.results.pictures.cuts import Cut as Cut
    from turgor.results.pictures.mesh_picture import write_mesh_picture as write_mesh_picture
    from turgor.results.pictures.series.motion import Motion as Motion
    from turgor.results.pictures.series.motion import write_motion as write_motion
    from turgor.results.pictures.series.sheets import side_by_side as side_by_side
    from turgor.results.pictures.series.sheets import small_multiples as small_multiples
    from turgor.results.pictures.series.sheets import write_sheet as write_sheet
    from turgor.results.pictures.state_picture import Style as Style
    from turgor.results.pictures.state_picture import shared_view as shared_view
    from turgor.results.pictures.state_picture import write_picture as write_picture
    from turgor.results.plots.presets import Preset as Preset
    from turgor.results.plots.presets import preset as preset
    from turgor.results.plots.presets import write_curves as write_curves
    from turgor.results.plots.response_plots import COLORS as COLORS
    from turgor.results.plots.response_plots import plot_response as plot_response
    from turgor.results.plots.workspace_plot import plot_workspace as plot_workspace
    from turgor.results.viewer.viewer import Viewer as Viewer
    from turgor.results.viewer.viewer import viewer as viewer
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
