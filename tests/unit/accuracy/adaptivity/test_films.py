"""The mesh error of folded films costs a few factorizations, like that of solids, and covers the true error."""

import turgor as tg
from turgor.core.engine.algebra.tangent import Tangent
from turgor.units import MPa, kPa, mm


def _solved(size):
    film = tg.Material(name="film", law=tg.laws.Hooke(E=20 * MPa, nu=0.45))
    mesh = tg.mesh(tg.actuators.YoshimuraBellows(sides=4, folds=1), size=size)
    sheets = {"film": tg.Shell(film, 1 * mm), "tip": tg.Shell(film, 5 * mm)}
    supports = ["fixed", tg.supports.ReferencePoint("end", "tip")]
    model = tg.Model(mesh, sheets, supports, [tg.Pressure("cavity", -6 * kPa)])
    return tg.solve(model, tg.Static(first_step=0.5, max_step=0.5))


def test_the_estimate_of_a_folded_film_takes_few_factorizations(monkeypatch):
    """It starts at the interpolated state: pseudo-transient continuation, for films that wrinkle, took 20 or more."""
    solution, fine = _solved(20 * mm), _solved(5 * mm)
    made, factor = [], Tangent.factor

    def counted(self, *args):
        made.append(self)
        return factor(self, *args)

    monkeypatch.setattr(Tangent, "factor", counted)
    response = tg.measure(solution, tg.cavity_volume)
    assert 0 < len(made) <= 4
    true = abs(tg.cavity_volume(fine.states[-1]) - tg.cavity_volume(solution.states[-1]))
    error = float(response.column("cavity_volume_mesh_error")[-1])
    assert 0.7 * true < error < 3 * true
