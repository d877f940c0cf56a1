"""Two users on one machine: what one of them planted does not run for the other, and both get their results."""

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from zipfile import ZipFile

import numba
import pytest

from turgor.foundation.startup import kernel_folder as loops

#: The user who makes folders first, and the user who comes later.
FIRST, LATER = 4321, 1234

SOURCES = Path(loops.__file__).parents[3]

#: Lets a user read, but not write, what is behind folders of root, such as an interpreter in ``/root``.
READS_ALL = ("setpriv", "--reuid={0}", "--regid={0}", "--clear-groups", "--inh-caps=+dac_read_search",
             "--ambient-caps=+dac_read_search")  # fmt: skip

JOB = """
[actuator]
type = "extending_cylinder"
length = "20 mm"

[mesh]
size = "7 mm"
cells = "hexahedra"

[materials]
body = { name = "rubber", law = "neo_hooke", C10 = "0.1 MPa" }

[loads]
pressure = "2 kPa"

[procedure]
type = "static"
first_step = 0.5
max_step = 0.5

[output]
measures = ["tip_displacement"]
fields = false
pictures = false
report = false
mesh_error = false
"""

#: Compiles a small loop, then shows where compiled loops are.
COMPILE = """
from turgor.core.engine.warmup.cell_kernels import compile_pattern
compile_pattern()
from turgor.foundation.startup.kernel_folder import folder
print(folder())
"""

#: Uses folders without looking at owners and modes, as a program without care would.
CARELESS = """
from turgor.foundation.startup import kernel_folder as loops
loops.caches.private = loops.writable
"""

#: Replaces all compiled loops below a folder by what makes a file where it is loaded.
PLANT = """
import os, pathlib, pickle, sys
class Evil:
    def __reduce__(self):
        return os.mkdir, (sys.argv[2],)
for file in pathlib.Path(sys.argv[1]).rglob("*.nb[ic]"):
    file.write_bytes(pickle.dumps(Evil()))
for file in [pathlib.Path(sys.argv[1]), *pathlib.Path(sys.argv[1]).rglob("*")]:
    file.chmod(0o777)
"""


@dataclass(frozen=True)
class Machine:
    """A folder for temporary files that all may write, and homes that nobody may write."""

    place: Path
    prefix: tuple[str, ...] | None

    @property
    def shared(self) -> Path:
        return self.place / "shared"

    def user(self, uid: int, *arguments: str, **variables: str) -> subprocess.Popen[str]:
        """Start Python as a user."""
        environment = {name: each for name, each in os.environ.items() if not name.startswith(("TURGOR", "XDG"))}
        environment |= {
            "HOME": str(self.place / "home"), "TMPDIR": str(self.place / "tmp"), "NUMBA_CACHE_DIR": "",
            "NUMBA_NUM_THREADS": "1", "MPLCONFIGDIR": str(self.place / "tmp"),
            "PYTHONPATH": os.pathsep.join([str(SOURCES), str(Path(numba.__file__).parents[1])]),
        }  # fmt: skip
        who = {"user": uid, "group": uid, "extra_groups": []} if self.prefix is None else {}
        command = [*(each.format(uid) for each in self.prefix or ()), sys.executable, *arguments]
        streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
        return subprocess.Popen(command, cwd=self.shared, env=environment | variables, **streams, **who)

    def done(self, uid: int, *arguments: str, **variables: str) -> subprocess.CompletedProcess[str]:
        """Run Python as a user to its end."""
        with self.user(uid, *arguments, **variables) as process:
            said, complaints = process.communicate(timeout=200)
        return subprocess.CompletedProcess(arguments, process.returncode, said, complaints)


def who_can_start(place: Path) -> Machine:
    """Return a machine on which other users can start Python and import turgor."""
    for prefix in (None, READS_ALL):
        machine = Machine(place, prefix)
        try:
            if machine.done(FIRST, "-c", "import numpy, turgor").returncode == 0:
                return machine
        except OSError:  # they may not read the interpreter, or there is no setpriv
            continue
    pytest.skip("other users can neither start this Python nor import turgor")


@pytest.fixture(scope="module")
def machine() -> Iterator[Machine]:
    if not hasattr(os, "getuid") or os.getuid() != 0:
        pytest.skip("only root can start processes of other users")
    place = Path(tempfile.mkdtemp(prefix="turgor-users-"))
    try:
        for name, mode in (("", 0o755), ("home", 0o755), ("tmp", 0o1777), ("shared", 0o1777)):
            (place / name).mkdir(exist_ok=True)
            (place / name).chmod(mode)
        yield who_can_start(place)
    finally:
        shutil.rmtree(place)


@pytest.fixture
def compiled(machine: Machine) -> Iterator[Callable[[int, Path], None]]:
    """Give a user the loops that the tests have compiled, which saves half a minute."""
    (machine.place / "job.toml").write_text(JOB, encoding="utf-8")
    source = Path(os.environ["NUMBA_CACHE_DIR"])
    command = [sys.executable, "-m", "turgor", "run", str(machine.place / "job.toml"), "--output"]
    if not (machine.place / "warm").exists():
        subprocess.run([*command, str(machine.place / "warm")], check=True, capture_output=True, timeout=200)

    def give(uid: int, target: Path) -> None:
        shutil.copytree(source, target)
        for each in [target, *target.rglob("*")]:
            os.chown(each, uid, uid)
        target.chmod(0o700)

    yield give
    for each in [*machine.shared.iterdir(), *(machine.place / "tmp").glob("turgor*")]:
        shutil.rmtree(each)


def test_planted_loops_do_not_run(machine):
    """The first user makes the folder whose name can be predicted, with loops that the later one would load."""
    planted, ran = machine.place / "tmp" / f"turgor-compiled-{LATER}", machine.place / "tmp" / "ran"
    assert machine.done(FIRST, "-c", COMPILE, NUMBA_CACHE_DIR=str(planted)).returncode == 0
    assert machine.done(FIRST, "-c", PLANT, str(planted), str(ran)).returncode == 0
    files = {file: file.read_bytes() for file in planted.rglob("*.nb[ic]")}
    assert len(files) > 5
    safe = machine.done(LATER, "-c", COMPILE)
    assert safe.returncode == 0, safe.stderr
    assert not ran.exists()
    used = Path(safe.stdout.strip())
    assert used != planted
    assert (used.stat().st_uid, used.stat().st_mode & 0o777) == (LATER, 0o700)
    assert "compiled code goes to" in safe.stderr
    assert {file: file.read_bytes() for file in planted.rglob("*.nb[ic]")} == files
    machine.done(LATER, "-c", CARELESS + COMPILE)
    assert ran.exists(), "what was planted does not run even where nothing is checked, so this test shows nothing"
    shutil.rmtree(planted)


def run_of(machine: Machine, uid: int, *more: str) -> tuple[str, ...]:
    """Arguments of the tiny job in a folder of the user, which exists."""
    folder = machine.shared / f"of-{uid}"
    folder.mkdir(exist_ok=True)
    os.chown(folder, uid, uid)
    return ("-m", "turgor", "run", str(machine.place / "job.toml"), "--output", str(folder / "out"), "--quiet", *more)


def falsified(law: Path) -> None:
    """Write another derivative into an entry of the cache, one that can be read."""
    with ZipFile(law) as archive:
        members = {name: archive.read(name).replace(b"Mul", b"Add") for name in archive.namelist()}
    with ZipFile(law, "w") as archive:
        for name, content in members.items():
            archive.writestr(name, content)


def test_a_shared_cache_of_another_user_is_not_read(machine, compiled):
    cache, ran = machine.shared / "cache", machine.shared / "ran"
    cache.mkdir()
    os.chown(cache, FIRST, FIRST)
    compiled(FIRST, cache / "compiled")
    done = machine.done(FIRST, *run_of(machine, FIRST), TURGOR_CACHE=str(cache))
    assert done.returncode == 0, done.stderr
    for law in (cache / "laws").iterdir():
        falsified(law)
    assert machine.done(FIRST, "-c", PLANT, str(cache), str(ran)).returncode == 0
    before = {file: file.read_bytes() for file in cache.rglob("*") if file.is_file()}
    assert {file.relative_to(cache).parts[0] for file in before} == {"compiled", "families", "laws", "runs"}
    compiled(LATER, machine.place / "tmp" / f"turgor-compiled-{LATER}")
    done = machine.done(LATER, *run_of(machine, LATER), TURGOR_CACHE=str(cache))
    assert done.returncode == 0, done.stderr
    assert "cache' cannot be written by this user alone" in done.stderr
    assert not ran.exists()
    assert {file: file.read_bytes() for file in cache.rglob("*") if file.is_file()} == before
    first, later = (machine.shared / f"of-{uid}" / "out" / "response.csv" for uid in (FIRST, LATER))
    assert later.read_bytes() == first.read_bytes()


def test_two_users_run_at_once_with_one_cache(machine, compiled):
    cache = machine.shared / "both"
    cache.mkdir()
    cache.chmod(0o1777)
    compiled(FIRST, cache / "compiled")
    compiled(LATER, machine.place / "tmp" / f"turgor-compiled-{LATER}")
    started = [machine.user(uid, *run_of(machine, uid), TURGOR_CACHE=str(cache)) for uid in (FIRST, LATER)]
    for process in started:
        _, complaints = process.communicate(timeout=200)
        assert process.returncode == 0, complaints
    responses = {(machine.shared / f"of-{uid}" / "out" / "response.csv").read_bytes() for uid in (FIRST, LATER)}
    assert len(responses) == 1
    for part in cache.iterdir():
        assert part.stat().st_mode & 0o777 == 0o700
        owners = {each.stat().st_uid for each in (part, *part.rglob("*"))}
        assert len(owners) == 1, f"two users wrote into {part}"


def test_a_run_of_another_user_is_not_touched(machine, compiled):
    for uid in (FIRST, LATER):
        compiled(uid, machine.place / "tmp" / f"turgor-compiled-{uid}")
    assert machine.done(FIRST, *run_of(machine, FIRST)).returncode == 0
    folder = machine.shared / f"of-{FIRST}" / "out"
    before = {file: file.read_bytes() for file in folder.rglob("*") if file.is_file()}
    for arguments in (("run", str(machine.place / "job.toml"), "--force", "--output"), ("report",)):
        done = machine.done(LATER, "-m", "turgor", *arguments, str(folder))
        assert done.returncode == 1
        assert done.stderr.splitlines()[-1].endswith("written: Permission denied.")
        assert "Traceback" not in done.stderr
    assert {file: file.read_bytes() for file in folder.rglob("*") if file.is_file()} == before
