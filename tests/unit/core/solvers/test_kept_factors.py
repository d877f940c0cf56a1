"""Factors of an earlier iterate are used again, but not once an update has changed which points touch."""

from dataclasses import replace

import pytest

import contact_cases
import turgor as tg
from turgor.core.solvers.newton import newton
from turgor.core.solvers.newton.settings import FACTORS
from turgor.units import mm

#: Residuals as large as this, and growing as much, would keep the factors.
ALWAYS = 1e9


def test_new_factors_are_made_where_an_update_has_changed_which_points_touch(monkeypatch: pytest.MonkeyPatch) -> None:
    ball = tg.obstacles.Sphere(center=(5 * mm, 5 * mm, 9 * mm), radius=4 * mm)
    model = contact_cases.standing(contact_cases.block((6, 6, 2)), contact_cases.pushed(ball, (0.0, 0.0, -0.6)))
    choose, seen = newton._factors, []

    def noted(run, now):  # type: ignore[no-untyped-def]
        fresh, geometric = choose(run, now)
        if now.last is not None and now.lengths[-1] == 1 and not now.jump.any():
            seen.append((now.at.contacts.touch_as(now.last[0].contacts), fresh))
        return fresh, geometric

    monkeypatch.setattr(newton, "_factors", noted)
    monkeypatch.setattr(newton, "FACTORS", replace(FACTORS, below=ALWAYS, contraction=ALWAYS))
    tg.solve(model, tg.Static(first_step=0.25, max_step=0.25))
    assert {fresh for same, fresh in seen if not same} == {True}
    assert {fresh for same, fresh in seen if same} == {False}
