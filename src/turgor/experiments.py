"""Experiments: tests of materials with the laws fitted to them, and measured actuators compared with computed ones."""

from typing import TYPE_CHECKING

from turgor._lazy import public

if TYPE_CHECKING:
    from turgor.laboratory.compare import Comparison as Comparison
    from turgor.laboratory.compare import compare as compare
    from turgor.laboratory.comparison_plot import comparison_figure as comparison_figure
    from turgor.laboratory.markers import Tracks as Tracks
    from turgor.laboratory.markers import read_tracks as read_tracks
    from turgor.laboratory.read_experiment import read_experiment as read_experiment
    from turgor.laboratory.read_experiment import read_experiments as read_experiments
    from turgor.laboratory.runs import average_runs as average_runs
    from turgor.laboratory.runs import loading as loading
    from turgor.laboratory.runs import unloading as unloading
    from turgor.materials.experiments.cycles import select_cycle as select_cycle
    from turgor.materials.experiments.handling import average as average
    from turgor.materials.experiments.handling import crop as crop
    from turgor.materials.experiments.handling import remove_slack as remove_slack
    from turgor.materials.experiments.handling import remove_tail as remove_tail
    from turgor.materials.experiments.handling import rest_below as rest_below
    from turgor.materials.experiments.handling import set_zero_length as set_zero_length
    from turgor.materials.experiments.handling import thin as thin
    from turgor.materials.experiments.material_test import Edit as Edit
    from turgor.materials.experiments.material_test import MaterialTest as MaterialTest
    from turgor.materials.experiments.read_tests import read_tests as read_tests
    from turgor.materials.experiments.specimen import Specimen as Specimen
    from turgor.materials.fitting.checks import check_modes as check_modes
    from turgor.materials.fitting.checks import check_order as check_order
    from turgor.materials.fitting.checks import check_stretch_range as check_stretch_range
    from turgor.materials.fitting.fit_history import fit_history as fit_history
    from turgor.materials.fitting.fit_laws import fit as fit
    from turgor.materials.fitting.history_fit import HistoryFit as HistoryFit
    from turgor.materials.fitting.ranking import Ranking as Ranking
    from turgor.materials.fitting.ranking import rank as rank
    from turgor.materials.fitting.result import Fit as Fit
    from turgor.materials.fitting.result import FitResidual as FitResidual
    from turgor.materials.fitting.save import save_fits as save_fits
    from turgor.materials.fitting.save import save_material as save_material
    from turgor.response import Column as Column
    from turgor.results.plots.history import history_figure as history_figure
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
