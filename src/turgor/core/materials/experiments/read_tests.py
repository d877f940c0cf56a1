"""Reading of tests: stretch and nominal stress from the table of a testing machine, without guessing."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from turgor.core.materials.experiments.columns import Column, find_columns, role_of, split_unit
from turgor.core.materials.experiments.cycles import without_way_back
from turgor.core.materials.experiments.header_sizes import Sizes, known_specimen, sizes_of
from turgor.core.materials.experiments.material_test import MODES, Edit, MaterialTest
from turgor.core.materials.experiments.quantities import (
    crosshead_quantity,
    second_stress,
    stress_quantity,
    stretch_quantity,
)
from turgor.core.materials.experiments.row_values import along_second, time_of
from turgor.core.materials.experiments.specimen import Specimen
from turgor.core.materials.experiments.table_text import Table, read_table
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.source import Source

#: Words of a file name that state its mode; longer ones come first.
_MODE_WORDS = (
    ("equibiaxial", "equibiaxial"),
    ("equi_biaxial", "equibiaxial"),
    ("simple_shear", "simple_shear"),
    ("pure_shear", "planar"),
    ("planar", "planar"),
    ("biaxial", "biaxial"),
    ("uniaxial", "uniaxial"),
)
_MEASURES = ("nominal", "cauchy")

#: Roles of columns that tell specimens apart.
_LABELS = ("batch", "specimen")


def read_test(
    path: str | Path,
    *,
    mode: str | None = None,
    stress_measure: str | None = None,
    specimen: Specimen | None = None,
    columns: Mapping[str, str] | Sequence[str] | None = None,
    cyclic: bool = False,
) -> MaterialTest:
    r"""Read one test from the table of a testing machine; an error asks for facts that the file does not state.

    Parameters
    ----------
    path : str or Path
        A text file with a header line, split by semicolons, tabs or commas; decimal points or commas.
    mode : str, optional
        One of `MODES`; by default the mode in the name of the file.
    stress_measure : str, optional
        ``"nominal"`` (force per initial area) or ``"cauchy"`` (force per current area), where the file does not say.
        A Cauchy stress is divided by the stretch, which is right for a rubber that keeps its volume.
    specimen : Specimen, optional
        Dimensions of the specimen; needed where the file holds lengths and forces.
    columns : mapping of str to str, or sequence of str, optional
        Column by role, such as ``{"force": "Load cell 2 (N)"}``; or the names of all columns, for a file without names.
    cyclic : bool
        Whether the stretch may reverse; then choose a cycle with `select_cycle`.

    Returns
    -------
    MaterialTest
        Stretch and nominal stress [Pa] in the order of the file.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     file = Path(folder) / "strip_uniaxial.csv"
    ...     _ = file.write_text("stretch;nominal stress (kPa)\n1,0;0\n1,5;81,5\n2,0;140\n")
    ...     read_test(file)
    MaterialTest('strip_uniaxial', uniaxial, 3 points, stretch 1 to 2, nominal stress 0 to 0.14 MPa)
    """
    tests = read_tests(
        path, mode=mode, stress_measure=stress_measure, specimen=specimen, columns=columns, cyclic=cyclic
    )
    if len(tests) > 1:
        names = ", ".join(test.name for test in tests)
        column = _label(read_table(path))
        each = f"fit all of them, and each, with --by '{column}'" if column else "name them in a column 'specimen'"
        raise TurgorError(
            f"'{Path(path).name}' holds {len(tests)} specimens ({names}).",
            python="Read them with read_tests, and average them if they are replicates.",
            command=f"Fit the mean with --average; or {each}.",
        )
    return tests[0]


def read_tests(
    path: str | Path,
    *,
    mode: str | None = None,
    stress_measure: str | None = None,
    specimen: Specimen | None = None,
    columns: Mapping[str, str] | Sequence[str] | None = None,
    cyclic: bool = False,
) -> tuple[MaterialTest, ...]:
    """Read every specimen of a file: by columns 'batch' and 'specimen', or from columns that repeat side by side.

    Parameters
    ----------
    path, mode, stress_measure, specimen, columns, cyclic
        See `read_test`.
    """
    table = read_table(path)
    if isinstance(columns, Sequence):
        table = replace(table, names=tuple(columns))
        if len(columns) != len(table.rows[0]):
            raise TurgorError(f"'{table.file}' has {len(table.rows[0])} columns, and {len(columns)} names were given.")
    if not table.names:
        raise TurgorError(
            f"'{table.file}' has no header line.",
            python="Name its columns in order, for example columns=('stretch', 'nominal_stress_MPa').",
            command="Write one with the names of its columns, for example stretch,nominal_stress_MPa.",
        )
    roles = columns if isinstance(columns, Mapping) else {}
    mode = _mode(table.file, mode, table.names)
    if stress_measure not in (None, *_MEASURES):
        raise unknown("stress_measure", str(stress_measure), _MEASURES)
    tests = []
    by_role = _for_mode(find_columns(table.names, roles, table.file), mode)
    for name, batch, part, known in _specimens(table, by_role):
        test = replace(_test(name, part, known, mode, stress_measure, specimen), batch=batch)
        test = test if cyclic else without_way_back(test)
        turn = test.first_turn()
        if turn is not None and not cyclic:
            raise TurgorError(
                f"'{table.file}': the stretch turns round at row {turn + 1} of the numbers, from "
                f"{test.stretch[turn - 1]:.4g} to {test.stretch[turn]:.4g}. If these are no cycles, correct the row; "
                "if they are,",
                python="read with cyclic=True and choose one with select_cycle.",
                command="choose one with --cycle.",
            )
        tests.append(test)
    return tuple(tests)


def _mode(file: str, mode: str | None, names: Sequence[str]) -> str:
    """The mode that is stated, or that the name of the file or a second stretch implies."""
    if mode is not None:
        if mode == "pure_shear":
            return "planar"
        if mode not in MODES:
            raise unknown("mode", mode, MODES)
        return mode
    words = re.sub(r"[\s-]+", "_", file.lower())
    for word, known in _MODE_WORDS:
        if word in words:
            return known
    if any(role_of(split_unit(name)[0]) in ("component", "cauchy_difference") for name in names):
        return "biaxial"  # nothing else has a second axis
    raise TurgorError(
        f"'{file}' does not say how the specimen was loaded.",
        python=f"Give mode, one of {', '.join(MODES)}.",
        command=f"Say it with --mode, one of {', '.join(MODES)}.",
    )


def _for_mode(columns: Sequence[Column], mode: str) -> tuple[Column, ...]:
    """Columns with their roles in a mode; a name that ends in 2 means the second axis if biaxial, else a replicate."""
    if mode == "biaxial":
        return tuple(columns)
    return tuple(replace(column, role=column.role.removesuffix("_2")) for column in columns)


def _specimens(table: Table, columns: Sequence[Column]) -> list[tuple[str, str, Table, dict[str, Column]]]:
    """Split a table into its specimens: name, batch, rows and columns of each."""
    stem = Path(table.file).stem
    labels = [column for role in _LABELS for column in columns if column.role == role]
    measured = [column for column in columns if column.role not in (*_LABELS, "time")]
    times = [column for column in columns if column.role == "time"]
    clock = {"time": times[0]} if times else {}
    if labels:
        batched = labels[0].role == "batch"
        marks = [tuple(row[c.index] if c.index < len(row) else "" for c in labels) for row in table.rows]
        known = {column.role: column for column in measured} | clock
        return [
            (
                " ".join((stem, *filter(None, mark))),
                mark[0] if batched else "",
                table.keeping(each == mark for each in marks),
                known,
            )
            for mark in dict.fromkeys(marks)
        ]
    roles = [column.role for column in measured]
    copies = max((roles.count(role) for role in roles), default=1)
    if copies == 1 or any(roles.count(role) not in (copies,) for role in roles):
        first: dict[str, Column] = {}
        for column in measured:
            if column.role in first:
                raise TurgorError(
                    f"'{table.file}': both '{first[column.role].name}' and '{column.name}' look like "
                    f"{column.role.replace('_', ' ')}; say which with columns={{'{column.role}': ...}}."
                )
            first[column.role] = column
        return [(stem, "", table, first | clock)]
    names = list(dict.fromkeys(roles))
    groups = [{role: [c for c in measured if c.role == role][i] for role in names} for i in range(copies)]
    clocks = [{"time": column} for column in times] if len(times) == copies else [clock] * copies
    return [(f"{stem} {i + 1}", "", _trimmed(table, group), group | clocks[i]) for i, group in enumerate(groups)]


def _label(table: Table) -> str:
    """Name of the column that tells specimens apart; empty where they stand side by side."""
    return next((name for name in table.names if role_of(split_unit(name)[0]) in _LABELS), "")


def _trimmed(table: Table, group: Mapping[str, Column]) -> Table:
    """Cut a table where a group of columns ends, because replicates side by side end at different rows."""
    last = [n for n, row in enumerate(table.rows) if any("".join(row[c.index : c.index + 1]) for c in group.values())]
    end = last[-1] + 1 if last else 0
    return replace(table, rows=table.rows[:end], lines=table.lines[:end])


def _test(
    name: str,
    table: Table,
    columns: Mapping[str, Column],
    mode: str,
    measure: str | None,
    specimen: Specimen | None,
) -> MaterialTest:
    def sizes() -> Sizes:
        return sizes_of(table.file, table.notes, specimen)

    along = stretch_quantity(table.file, columns, mode, sizes)
    pull = stress_quantity(table.file, columns, mode, sizes, measure)
    biaxial = mode == "biaxial"
    second = second_stress(table.file, columns, measure, pull) if biaxial else None
    across = ("stretch_2",) if biaxial and "stretch_2" in columns else ()
    sided = ("component",) if biaxial and "component" in columns else ()
    size = known_specimen(sizes)
    way = None if biaxial or size is None else crosshead_quantity(columns, along.role, size.length)
    roles = (along.role, pull.role, *((way.role,) if way else ()), *across, *((second.role,) if second else ()))
    if sided and not across:
        raise TurgorError(f"'{table.file}' names components of the stress, but has no column of a second stretch.")
    table, remark = table.complete(columns[role].index for role in roles)
    values = {role: table.column(columns[role].index) * columns[role].factor for role in roles}
    stretch, across_it = along.convert(values[along.role], None), values.get("stretch_2")
    if sided and across_it is not None:
        turned = along_second(table, columns["component"])  # the rubber is the same along both axes
        stretch, across_it = np.where(turned, across_it, stretch), np.where(turned, stretch, across_it)
    difference = pull.role == "cauchy_difference"
    alone = " along the first axis" if biaxial and second is None and not difference else ""
    alone = f" along the axis that '{columns['component'].name}' names" if sided else alone
    how = f"{along.text}; {pull.text}{alone}" + (f"; {second.text}" if second else "")
    time, clock = time_of(table, columns.get("time"))
    return MaterialTest(
        mode=mode,
        stretch=stretch,
        nominal_stress=pull.convert(values[pull.role], stretch),
        name=name,
        source=Source(text=f"test {name}", detail=f"{table.file}: {how}"),
        stretch_2=across_it,
        nominal_stress_2=second.convert(values[second.role], across_it) if second else None,
        cauchy_difference=difference,
        time=time,
        crosshead=way.convert(values[way.role], None) if way else None,
        specimen=size,
        edits=(Edit(text=f"Read {len(stretch)} rows; {how}{clock}{remark}."),),
    )
