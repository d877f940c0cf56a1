"""Results of commands on models, for programs: the content of ``result`` in the JSON document, and how it is built."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from turgor.accuracy.laboratory.compare import Comparison
    from turgor.core.meshing.mesh import Mesh
    from turgor.core.results.convergence.study import Convergence
    from turgor.core.solvers.buckling.buckling_modes import BucklingModes
    from turgor.core.solvers.dynamics.modes import Modes
    from turgor.fast_models.section.solution import SectionSolution
    from turgor.foundation.response import Response
    from turgor.job.output.outcome import RunOutcome


@dataclass(frozen=True, slots=True, kw_only=True)
class RunResult:
    """``turgor run``: how the solve ended, and the response.

    Parameters
    ----------
    name : str
        Name of the job.
    status : str
        ``"converged"``, or why the path ended early.
    message, advice : str
        What happened, and what to do.
    columns : list of tables
        The response: ``name``, ``unit`` and ``values`` in this unit, one for each state; the drive comes first.
    folder : str
        Folder of the results.
    files : list of str
        Files in it, the most important first.
    """

    name: str
    status: str
    message: str
    advice: str
    columns: list[dict[str, Any]]
    folder: Path
    files: Sequence[Path]


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckResult:
    """``turgor check``: what the job is.

    Parameters
    ----------
    name : str
        Name of the job.
    mesh : str
        What is meshed.
    cells, unknowns : int
        Their numbers.
    expected_s : float or null
        Expected time of a run after meshing [s]; null for a motion, whose first run shows it.
    expected_bytes : float
        Expected memory of a run.
    contact : list of str
        What touches what, in sentences.
    stages : table
        What each stage changes, by its name; empty without stages.
    """

    name: str
    mesh: str
    cells: int
    unknowns: int
    expected_s: float | None
    expected_bytes: float
    contact: Sequence[str]
    stages: Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshResult:
    """``turgor mesh``: counts, sizes and shapes.

    Parameters
    ----------
    name : str
        What is meshed.
    cell_type : str
        Kind of the cells.
    cells, points, unknowns : int
        Their numbers.
    min_edge_m, mean_edge_m, max_edge_m : float
        Lengths of edges [m].
    min_shape, mean_shape : float
        Shape of the cells: 1 is regular, 0 is flat.
    min_jacobian_ratio : float
        Jacobian ratio of the worst curved cell: 1 is straight.
    regions, faces : table
        Number of cells, and of sides of cells, by name.
    """

    name: str
    cell_type: str
    cells: int
    points: int
    unknowns: int
    min_edge_m: float
    mean_edge_m: float
    max_edge_m: float
    min_shape: float
    mean_shape: float
    min_jacobian_ratio: float
    regions: Mapping[str, int]
    faces: Mapping[str, int]


@dataclass(frozen=True, slots=True, kw_only=True)
class ModesResult:
    """``turgor modes``: natural frequencies.

    Parameters
    ----------
    load_factor : float
        Load factor of the state about which the actuator vibrates; 0 is at rest.
    frequencies_Hz, modal_masses_kg : list of float
        Frequency and modal mass of each mode, from the lowest.
    message : str
        What is to be known about them.
    """

    load_factor: float
    frequencies_Hz: Any
    modal_masses_kg: Any
    message: str


@dataclass(frozen=True, slots=True, kw_only=True)
class BucklingResult:
    """``turgor buckling``: loads at which the actuator buckles.

    Parameters
    ----------
    load_factor : float
        Load factor of the state that the modes are computed at; 0 is at rest.
    load_factors : list of float
        Load factor of each mode, from the lowest.
    message : str
        What is to be known about them.
    """

    load_factor: float
    load_factors: Any
    message: str


@dataclass(frozen=True, slots=True, kw_only=True)
class ComparedResult:
    """``turgor compare``: how far a run is from an experiment, in SI units.

    Parameters
    ----------
    x, y : str
        Columns of the run that were compared.
    rows : int
        Number of measured rows within the computed range.
    rms, largest, largest_at, relative, shift, rms_shifted, offset, drift : float
        As in `turgor.experiments.Comparison`.
    loop : table or null
        ``loading``, ``unloading`` and ``width``, where the measured drive turns.
    notes : list of str
        What was left out or assumed.
    files : list of str
        Files that were written.
    """

    x: str
    y: str
    rows: int
    rms: float
    largest: float
    largest_at: float
    relative: float
    shift: float
    rms_shifted: float
    offset: float
    drift: float
    loop: dict[str, float] | None
    notes: Sequence[str]
    files: Sequence[Path]


@dataclass(frozen=True, slots=True, kw_only=True)
class ConvergenceResult:
    """``turgor convergence``: a measure on finer and finer meshes.

    Parameters
    ----------
    measure : str
        Name of the measure.
    columns : list of tables
        ``name``, ``unit`` and ``values`` in this unit, one for each mesh, the coarsest first.
    summary : str
        Extrapolated value, error and observed order.
    folder : str
        Folder of table and plot.
    """

    measure: str
    columns: list[dict[str, Any]]
    summary: str
    folder: Path


@dataclass(frozen=True, slots=True, kw_only=True)
class SectionResult:
    """``turgor section``: the section of the actuator against pressure.

    Parameters
    ----------
    name : str
        Name of the job.
    status, message : str
        ``"converged"``, or why the path ended early, and what may help.
    columns : list of tables
        ``name``, ``unit`` and ``values`` in this unit, one for each state.
    stable : list of bool
        Whether each state is stable.
    folder : str
        Folder of table and plot.
    """

    name: str
    status: str
    message: str
    columns: list[dict[str, Any]]
    stable: Sequence[bool]
    folder: Path


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportResult:
    """``turgor export``: what was written.

    Parameters
    ----------
    files : list of str
        The files.
    errors : list of str
        What is known of the error of each, of a reduced model.
    notes : list of str
        What became of each part of a job in its .inp file.
    """

    files: Sequence[Path]
    errors: Sequence[str] = ()
    notes: Sequence[str] = ()


def run_result(outcome: "RunOutcome") -> RunResult:
    """Make the result of a run."""
    return RunResult(
        name=outcome.job.name,
        status=str(outcome.solution.status),
        message=outcome.solution.message,
        advice=outcome.solution.advice,
        columns=columns_of(outcome.response),
        folder=outcome.folder,
        files=[file.relative_to(outcome.folder) for file in outcome.files],
    )


def columns_of(response: "Response") -> list[dict[str, Any]]:
    """List the columns of a response."""
    return [{"name": each.name, "unit": each.unit, "values": each.in_unit} for each in response.columns]


def mesh_result(mesh: "Mesh") -> MeshResult:
    """Make the result on a mesh."""
    from turgor.core.meshing.quality.cell_quality import quality

    measured = quality(mesh)
    return MeshResult(
        name=mesh.name,
        cell_type=mesh.cell_type.name,
        cells=measured.cells,
        points=measured.points,
        unknowns=measured.unknowns,
        min_edge_m=measured.min_edge,
        mean_edge_m=measured.mean_edge,
        max_edge_m=measured.max_edge,
        min_shape=measured.min_shape,
        mean_shape=measured.mean_shape,
        min_jacobian_ratio=measured.min_jacobian_ratio,
        regions={name: len(cells) for name, cells in mesh.regions.items()},
        faces={name: len(sides) for name, sides in mesh.faces.items()},
    )


def modes_result(modes: "Modes") -> ModesResult:
    """Make the result on natural frequencies."""
    return ModesResult(
        load_factor=modes.load_factor,
        frequencies_Hz=modes.frequencies,
        modal_masses_kg=modes.modal_mass,
        message=modes.message,
    )


def buckling_result(modes: "BucklingModes") -> BucklingResult:
    """Make the result on buckling."""
    return BucklingResult(load_factor=modes.load_factor, load_factors=modes.load_factors, message=modes.message)


def compared_result(comparison: "Comparison", files: Sequence[Path]) -> ComparedResult:
    """Return the numbers of a comparison.

    Parameters
    ----------
    comparison : Comparison
    files : sequence of Path
    """
    return ComparedResult(
        x=comparison.x, y=comparison.y, rows=len(comparison.rows), rms=comparison.rms, largest=comparison.largest,
        largest_at=comparison.largest_at, relative=comparison.relative, shift=comparison.shift,
        rms_shifted=comparison.rms_shifted, offset=comparison.offset, drift=comparison.drift,
        loop=None if comparison.loop is None else asdict(comparison.loop), notes=comparison.notes, files=files,
    )  # fmt: skip


def convergence_result(study: "Convergence", folder: Path) -> ConvergenceResult:
    """Make the result of a convergence study."""
    columns = columns_of(study.response)
    return ConvergenceResult(measure=study.measure.name, columns=columns, summary=study.summary, folder=folder)


def section_result(name: str, solution: "SectionSolution", folder: Path) -> SectionResult:
    """Make the result of a section analysis."""
    response = solution.response
    return SectionResult(
        name=name,
        status=response.status,
        message=response.message,
        columns=columns_of(response),
        stable=solution.stable,
        folder=folder,
    )
