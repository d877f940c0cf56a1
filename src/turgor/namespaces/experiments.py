"""Experiments: tests of materials with the laws fitted to them, and measured actuators compared with computed ones."""

from typing import TYPE_CHECKING

from turgor.foundation.lazy_names import public

if TYPE_CHECKING:
    from turgor.accuracy.laboratory.compare import Comparison as Comparison
    from turgor.accuracy.laboratory.compare import compare as compare
    from turgor.accuracy.laboratory.comparison_plot import comparison_figure as comparison_figure
    from turgor.accuracy.laboratory.compliance import without_compliance as without_compliance
    from turgor.accuracy.laboratory.markers import Tracks as Tracks
    from turgor.accuracy.laboratory.markers import read_tracks as read_tracks
    from turgor.accuracy.laboratory.read_experiment import read_experiment as read_experiment
    from turgor.accuracy.laboratory.read_experiment import read_experiments as read_experiments
    from turgor.accuracy.laboratory.rest import remove_drift as remove_drift
    from turgor.accuracy.laboratory.runs import average_runs as average_runs
    from turgor.accuracy.laboratory.runs import loading as loading
    from turgor.accuracy.laboratory.runs import unloading as unloading
    from turgor.accuracy.laboratory.runs import within_ranges as within_ranges
    from turgor.core.materials.experiments.cycles import select_cycle as select_cycle
    from turgor.core.materials.experiments.machine import Machine as Machine
    from turgor.core.materials.experiments.machine import read_machine as read_machine
    from turgor.core.materials.experiments.machine import remove_compliance as remove_compliance
    from turgor.core.materials.experiments.material_test import Edit as Edit
    from turgor.core.materials.experiments.material_test import MaterialTest as MaterialTest
    from turgor.core.materials.experiments.read_tests import read_tests as read_tests
    from turgor.core.materials.experiments.slack import count_from_zero as count_from_zero
    from turgor.core.materials.experiments.specimen import Specimen as Specimen
    from turgor.core.materials.experiments.test_edits import average as average
    from turgor.core.materials.experiments.test_edits import crop as crop
    from turgor.core.materials.experiments.test_edits import remove_slack as remove_slack
    from turgor.core.materials.experiments.test_edits import remove_tail as remove_tail
    from turgor.core.materials.experiments.test_edits import rest_below as rest_below
    from turgor.core.materials.experiments.test_edits import set_zero_length as set_zero_length
    from turgor.core.materials.experiments.test_edits import thin as thin
    from turgor.core.materials.fitting.checks import check_modes as check_modes
    from turgor.core.materials.fitting.checks import check_order as check_order
    from turgor.core.materials.fitting.checks import check_stretch_range as check_stretch_range
    from turgor.core.materials.fitting.fit_directions import DirectionsFit as DirectionsFit
    from turgor.core.materials.fitting.fit_directions import fit_directions as fit_directions
    from turgor.core.materials.fitting.fit_laws import fit as fit
    from turgor.core.materials.fitting.fit_woven import WovenFit as WovenFit
    from turgor.core.materials.fitting.fit_woven import fit_woven as fit_woven
    from turgor.core.materials.fitting.histories.fit_flow import fit_flow as fit_flow
    from turgor.core.materials.fitting.histories.fit_history import fit_history as fit_history
    from turgor.core.materials.fitting.histories.history_fit import HistoryFit as HistoryFit
    from turgor.core.materials.fitting.library_check import check_library as check_library
    from turgor.core.materials.fitting.ranking import Ranking as Ranking
    from turgor.core.materials.fitting.ranking import rank as rank
    from turgor.core.materials.fitting.result import Fit as Fit
    from turgor.core.materials.fitting.result import FitResidual as FitResidual
    from turgor.core.materials.fitting.save import save_fits as save_fits
    from turgor.core.materials.fitting.save import save_material as save_material
    from turgor.core.materials.fitting.uncertainty import spread_between as spread_between
    from turgor.foundation.response import Column as Column
    from turgor.views.plots.history import history_figure as history_figure
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
