"""Running and judging guidelines: the runs of all their studies at once, then each study by its results."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import turgor as tg
from turgor.studies import Ended, ended_before, run_all
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict, overall


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class JudgedStudy:
    """A study, its judgement, and the results of its runs.

    Parameters
    ----------
    study : GuidelineTest
    judgement : Judgement
    runs : mapping of str to Computed
        Results of the runs, by their names.
    """

    study: GuidelineTest
    judgement: Judgement
    runs: Runs

    @property
    def seconds(self) -> float:
        """CPU seconds of the runs."""
        return sum(each.seconds for each in self.runs.values())


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Judged:
    """A guideline and the judgements on its studies.

    Parameters
    ----------
    guideline : Guideline
    studies : tuple of JudgedStudy
    """

    guideline: Guideline
    studies: tuple[JudgedStudy, ...]

    @property
    def verdict(self) -> Verdict:
        """Verdict on the guideline."""
        return overall(tuple(each.judgement for each in self.studies))


def run_guidelines(
    requested: Sequence[Guideline],
    folder: Path,
    setting: Setting = "quick",
    *,
    processes: int = 1,
    progress: Callable[[Ended], None] | None = None,
    retry: bool = False,
) -> tuple[Judged, ...]:
    """Run the studies of guidelines and judge them; what has ended before is read from the folder.

    Parameters
    ----------
    requested : sequence of Guideline
    folder : Path
        Where runs are saved.
    setting : {"quick", "full"}
        How much is computed.
    processes : int
        Processes at once.
    progress : callable or None
        Called with every run that has ended.
    retry : bool
        Whether runs that failed or ended early before are computed again.

    Returns
    -------
    tuple of Judged
    """
    runs = [run for guideline in requested for study in guideline.studies for run in study.runs(setting)]
    ended = run_all(runs, folder, processes=processes, progress=progress, retry=retry)
    problems = {key: each.problem for key, each in ended.items()}
    return tuple(judged(guideline, folder, setting, problems) for guideline in requested)


def judged(
    guideline: Guideline, folder: Path, setting: Setting = "quick", problems: dict[str, str] | None = None
) -> Judged:
    """Judge a guideline by the results of the runs that have ended.

    Parameters
    ----------
    guideline : Guideline
    folder : Path
        Where runs are saved.
    setting : {"quick", "full"}
        Which runs count.
    problems : dict of str to str, optional
        Why runs failed, by their keys.

    Returns
    -------
    Judged
        A study whose runs have not all ended is *not judged*.
    """
    studies = (_judged_study(study, folder, setting, problems or {}) for study in guideline.studies)
    return Judged(guideline=guideline, studies=tuple(studies))


def _judged_study(study: GuidelineTest, folder: Path, setting: Setting, problems: dict[str, str]) -> JudgedStudy:
    result, missing = {}, []
    for run in study.runs(setting):
        ended = ended_before(run, folder)
        if ended is not None and ended.result is not None:
            result[run.name] = ended.result
        else:
            why = problems.get(run.key) or (ended.problem if ended is not None else "not run yet")
            missing.append(f"{run.name}: {why}")
    if missing:
        judgement = Judgement(verdict=Verdict.NOT_JUDGED, finding="; ".join(missing))
    else:
        try:
            judgement = study.judge(result)
        except tg.TurgorError as error:  # such as a column that a run which stopped early does not have
            judgement = Judgement(verdict=Verdict.NOT_JUDGED, finding=str(error))
    return JudgedStudy(study=study, judgement=judgement, runs=result)
