"""Output of compiled code is caught while it lasts and the terminal is given back afterwards."""

import os
import signal
import subprocess
import sys

import pytest

from turgor.core.meshing.silenced_output import captured_output


def test_output_is_caught_and_the_terminal_given_back(capfd: pytest.CaptureFixture[str]) -> None:
    os.write(1, b"before ")
    with captured_output() as text:
        os.write(1, b"one ")
        os.write(2, b"two")
        assert text() == "one two"
    os.write(1, b"after")
    os.write(2, b"and here")
    assert capfd.readouterr() == ("before after", "and here")


def test_an_error_inside_gives_the_terminal_back_too(capfd: pytest.CaptureFixture[str]) -> None:
    def fail() -> None:
        with captured_output():
            os.write(1, b"noise")
            raise KeyError

    with pytest.raises(KeyError):
        fail()
    os.write(1, b"after")
    assert capfd.readouterr().out == "after"


@pytest.mark.skipif(sys.platform == "win32", reason="signals end processes otherwise there")
def test_the_end_of_the_process_is_told_although_output_is_caught() -> None:
    script = (
        "import os\nfrom turgor.core.geometry.silenced_output import captured_output\n"
        "with captured_output():\n    os.abort()\n"
    )
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(path for path in sys.path if path)}
    done = subprocess.run([sys.executable, "-c", script], env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == -signal.SIGABRT
    assert done.stderr.startswith("Fatal Python error: Aborted")
