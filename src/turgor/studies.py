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
    from turgor.sensitivity.anova import Anova as Anova
    from turgor.sensitivity.anova import Term as Term
    from turgor.sensitivity.anova import anova as anova
    from turgor.sensitivity.asked import Direct as Direct
    from turgor.sensitivity.figure import anova_figure as anova_figure
    from turgor.sensitivity.figure import indices_figure as indices_figure
    from turgor.sensitivity.indices import Indices as Indices
    from turgor.sensitivity.indices import Screening as Screening
    from turgor.sensitivity.indices import screening as screening
    from turgor.sensitivity.indices import sobol_indices as sobol_indices
    from turgor.sensitivity.local import LocalSensitivity as LocalSensitivity
    from turgor.sensitivity.local import Tolerance as Tolerance
    from turgor.sensitivity.local import local_sensitivities as local_sensitivities
    from turgor.sensitivity.local import sensitivities_of as sensitivities_of
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
    from turgor.surrogates.figure import surrogate_figure as surrogate_figure
    from turgor.surrogates.fit import surrogate as surrogate
    from turgor.surrogates.held_out import HeldOut as HeldOut
    from turgor.surrogates.invert import Inverse as Inverse
    from turgor.surrogates.invert import invert as invert
    from turgor.surrogates.learn import Goal as Goal
    from turgor.surrogates.learn import Learned as Learned
    from turgor.surrogates.learn import learn as learn
    from turgor.surrogates.next_design import next_design as next_design
    from turgor.surrogates.surrogate import Prediction as Prediction
    from turgor.surrogates.surrogate import Surrogate as Surrogate
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
