"""Meshes and models from and for other programs."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.core.inp.account import InpNote as InpNote
    from turgor.core.inp.write_inp import compressible as compressible
    from turgor.core.inp.write_inp import write_inp as write_inp
    from turgor.core.meshing.exchange import MeshFile as MeshFile
    from turgor.core.meshing.exchange import mesh_surfaces as mesh_surfaces
    from turgor.core.meshing.exchange import read_mesh as read_mesh
    from turgor.core.meshing.exchange.formats.write_stl import write_stl as write_stl
    from turgor.core.meshing.exchange.node_selectors import ByNodes as ByNodes
    from turgor.core.meshing.exchange.node_selectors import BySides as BySides
    from turgor.core.meshing.revolved.plane_state import Axisymmetric as Axisymmetric
    from turgor.core.meshing.revolved.plane_state import PlaneStrain as PlaneStrain
    from turgor.core.meshing.revolved.read_plane import read_plane_mesh as read_plane_mesh
    from turgor.core.results.files.modes_vtu import write_modes as write_modes
    from turgor.core.results.files.response_csv import read_response as read_response
    from turgor.core.results.files.vtu import write_series as write_series
    from turgor.job.decks.account import DeckRow as DeckRow
    from turgor.job.decks.importing import DeckImport as DeckImport
    from turgor.job.decks.importing import import_deck as import_deck
    from turgor.systems.exports.fmu import write_fmu as write_fmu
    from turgor.systems.exports.formats import export_reduced as export_reduced
    from turgor.systems.exports.sofa import SofaScene as SofaScene
    from turgor.systems.exports.sofa import write_sofa as write_sofa
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
