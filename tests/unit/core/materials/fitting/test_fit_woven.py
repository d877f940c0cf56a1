"""Strips of a woven fabric: what three of them give, their errors, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.fitting.fit_woven import STRIPS, fit_woven, strip_strain

CLOTH = tg.laws.Woven(E=400e6, E_weft=150e6, G=12e6, nu=0.25)
STRETCH = np.linspace(1.001, 1.02, 12)


def strips(noise: float = 0.0, seed: int = 0, scale: float = 1.0) -> dict[str, MaterialTest]:
    random = np.random.default_rng(seed)
    made = {}
    for cut, angle in STRIPS.items():
        stress = scale * CLOTH.modulus_along(angle) * strip_strain(STRETCH)
        stress = stress + noise * stress.max() * random.normal(size=len(STRETCH))
        made[cut] = MaterialTest(mode="uniaxial", stretch=STRETCH, nominal_stress=stress, name=cut)
    return made


def test_three_strips_give_the_fabric():
    found = fit_woven(strips(), nu=0.25)
    assert [found.law.E, found.law.E_weft, found.law.G] == pytest.approx([400e6, 150e6, 12e6], rel=1e-9)
    assert found.relative < 1e-12
    assert found.stress("bias", STRETCH) == pytest.approx(strips()["bias"].nominal_stress)
    assert found.material().law is found.law


def test_the_contraction_hardly_moves_the_shear_modulus():
    """d(1/G)/dnu = 2/E, so nu of 0 instead of 0.25 lowers G by 0.5 G/E = 1.5 %."""
    assert pytest.approx(0.015, rel=0.02) == fit_woven(strips(), nu=0.0).law.G / 12e6 - 1


def test_errors_cover_the_scatter():
    inside = {"E": 0, "E_weft": 0, "G": 0}
    for seed in range(40):
        found = fit_woven(strips(0.02, seed), nu=0.25)
        for name, true in (("E", 400e6), ("E_weft", 150e6), ("G", 12e6)):
            inside[name] += abs(found.values[name] - true) < 2 * found.errors[name]
    assert all(count >= 33 for count in inside.values()), inside


def test_strips_of_several_specimens_differ_by_their_standard_deviation():
    several = {cut: [strips(scale=factor)[cut] for factor in (0.9, 1.0, 1.1)] for cut in STRIPS}
    found = fit_woven(several, nu=0.25)
    assert found.values["E"] == pytest.approx(400e6) and found.errors["E"] == pytest.approx(40e6)
    assert found.off("warp", several["warp"][0]) == pytest.approx(0.1 / 0.9 * np.sqrt(np.mean(
        strip_strain(STRETCH) ** 2)) / strip_strain(STRETCH).max())  # fmt: skip


def test_points_at_rest_do_not_lessen_the_error():
    """They lie on any line through rest; a strip with one other point has no scatter."""
    made = strips(0.02, 1)["warp"]
    rest = [replace(made, stretch=np.append(1.0, STRETCH), nominal_stress=np.append(0.0, made.nominal_stress))]
    errors = [fit_woven(strips() | {"warp": each}, nu=0.25).errors["E"] for each in (made, *rest)]
    assert errors[1] == pytest.approx(errors[0], rel=1e-12)
    with refused("'warp'", "one point", "need two"):
        fit_woven(strips() | {"warp": replace(made, stretch=[1.0, 1.01], nominal_stress=[0.0, 3e6])}, nu=0.25)


def test_what_cannot_be_fitted_is_refused():
    known = strips()
    with refused("nu", "nan"):
        fit_woven(known, nu=float("nan"))
    with refused("bias", "warp", "weft"):
        fit_woven({cut: known[cut] for cut in ("warp", "weft")}, nu=0.2)
    with refused("baias", "bias"):
        fit_woven({**known, "baias": known["bias"]}, nu=0.2)
    with refused("planar", "uniaxially"):
        fit_woven({**known, "bias": replace(known["bias"], mode="planar")}, nu=0.2)
    with refused("weft", "rise"):
        fit_woven({**known, "weft": replace(known["weft"], nominal_stress=-known["weft"].nominal_stress)}, nu=0.2)
    stiff = replace(known["bias"], nominal_stress=40 * known["bias"].nominal_stress)
    with refused("45°", "bias"):
        fit_woven({**known, "bias": stiff}, nu=0.2)
    with refused("fit_woven", "--directions warp,weft,bias"):
        tg.fit("woven", known["warp"])
