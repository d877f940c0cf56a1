"""Commands that are killed (SIGKILL) at random moments, also as they go on, end as if nothing had happened.

``TURGOR_KILLS=200 python -m pytest tests/kills -m slow`` kills 200 times: at random times, and before random operations
on the files of the results. The chains of kills are reproducible but for the times, which depend on the machine.
"""

import logging
import os
import random

import pytest
from kill_cases import CASES, Case
from killing import Bench, chain

KILLS = int(os.environ.get("TURGOR_KILLS", "50"))
SHARES = sum(case.share for case in CASES.values())

pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")


@pytest.fixture(scope="module")
def bench(tmp_path_factory):
    return Bench(tmp_path_factory.mktemp("kills"))


def test_a_killed_run_ends_equal(bench):
    """Two kills; the slow test below has fifty, in eight commands."""
    chain(bench, "run", CASES["run"], random.Random("few 1"))


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_killed_at_any_moment_commands_end_equal(name, bench):
    case: Case = CASES[name]
    count = chains = 0
    failed = []
    while count < KILLS * case.share / SHARES:
        chains += 1
        chance = random.Random(f"{name} {chains}")
        try:
            kills = chain(bench, name, case, chance)
        except AssertionError as problem:
            failed.append(f"chain {chains}: {problem}")
            count += 1
            logging.info("%s, chain %d failed: %s", name, chains, problem)
            continue
        count += len(kills)
        moments = [f"{100 * share:.0f} %{' of files' if each.operation else ''} {each.whom}" for each, share in kills]
        logging.info("%s, chain %d: %s", name, chains, ", ".join(moments) or "no kill")
    logging.info("%s: %d kills in %d chains, %d failed", name, count, chains, len(failed))
    assert not failed
