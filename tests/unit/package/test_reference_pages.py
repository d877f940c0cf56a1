"""The reference of job files says what the code says, about every key."""

import sys
import tomllib
from pathlib import Path

import pytest
from pydantic import ValidationError

from turgor.core.materials.laws.laws import LAWS
from turgor.job.job import ACTUATORS
from turgor.job.read import SECTIONS
from turgor.job.reference.sections import section_tables
from turgor.job.reference.tables import family_table
from turgor.job.tables.cad import CadFileTable, SelectorTable
from turgor.job.tables.contact import ContactTable
from turgor.job.tables.fibers import FibersTable
from turgor.job.tables.material_tables import LibraryTable, law_table
from turgor.job.tables.mesh_files import MeshFileTable
from turgor.job.tables.obstacles import obstacle_table
from turgor.job.tables.procedures import PROCEDURES, procedure_table
from turgor.job.tables.stages import StageTable
from turgor.job.text.listed_loads import loads_model
from turgor.job.text.load_tables import CavityTable
from turgor.job.text.quantities import MeshTable, OutputTable

DOCS = Path(__file__).parents[3] / "docs"
sys.path.insert(0, str(DOCS))
import reference_pages  # noqa: E402  the script stands beside the pages that it writes


@pytest.fixture(scope="module")
def tables():
    return list(section_tables())


def test_page_is_what_the_code_says():
    written = (DOCS / "reference" / "job-file.md").read_text(encoding="utf-8")
    assert written == reference_pages.page(), "run `make reference`"
    written = (DOCS / "reference" / "air-file.md").read_text(encoding="utf-8")
    assert written == reference_pages.air_page(), "run `make reference`"


def test_every_section_has_its_table(tables):
    shown = {table.header.strip("[").split("]")[0].split(".")[0] for table in tables}
    assert set(SECTIONS) - {"name", "written_by"} <= shown


def test_every_key_has_a_meaning_a_type_and_an_example(tables):
    every = [*tables, *map(family_table, ACTUATORS)]
    keys = [(table.header, key) for table in every for key in table.keys]
    assert len(keys) > 400
    assert [(header, key.name) for header, key in keys if not key.meaning] == []
    assert [(header, key.name) for header, key in keys if key.kind == "value"] == []
    assert [(header, key.name) for header, key in keys if not key.example] == []


def test_every_example_is_toml(tables):
    for table in tables:
        for key in table.keys:
            assert "value" in tomllib.loads(f"value = {key.example}"), (table.header, key.name)


@pytest.mark.parametrize(
    ("header", "model"),
    [
        ("[mesh]", MeshTable),
        ("[materials.NAME], from the library", LibraryTable),
        ('[materials.NAME], law = "ogden"', law_table(LAWS["ogden"])),
        ("[fibers.NAME]", FibersTable),
        ("[loads]", loads_model()),
        ("[loads.CAVITY]", CavityTable),
        ("[contact]", ContactTable),
        ("[obstacles.NAME]", obstacle_table("plane")),
        ("{ ... } of a face or region", SelectorTable),
        ('[actuator], type = "cad_file"', CadFileTable),
        ('[actuator], type = "mesh_file"', MeshFileTable),
        ('[procedure], type = "dynamic"', procedure_table(PROCEDURES["dynamic"])),
        ("[[stages]]", StageTable),
        ("[output]", OutputTable),
    ],
)
def test_every_example_can_be_read(tables, header, model):
    (table,) = (each for each in tables if each.header == header)
    for key in table.keys:
        with pytest.raises(ValidationError) as caught:
            model.model_validate({key.name: tomllib.loads(f"value = {key.example}")["value"], "not a key": 1})
        assert {error["loc"][0] for error in caught.value.errors()} & {key.name} == set(), key


def test_ranges_are_those_of_the_reader(tables):
    allowed = {(table.header, key.name): key.allowed for table in tables for key in table.keys}
    assert allowed["[mesh]", "grading"] == "0.1 to 1"
    assert allowed["[fibers.NAME]", "hand"] == "both, left, right"
    assert allowed["[contact]", "friction"] == "between 0 and 2"
    assert allowed['[procedure], type = "static"', "tolerance"] == "1e-12 to 0.01"
    assert next(key.allowed for key in family_table("fast_pneunet").keys if key.name == "gap").startswith("0.01 mm to")
