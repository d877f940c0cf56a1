"""Pictures and plots of meshes, states and responses."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.views.pictures.colors import FIELDS as FIELDS
    from turgor.views.pictures.colors import Field as Field
    from turgor.views.pictures.cuts import Cut as Cut
    from turgor.views.pictures.mesh_picture import write_mesh_picture as write_mesh_picture
    from turgor.views.pictures.series.motion import Motion as Motion
    from turgor.views.pictures.series.motion import write_motion as write_motion
    from turgor.views.pictures.series.sheets import side_by_side as side_by_side
    from turgor.views.pictures.series.sheets import small_multiples as small_multiples
    from turgor.views.pictures.series.sheets import write_sheet as write_sheet
    from turgor.views.pictures.state_picture import Style as Style
    from turgor.views.pictures.state_picture import bare_picture as bare_picture
    from turgor.views.pictures.state_picture import shared_view as shared_view
    from turgor.views.pictures.state_picture import write_picture as write_picture
    from turgor.views.plots.materials import material_figure as material_figure
    from turgor.views.plots.materials import material_panels as material_panels
    from turgor.views.plots.presets import Preset as Preset
    from turgor.views.plots.presets import preset as preset
    from turgor.views.plots.presets import write_curves as write_curves
    from turgor.views.plots.response_plots import COLORS as COLORS
    from turgor.views.plots.response_plots import plot_response as plot_response
    from turgor.views.plots.study_figure import Line as Line
    from turgor.views.plots.study_figure import Panel as Panel
    from turgor.views.plots.study_figure import study_figure as study_figure
    from turgor.views.plots.workspace_plot import plot_workspace as plot_workspace
    from turgor.views.viewer.viewer import Viewer as Viewer
    from turgor.views.viewer.viewer import viewer as viewer
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
