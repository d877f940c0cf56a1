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
    from turgor.study.computation import Computation as Computation
    from turgor.study.designs import Designs as Designs
    from turgor.study.designs import factorial as factorial
    from turgor.study.designs import latin_hypercube as latin_hypercube
    from turgor.study.designs import sobol as sobol
    from turgor.study.evaluations import Evaluations as Evaluations
    from turgor.study.evaluations import kept_in as kept_in
    from turgor.study.factor import Factor as Factor
    from turgor.study.files.designs_csv import read_designs as read_designs
    from turgor.study.files.stored import load_study as load_study
    from turgor.study.files.stored import write_study as write_study
    from turgor.study.jobs.job_sweep import sweep_job as sweep_job
    from turgor.study.jobs.study_file import StudyFile as StudyFile
    from turgor.study.jobs.study_file import read_study_file as read_study_file
    from turgor.study.pictures import curves_picture as curves_picture
    from turgor.study.pictures import hidden_by_mesh as hidden_by_mesh
    from turgor.study.pictures import map_picture as map_picture
    from turgor.study.pictures import multiples_picture as multiples_picture
    from turgor.study.pictures import parallel_picture as parallel_picture
    from turgor.study.pictures import study_picture as study_picture
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
