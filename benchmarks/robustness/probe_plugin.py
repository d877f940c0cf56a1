"""Probes in place of chosen numbers: which of them decide anything in tests, at half and at double their value.

    python -m pytest -p benchmarks.robustness.probe_plugin tests/unit/core/meshing --probed core.meshing [--probed ...]
    python -m pytest -p benchmarks.robustness.probe_plugin FILE --changed core.meshing.grading.SMALL=0

The first run puts probes in place of all numbers in upper case and of all fields of settings in these modules, and
prints a table. A probe is a number that also knows half and double its value. Where it is compared, or a result of it,
it notes whether half or double would decide otherwise. Where it leaves the reach of probes, as in arrays, counts of
loops and digits, it notes that it was used as a number. Kernels compile numbers as constants: those are only listed.
A test that fails because of a probe (of its type, in a file) passes with `--unprobed core.meshing.grading.SMALL`. The
second run replaces a number, such as by what removing it means; for a compiled one set NUMBA_CACHE_DIR to an empty
folder. Processes that a test starts have the numbers unchanged.
"""

from typing import Any

from benchmarks.robustness.probed_source import PLAN, install
from benchmarks.robustness.probes import NOTES, Probe


def let_numba_take_probes() -> None:
    """Let kernels take a probe as an argument, as the number that it is."""
    from numba import types
    from numba.extending import typeof_impl

    @typeof_impl.register(Probe)
    def _typeof(probe: Probe, _context: object) -> types.Type:
        return types.int64 if isinstance(probe.value, int) else types.float64


def line(name: str, value: Any, width: int) -> str:
    """One line of the table."""
    marks = NOTES.marks[name]
    used = len(marks.get("used", set()) | marks.get("number", set()))
    half, double = len(marks.get("half", ())), len(marks.get("double", ()))
    note = "used as a number" if marks.get("number") else "" if used else "not used"
    note = "compiled" if name in PLAN.compiled else "no probe" if name in PLAN.unprobed else note
    note = "changed" if name in PLAN.changed else note
    return f"{name:{width}} {value:<12.6g} {used:6} {half:6} {double:6}  {note}"


def pytest_addoption(parser: Any) -> None:
    """Add the options of the plugin."""
    parser.addoption("--probed", action="append", default=[], help="module or folder of turgor, as core.meshing")
    parser.addoption("--unprobed", action="append", default=[], help="number of these that gets no probe")
    parser.addoption("--changed", action="append", default=[], help="another value, as core.meshing.grading.SMALL=0")


def pytest_load_initial_conftests(early_config: Any) -> None:
    """Install the probes before a test imports turgor."""
    options = early_config.known_args_namespace
    install(options.probed, options.unprobed, options.changed)


def pytest_configure() -> None:
    """Prepare numba, whose folder of kernels is known now."""
    let_numba_take_probes()


def pytest_runtest_logstart(nodeid: str) -> None:
    """Name the case for the notes."""
    NOTES.case = nodeid


def pytest_terminal_summary(terminalreporter: Any) -> None:
    """Print the table: numbers that decide nothing first."""
    width = max(map(len, PLAN.values), default=8)
    heads = f"{'number':{width}} {'value':12} {'used':>6} {'half':>6} {'double':>6}  in so many tests"
    marks = NOTES.marks
    order = sorted(PLAN.values, key=lambda name: (bool(marks[name]["half"] or marks[name]["double"]), name))
    terminalreporter.write_line("\n".join([heads, *(line(name, PLAN.values[name], width) for name in order)]))
