"""Checks before a solve run once in a run of a job, and once in a solve of a script."""

import pytest
from test_job_early import JOB

import turgor as tg
from turgor.core.solvers.checks import early_findings as checks
from turgor.foundation.finding import FindingWarning
from turgor.job.prepare import prepare
from turgor.job.read import read_job
from turgor.job.run import run_job

COUNTED = ("constants_in_doubt", "check_supports", "check_contact")


@pytest.fixture
def counts(monkeypatch):
    """How often each of some checks runs."""
    calls = dict.fromkeys(COUNTED, 0)

    def counted(name, check):
        def call(*given, **named):
            calls[name] += 1
            return check(*given, **named)

        return call

    for name in COUNTED:
        monkeypatch.setattr(checks, name, counted(name, getattr(checks, name)))
    return calls


@pytest.fixture
def job(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "finger.toml").write_text(JOB, encoding="utf-8")
    return read_job(tmp_path / "finger.toml", {"loads.pressure": "0.1 kPa"})


def test_a_run_checks_its_model_once(job, counts):
    outcome = run_job(job)
    assert counts == dict.fromkeys(COUNTED, 1)
    assert "M06" in [each.code for each in outcome.solution.findings]


def test_a_solve_checks_its_model_once(job, counts):
    model = prepare(job)[0]
    counts.update(dict.fromkeys(COUNTED, 0))
    with pytest.warns(FindingWarning, match="M06"):
        tg.solve(model, job.procedure, progress=False)
    assert counts == dict.fromkeys(COUNTED, 1)
