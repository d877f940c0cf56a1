"""Calibration of job files: free keys and priors as text, and trials whose function solves the job."""

from collections.abc import Iterable, Sequence

from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.response import Response
from turgor.studies.calibration.job_model import calibrated_job
from turgor.studies.calibration.objective import with_prior
from turgor.studies.calibration.parameter import Parameter
from turgor.studies.calibration.trial import Trial
from turgor.studies.runs.jobs.job_file import JobFile, keys_of
from turgor.studies.runs.jobs.job_numbers import JobNumber, find_number, read_number

#: The job with the values that were found.
CALIBRATED = "calibrated.toml"

#: Steps of the finite differences: of numbers that change the mesh, and of others.
MESHED_STEP, STEP = 0.03, 0.01


def job_trial(
    job: JobFile,
    measured: Response,
    *,
    y: str | None = None,
    x: str | None = None,
    spread: float | None = None,
    fitted: Sequence[Response] = (),
) -> Trial:
    """Return an experiment with a job as its model.

    Parameters
    ----------
    job : JobFile
    measured : Response
    y, x, spread
        Of `Trial`.
    fitted : sequence of Response
        All experiments that are fitted with the job, so that one run serves them all; by default this one alone.

    Returns
    -------
    Trial
    """
    columns = list(dict.fromkeys(name for each in fitted or (measured,) for name in each.names))
    drives = [x.partition("=")[0].strip()] if x else columns
    names = [y.partition("=")[0].strip()] if y else columns
    return Trial(
        measured=measured, function=calibrated_job, y=y, x=x, spread=spread, values=job.values, gather="numbers",
        slopes={"slopes": [drives, names]},
    )  # fmt: skip


def free_parameters(texts: Iterable[str], priors: Iterable[str], job: JobFile) -> tuple[Parameter, ...]:
    """Read free keys such as ``"materials.body.C10=0.1 MPa:0.05 MPa:0.3 MPa"`` and their priors.

    Parameters
    ----------
    texts : iterable of str
        ``KEY``, ``KEY=START``, ``KEY:LOWER:UPPER`` or ``KEY=START:LOWER:UPPER``. Several keys with commas between them
        have one value. The value of the job is the start by default.
    priors : iterable of str
        ``KEY=MEAN+-DEVIATION``; the deviation may be in percent.
    job : JobFile

    Returns
    -------
    tuple of Parameter

    Raises
    ------
    TurgorError
        If a key is unknown or a value cannot be read.
    """
    found = [_parameter(text, job) for text in texts]
    known = {each.name: each for each in found}
    read = {}
    for text in priors:
        keys, sign, value = (part.strip() for part in text.partition("="))
        if not sign:
            raise TurgorError(
                f"--prior is '{text}'; write KEY=MEAN+-DEVIATION, such as materials.body.C10='0.1 MPa +- 5 %'."
            )
        name = keys_of(keys, job, "--prior")
        if name not in known:
            raise unknown("parameter with a prior", name, known)
        read[name] = mean_and_deviation(value, find_number(job.numbers, name.split(",")[0]), f"--prior {keys}")
    return with_prior(found, read)


def mean_and_deviation(text: str, number: JobNumber, where: str) -> tuple[float, float]:
    """Read ``"0.12 MPa +- 5 %"``; without a mean it is the number of the job.

    Parameters
    ----------
    text : str
    number : JobNumber
        Whose unit the value has.
    where : str
        Beginning of messages.

    Returns
    -------
    (float, float) [SI]

    Raises
    ------
    TurgorError
        If it cannot be read.
    """
    first, sign, second = text.replace("±", "+-").partition("+-")
    mean, deviation = (first, second) if sign else ("", first)
    middle = read_number(mean, number, where) if mean.strip() else number.value
    if deviation.strip().endswith("%"):
        try:
            return middle, abs(middle) * float(deviation.strip().removesuffix("%")) / 100
        except ValueError:
            raise TurgorError(f"{where}: '{deviation.strip()}' is no share in percent; write it as '5 %'.") from None
    return middle, read_number(deviation, number, where)


def left_as_they_are(parameters: Sequence[Parameter], job: JobFile) -> tuple[str, ...]:
    """Say which regions have the same constant as a free one, but keep it.

    Parameters
    ----------
    parameters : sequence of Parameter
    job : JobFile

    Returns
    -------
    tuple of str
    """
    free = {key for each in parameters for key in each.name.split(",")}
    notes = []
    for key in sorted(free):
        parts = key.split(".")
        if parts[0] != "materials" or key not in job.numbers:
            continue
        alike = [
            other
            for other, number in job.numbers.items()
            if other not in free
            and other.startswith("materials.")
            and other.split(".")[2:] == parts[2:]
            and number.value == job.numbers[key].value
        ]
        for other in alike:
            notes.append(f"{other} has the same value and stays as it is; to free both, write --free {key},{other}")
    return tuple(notes)


def _parameter(text: str, job: JobFile) -> Parameter:
    before, sign, after = text.partition("=")
    keys, *limits = [part.strip() for part in (after if sign else before).split(":")]
    start = keys if sign else ""
    name = keys_of(before if sign else keys, job, "--free")
    if len(limits) not in (0, 2):
        raise TurgorError(f"--free is '{text}'; write KEY, KEY=START, or KEY=START:LOWER:UPPER.")
    number = find_number(job.numbers, name.split(",")[0])
    where = f"--free {name}"
    low, high = (read_number(each, number, where) for each in limits) if limits else (None, None)
    return Parameter(
        name=name,
        start=read_number(start, number, where) if start else number.value,
        lower=low,
        upper=high,
        unit=number.unit,
        step=MESHED_STEP if name.startswith("actuator.") else STEP,
    )
