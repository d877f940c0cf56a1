"""Pictures and plots of meshes, states and responses."""

from turgor.results.pictures.mesh_picture import write_mesh_picture as write_mesh_picture
from turgor.results.pictures.state_picture import shared_view as shared_view
from turgor.results.pictures.state_picture import write_picture as write_picture
from turgor.results.plots.response_plots import COLORS as COLORS
from turgor.results.plots.response_plots import plot_response as plot_response
