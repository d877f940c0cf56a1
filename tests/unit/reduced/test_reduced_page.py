"""The page of a reduced model: one file with inputs, errors that full solves gave, and a picture."""

import re
from dataclasses import replace

import numpy as np
from reduced_cases import reduced

from turgor.reduced.measures import with_measures
from turgor.reduced.page import reduced_page
from turgor.reduced.states.held_out import HeldOutErrors


def test_page_states_inputs_and_errors_and_loads_nothing():
    made = with_measures(reduced(), ["bending_angle", "cavity_volume"])
    page = reduced_page(made)
    assert "loads.pressure" in page
    assert re.search(r"bending angle</td><td>[0-9.]+ ± [0-9.]+ deg, reduction ± [0-9.e-]+ deg", page)
    assert "12 kPa" in page
    assert f"{100 * made.held_out.worst:.2g} % of the largest displacement: within the wanted 0.5 %" in " ".join(
        page.split()
    )
    assert "data:image/png;base64," in page
    assert "<svg" in page
    assert 'src="http' not in page
    assert 'href="http' not in page


def test_page_says_where_the_wanted_error_is_missed_and_where_nothing_was_found():
    made = reduced()
    lost = replace(made.held_out, displacement=np.full_like(made.held_out.displacement, np.inf))
    page = reduced_page(replace(made, held_out=lost))
    assert "finds nothing" in page
    assert "not found" in page
    large = replace(made.held_out, displacement=made.held_out.displacement + 0.1)
    assert "above the wanted" in reduced_page(replace(made, held_out=large))
    nothing = np.zeros(0)
    none = HeldOutErrors(inputs=nothing[:, None], displacement=nothing, tip=nothing, volume=nothing, force=nothing)
    assert "unchecked" in reduced_page(replace(made, held_out=none))
