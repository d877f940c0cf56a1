"""Chains of rods: they follow the rod, converge with their links, and stand in mechanism files."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.systems.robots.chains.chain_of_rod import chain_of_rod
from turgor.systems.robots.mechanisms.mechanism_file import read_mechanism
from turgor.units import kPa, mm

SECTION = replace(
    tg.rods.RodSection.from_moduli(EA=60.0, GA=2000.0, EI=1.2e-3, GJ=8e-4, mass_per_length=0.2),
    chambers=(
        tg.rods.RodChamber(name="up", area=8e-5, offset=(0, 3 * mm)),
        tg.rods.RodChamber(name="side", area=8e-5, offset=(2 * mm, -1 * mm)),
    ),
)
ROD = tg.rods.Rod(section=SECTION, length=100 * mm)

FILE = """
[arms.arm]
turn = ["0 deg", "90 deg", "0 deg"]

[[arms.arm.segments]]
pressures = {{ {cavity} = "20 kPa" }}
rod = {{ shape = "tube", outer_radius = "8 mm", inner_radius = "4 mm", length = "80 mm", library = "elastosil-m4601", \
record = "neo-hooke-polygerinos-2020", {more} }}
"""


def written(folder: Path, more: str, cavity: str = "cavity") -> Path:
    file = folder / "arm.toml"
    file.write_text(FILE.format(more=more, cavity=cavity), encoding="utf-8")
    return file


def test_a_chain_converges_to_its_rod_in_proportion_to_its_links() -> None:
    errors = [chain_of_rod(ROD, links, pressure=50 * kPa).error for links in (8, 16, 32)]
    assert errors[0] / errors[1] == pytest.approx(2, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(2, rel=0.05)
    assert errors[2] < 1.1e-3


def test_without_stretch_it_converges_with_the_square() -> None:
    stiff = replace(ROD, section=tg.rods.RodSection.from_moduli(EA=1e6, GA=1e6, EI=1.2e-3, GJ=8e-4))
    errors = [chain_of_rod(stiff, links).error for links in (4, 8, 16)]
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(4, rel=0.1)


def test_a_hanging_chain_is_as_long_and_heavy_as_its_rod() -> None:
    chain = chain_of_rod(ROD, 12).chain
    hanging = replace(chain, gravity=np.array([9.80665, 0.0, 0.0]))
    x = hanging.equilibrium(np.zeros(2))
    stretched = tg.rods.static(tg.rods.RodModel(rods=[ROD], loads=[tg.Gravity((1, 0, 0))])).tip[-1]
    assert hanging.tip(hanging.placed(x)) == pytest.approx(np.asarray(stretched), abs=2e-5)
    assert chain.masses.sum() == pytest.approx(0.2 * 0.1 * (1 - 1 / 24))  # half a piece stays at the base


def test_what_a_chain_cannot_have_is_refused() -> None:
    coupled = np.diag([60.0, 2000, 2000, 8e-4, 1.2e-3, 1.2e-3])
    coupled[0, 4] = coupled[4, 0] = 0.05
    with refused("'rod'", "0.19"):
        chain_of_rod(tg.rods.Rod(section=tg.rods.RodSection(stiffness=coupled), length=0.1))
    with refused("'rod'", "bent"):
        chain_of_rod(replace(ROD, rest_strain=(0, 0, 0, 0, 5.0, 0)))
    with refused("0 links", 1):
        chain_of_rod(ROD, 0)


def test_a_rod_stands_in_a_mechanism_file(tmp_path: Path) -> None:
    made = read_mechanism(written(tmp_path, "reinforced = true"))
    state = made.mechanism.solve()["arm"]
    assert state.tip == pytest.approx([0, 0, -0.08], abs=3e-3)
    assert state.tip[2] < -0.0801
    assert "rod" in made.errors["arms.arm.segments[1]"]
    bent = read_mechanism(written(tmp_path, 'chambers = { up = { area = "50 mm²", offset = [0, "4 mm"] } }', "up"))
    assert abs(bent.mechanism.solve()["arm"].tip[0]) > 5e-3


@pytest.mark.parametrize(
    ("more", "facts"),
    [
        ("reinforced = 1", ("arms.arm.segments[1].rod.reinforced", 1)),
        ("walls = 1", ("'walls'", "outer_radius")),
        ('up_to = "5 mm"', ("arms.arm.segments[1].rod.up_to", "5 mm")),
        ("chambers = { up = { offset = [0, 0] } }", ("arms.arm.segments[1].rod.chambers.up.area",)),
        (
            'chambers = { up = { area = "5 mm", offset = [0, 0] } }',
            ("arms.arm.segments[1].rod.chambers.up.area", "5 mm"),
        ),
    ],
)
def test_rods_that_cannot_be(tmp_path: Path, more: str, facts: tuple) -> None:
    with refused(*facts):
        read_mechanism(written(tmp_path, more))


def test_a_segment_is_a_file_or_a_rod(tmp_path: Path) -> None:
    file = written(tmp_path, "reinforced = true")
    file.write_text(file.read_text("utf-8") + 'file = "a.reduced"\n', encoding="utf-8")
    with refused("arms.arm.segments[1]", "file", "rod"):
        read_mechanism(file)
