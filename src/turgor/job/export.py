"""Export of the actuator of a job: files for other programs and for manufacturing."""

from collections.abc import Collection
from dataclasses import dataclass, replace
from pathlib import Path

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.molds.casting_mold import casting_mold
from turgor.core.geometry.molds.mold import Mold, MoldSettings
from turgor.core.geometry.write_step import write_step
from turgor.core.inp.account import APPROXIMATED, InpNote
from turgor.core.inp.write_inp import PROGRAMS, compressible, inp_file
from turgor.core.materials.material import Material
from turgor.core.meshing.exchange.formats.write_stl import write_stl
from turgor.core.meshing.exchange.mesh_file import MeshedShape
from turgor.core.meshing.mesh import Mesh
from turgor.core.setups.with_setup import with_setup
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.finding import Finding
from turgor.job.job import Job
from turgor.job.meshes import mesh_of
from turgor.job.output.exported_keys import key_notes
from turgor.job.prepare import model_of

#: Kinds of export.
KINDS = ("inp", "step", "stl", "mold")


@dataclass(frozen=True, slots=True, kw_only=True)
class InpOptions:
    """Options of the .inp file of an export.

    Parameters
    ----------
    program : str
        ``"calculix"`` or ``"abaqus"``.
    poisson : float or None [-]
        Poisson's ratio of incompressible materials at rest, which CalculiX needs; None leaves them incompressible.
    """

    program: str = "calculix"
    poisson: float | None = None

    def __post_init__(self) -> None:
        if self.program not in PROGRAMS:
            raise unknown("program", self.program, PROGRAMS)


@dataclass(frozen=True, slots=True, kw_only=True)
class Exported:
    """What was written.

    Parameters
    ----------
    files : tuple of Path
    notes : tuple of InpNote
        What became of each part of the job in the .inp file.
    findings : tuple of Finding
        Of the mold: D09 where its draft leaves a thin wall.
    """

    files: tuple[Path, ...]
    notes: tuple[InpNote, ...] = ()
    findings: tuple[Finding, ...] = ()


def export_job(
    job: Job,
    folder: str | Path,
    kinds: Collection[str],
    *,
    inp: InpOptions | None = None,
    mold: MoldSettings | None = None,
    force: bool = False,
) -> Exported:
    """Write the actuator of a job as files of other programs.

    Parameters
    ----------
    job : Job
        Usually from `turgor.job.read.read_job`.
    folder : str or Path
        Output folder; created if it does not exist.
    kinds : collection of str
        ``"inp"``: the model for CalculiX or Abaqus. ``"step"``: the geometry. ``"stl"``: the whole body and each of
        its cavities, cut from the mesh of the job. ``"mold"``: the parts of a casting mold, STEP and STL, how it opens,
        as text, and with a draft the part that is cast, as STEP.
    inp : InpOptions, optional
        Options of the .inp file.
    mold : MoldSettings, optional
        Dimensions of the mold.
    force : bool
        Whether existing files are replaced.

    Returns
    -------
    Exported

    Raises
    ------
    TurgorError
        If the model cannot be expressed in the file format, or a file exists already.
    """
    for kind in kinds:
        if kind not in KINDS:
            raise unknown("kind of export", kind, KINDS)
    place, notes = Path(folder), tuple[InpNote, ...]()
    geometry = job.geometry()
    mesh = mesh_of(job, geometry) if {"inp", "stl"} & set(kinds) else None
    parts = casting_mold(job.actuator, mold) if "mold" in kinds else None
    names = _names(job, geometry, mesh, kinds, parts)
    taken = [name for name in names if (place / name).exists()]
    if taken and not force:
        raise TurgorError(
            f"'{place / taken[0]}' is there already.",
            python="Choose another folder, or replace it with force=True.",
            command="Choose another folder with --output, or replace it with --force.",
        )
    place.mkdir(parents=True, exist_ok=True)
    if mesh is not None and "inp" in kinds:
        notes = _write_model(job, mesh, place / f"{job.name}.inp", inp or InpOptions())
    if "step" in kinds:
        write_step(geometry, place / f"{job.name}.step")
    if mesh is not None and "stl" in kinds:
        write_stl(mesh, place / f"{job.name}.stl")
        for cavity in mesh.cavities:
            write_stl(mesh, place / f"{job.name}-{cavity}.stl", face=cavity)
    if parts is not None:
        _write_mold(parts, place, f"{job.name}-mold")
    findings = parts.findings if parts is not None else ()
    return Exported(files=tuple(place / name for name in names), notes=notes, findings=findings)


def _names(job: Job, geometry: Geometry, mesh: Mesh | None, kinds: Collection[str], mold: Mold | None) -> list[str]:
    """Names of the files; an error if one of them cannot be written, before any is."""
    names = [f"{job.name}.inp"] if "inp" in kinds else []
    if "step" in kinds:
        if isinstance(geometry.shape, MeshedShape):
            raise TurgorError("the actuator is a mesh, which has no form in STEP files; export it as stl.")
        names.append(f"{job.name}.step")
    if mesh is not None and "stl" in kinds:
        names += [f"{job.name}.stl", *(f"{job.name}-{cavity}.stl" for cavity in mesh.cavities)]
    if mold is not None:
        names += [f"{job.name}-mold-{part}.{ending}" for part in mold.parts for ending in ("step", "stl")]
        names += [f"{job.name}-mold-casting.step"] if mold.casting is not None else []
        names += [f"{job.name}-mold.txt"]
    return names


def _write_model(job: Job, mesh: Mesh, path: Path, options: InpOptions) -> tuple[InpNote, ...]:
    model = with_setup(model_of(job, mesh), job.setup)  # the plate that blocks the tip is part of the model
    if options.poisson is not None:
        model = compressible(model, options.poisson)
    file = inp_file(model, job.procedure, program=options.program)
    if options.poisson is not None:
        text = f"Poisson's ratio {options.poisson:g} at rest instead of a volume that stays"
        changed = [name for name, each in job.materials.items() if isinstance(each, Material) and each.incompressible]
        own = tuple(InpNote(f"materials.{name}.bulk_modulus", APPROXIMATED, text) for name in changed)
        file = replace(file, notes=(*file.notes, *own))
    file = replace(file, notes=(*file.notes, *key_notes(job, file.notes)))
    file.write(path)
    return file.notes


def _write_mold(mold: Mold, folder: Path, name: str) -> None:
    for each, part in mold.parts.items():
        write_step(part, folder / f"{name}-{each}.step")
        write_stl(part, folder / f"{name}-{each}.stl")
    if mold.casting is not None:
        write_step(mold.casting, folder / f"{name}-casting.step")
    (folder / f"{name}.txt").write_text("\n".join(mold.notes) + "\n", encoding="utf-8")
