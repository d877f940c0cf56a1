"""Pictures and plots of meshes, states and responses."""

from typing import TYPE_CHECKING

from turgor._lazy import public

if TYPE_CHECKING:
    from turgor.results.pictures.mesh_picture import write_mesh_picture as write_mesh_picture
    from turgor.results.pictures.state_picture import shared_view as shared_view
    from turgor.results.pictures.state_picture import write_picture as write_picture
    from turgor.results.plots.response_plots import COLORS as COLORS
    from turgor.results.plots.response_plots import plot_response as plot_response
    from turgor.results.viewer.viewer import Viewer as Viewer
    from turgor.results.viewer.viewer import viewer as viewer
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
