"""Studies: parameters calibrated, uncertainty carried to responses, derivatives of measures, runs kept on disk."""

from typing import TYPE_CHECKING

from turgor._lazy import public

if TYPE_CHECKING:
    from turgor.calibration.calibrate import calibrate as calibrate
    from turgor.calibration.calibrate import kept_in as kept_in
    from turgor.calibration.figure import calibration_figure as calibration_figure
    from turgor.calibration.parameter import Parameter as Parameter
    from turgor.calibration.result import Calibration as Calibration
    from turgor.calibration.trial import Trial as Trial
    from turgor.calibration.write import write_calibration as write_calibration
    from turgor.gradients.keys import model_numbers as model_numbers
    from turgor.gradients.keys import with_number as with_number
    from turgor.gradients.result import Gradient as Gradient
    from turgor.gradients.variation import Variation as Variation
    from turgor.study.evaluations import Evaluations as Evaluations
    from turgor.study.job_gradients import gradient_of_job as gradient_of_job
    from turgor.study.run_all import Ended as Ended
    from turgor.study.run_all import run_all as run_all
    from turgor.study.runs import Computed as Computed
    from turgor.study.runs import Run as Run
    from turgor.study.workspaces import WorkspaceRuns as WorkspaceRuns
    from turgor.study.workspaces import workspace_of as workspace_of
    from turgor.uncertainty.band import Band as Band
    from turgor.uncertainty.band import Uncertainty as Uncertainty
    from turgor.uncertainty.cases import Case as Case
    from turgor.uncertainty.cases import library_alternatives as library_alternatives
    from turgor.uncertainty.figure import uncertainty_figure as uncertainty_figure
    from turgor.uncertainty.plan import Computation as Computation
    from turgor.uncertainty.propagate import propagate as propagate
    from turgor.uncertainty.spread import Alternatives as Alternatives
    from turgor.uncertainty.spread import Spread as Spread
else:
    __getattr__, __dir__, __all__ = public(__file__, globals())
