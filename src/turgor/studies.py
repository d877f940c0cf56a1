"""Studies: parameters calibrated against experiments, uncertainty carried to responses, runs kept on disk."""

from typing import TYPE_CHECKING

from turgor._lazy import public

if TYPE_CHECKING:
    from turgor.calibration.calibrate import calibrate as calibrate
    from turgor.calibration.figure import calibration_figure as calibration_figure
    from turgor.calibration.parameter import Parameter as Parameter
    from turgor.calibration.result import Calibration as Calibration
    from turgor.calibration.trial import Trial as Trial
    from turgor.calibration.write import write_calibration as write_calibration
    from turgor.optimization.figure import optimization_figure as optimization_figure
    from turgor.optimization.goals import Limit as Limit
    from turgor.optimization.goals import Maximize as Maximize
    from turgor.optimization.goals import Minimize as Minimize
    from turgor.optimization.goals import Target as Target
    from turgor.optimization.goals import TipPath as TipPath
    from turgor.optimization.manufacture import Casting as Casting
    from turgor.optimization.manufacture import casting_rules as casting_rules
    from turgor.optimization.result import Optimization as Optimization
    from turgor.optimization.rules import Rule as Rule
    from turgor.optimization.search import Ending as Ending
    from turgor.optimization.search import Search as Search
    from turgor.optimization.slopes import with_slopes as with_slopes
    from turgor.optimization.write import write_optimization as write_optimization
    from turgor.study.computation import Computation as Computation
    from turgor.study.designs import Designs as Designs
    from turgor.study.designs import factorial as factorial
    from turgor.study.designs import latin_hypercube as latin_hypercube
    from turgor.study.designs import sobol as sobol
    from turgor.study.evaluations import Evaluations as Evaluations
    from turgor.study.evaluations import kept_in as kept_in
    from turgor.study.factor import Factor as Factor
    from turgor.study.run_all import run_all as run_all
    from turgor.study.running.ended import Ended as Ended
    from turgor.study.running.executors import Executor as Executor
    from turgor.study.running.executors import Here as Here
    from turgor.study.running.workers import Workers as Workers
    from turgor.study.runs import Computed as Computed
    from turgor.study.runs import Run as Run
    from turgor.study.study import Row as Row
    from turgor.study.study import Study as Study
    from turgor.study.workspaces import WorkspaceRuns as WorkspaceRuns
    from turgor.study.workspaces import workspace_of as workspace_of
    from turgor.uncertainty.band import Band as Band
    from turgor.uncertainty.band import Uncertainty as Uncertainty
    from turgor.uncertainty.cases import Case as Case
    from turgor.uncertainty.cases import library_alternatives as library_alternatives
    from turgor.uncertainty.figure import uncertainty_figure as uncertainty_figure
    from turgor.uncertainty.propagate import propagate as propagate
    from turgor.uncertainty.spread import Alternatives as Alternatives
    from turgor.uncertainty.spread import Spread as Spread
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
