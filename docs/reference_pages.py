"""The reference pages of job files and air files, written from the code that reads them: `make reference` renews them.

A test compares the pages with what this script writes, so they cannot fall behind.
"""

from pathlib import Path

import turgor as tg
from turgor.units import UNITS

REFERENCE = Path(__file__).parent / "reference"

INTRO = """\
# Keys of a job file

A job file is TOML: tables in square brackets, keys below them. A quantity is a text with its unit, such as `"1.5 mm"`.
Keys that are left out take their defaults, and a key that is not listed here is refused with the nearest one that is.
`turgor init FAMILY` writes a job with all of its keys. `job.lock.toml` of a run lists those that it used.
`--set loads.pressure="30 kPa"` changes one for a run. Names in capitals are chosen by you, or are those of regions,
faces and cavities of the actuator.

Ranges are the answers of the reader to values that are too large or too small. Where they depend on the actuator, they
are those of the fast PneuNet with its default dimensions. A dash stands for: every value of the type.

## Units

| type | units |
|---|---|
"""

FAMILIES = """\
## [actuator], type = "FAMILY"

A family of actuators. Each has its own page with keys, defaults and ranges; `turgor actuators FAMILY` prints them.

| type | what it is |
|---|---|
"""


def page() -> str:
    """Write the page."""
    units = "".join(f"| {name} | {', '.join(f'`{unit}`' for unit in units)} |\n" for name, units in UNITS.items())
    top, *tables = [section(table) for table in tg.jobs.section_tables()]
    families = "".join(f"| [`{name}`](../actuators/{name}.md) | {words(name)} |\n" for name in tg.jobs.ACTUATORS)
    return "\n".join([INTRO + units, top, FAMILIES + families, *tables])


AIR = """\
# Keys of an air file

`turgor air FILE.toml` reads a network of supplies, valves, tubes and chambers. The file is TOML; a quantity is a
text with its unit, as in [job files](job-file.md). Keys that are not listed here are refused with the nearest one
that is. Pressures are gauge pressures unless they are called absolute. [Air and liquid](../howto/air.md) has
examples.

Names of nodes and parts are chosen by you; the node `ambient` is there always.

A **signal** is a value or one of

- `[["0 s", 1], ["0.5 s", -1]]`: points in time,
- `{ points = [["0 s", 1], ["0.5 s", -1]], period = "1 s" }`: points that repeat,
- `{ frequency = "20 Hz", duty = 0.3 }`: pulses,
- `{ mean = "50 kPa", amplitude = "20 kPa", frequency = "1 Hz" }`: a sine.

Commands of valves that are open or closed go in steps from point to point; all other values change along straight
lines.

How wide a **valve** is: `conductance` (and `critical_ratio`, `exponent`) of a restriction by ISO 6358, or
`diameter` (and `discharge`) of an orifice.
"""


def air_page() -> str:
    """Write the page of air files."""
    return "\n".join([AIR, *(air_section(table) for table in tg.air.file_tables())])


def air_section(table: tg.air.AirTable) -> str:
    """Write a table of an air file with its keys."""
    rows = "".join(
        f"| `{key.name}` | {cell(key.kind) or '–'} | {air_default(key)} | {cell(key.meaning)} |\n" for key in table.keys
    )
    head = "| key | type | default | meaning |\n|---|---|---|---|\n"
    return f"## {table.header[:1].upper()}{table.header[1:]}\n\n{table.words}\n\n{head}{rows}"


def air_default(key: tg.air.AirKey) -> str:
    """Write the default of a key, or that it is needed."""
    return code(key.default) if key.default and not key.default.endswith(("needed", "both")) else key.default


def words(family: str) -> str:
    """Write what a family is."""
    return cell(tg.jobs.family_table(family).words)


def section(table: tg.jobs.JobTable) -> str:
    """Write a table with its keys."""
    rows = [
        f"| `{key.name}` | {cell(key.kind)} | {default(key)} | {cell(key.allowed) or '–'} | {cell(key.meaning)} | "
        f"{code(key.example)} |\n"
        for key in table.keys
    ]
    head = "| key | type | default | range | meaning | example |\n|---|---|---|---|---|---|\n"
    return f"## {table.header[:1].upper()}{table.header[1:]}\n\n{table.words}\n\n{head}{''.join(rows)}"


def default(key: tg.jobs.JobKey) -> str:
    """Write the default of a key."""
    return code(key.default) if key.default else "needed" if key.needed else "–"


def code(text: str) -> str:
    """Write TOML in a cell."""
    return f"`{cell(text)}`" if text else "–"


def cell(text: str) -> str:
    """Write text in a cell."""
    return text.replace("|", "\\|")


def main() -> None:
    """Write the pages."""
    (REFERENCE / "job-file.md").write_text(page(), encoding="utf-8")
    (REFERENCE / "air-file.md").write_text(air_page(), encoding="utf-8")


if __name__ == "__main__":
    main()
