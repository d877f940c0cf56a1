"""The end of a command: what others wait for is done, and no object is taken apart."""

import os
import subprocess
import sys

import pytest

BEGIN = """
import atexit, sys, threading, time
from turgor.cli.start.fast_exit import leave
from turgor.foundation.kernel_cache import POOL
class Told:
    def __del__(self):
        print("taken apart", flush=True)
told = Told()
told.itself = told  # found as Python ends, not before
"""


def ended(script: str) -> subprocess.CompletedProcess:
    """A process that runs a script, whose output goes to a pipe."""
    told = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
    command = [sys.executable, "-c", BEGIN + script]
    return subprocess.run(command, capture_output=True, text=True, timeout=60, env=told)


@pytest.mark.parametrize("code", [0, 1, 3])
def test_code_output_and_what_is_registered_are_kept(code):
    run = ended(
        f"atexit.register(print, 'first registered')\natexit.register(print, 'then this')\n"
        f"sys.stdout.write('no end of line ')\nsys.stderr.write('a warning')\nleave({code})"
    )
    assert run.returncode == code
    assert run.stdout == "no end of line then this\nfirst registered\n"
    assert run.stderr == "a warning"


def test_a_thread_at_work_is_waited_for():
    work = "def work():\n    time.sleep(0.3)\n    print('worked')\nthreading.Thread(target=work).start()\nleave(2)"
    run = ended(work)
    assert run.returncode == 2
    assert run.stdout.splitlines()[0] == "worked"


def test_threads_that_wait_for_the_next_loop_are_not():
    pool = "from concurrent.futures import ThreadPoolExecutor\npool = ThreadPoolExecutor(2, thread_name_prefix=POOL)\n"
    run = ended(f"{pool}print(list(pool.map(abs, [-1, -2])))\nleave(0)")
    assert (run.returncode, run.stdout) == (0, "[1, 2]\n")


def test_output_that_nobody_reads_ends_as_python_does():
    script = "import os\nread, write = os.pipe()\nos.dup2(write, 1)\nos.close(read)\nos.close(write)\n"
    run = ended(f"{script}sys.stdout.write('lost')\nleave(0)")
    assert run.returncode == 120
    assert "BrokenPipeError" in run.stderr


@pytest.mark.parametrize("module", ["turgor", "turgor.cli"])
def test_the_command_ends_with_its_code(module):
    command = [sys.executable, "-m", module]
    assert subprocess.run([*command, "--version"], capture_output=True).returncode == 0
    assert subprocess.run([*command, "rum"], capture_output=True).returncode == 1
