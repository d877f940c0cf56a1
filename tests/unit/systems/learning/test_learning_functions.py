"""Reduced models as functions: values are those of `solve`, and gradients pass each framework's own check."""

import numpy as np
import pytest
from learning_cases import pushed

import turgor as tg
from refused import refused

#: Outputs of every kind, and inputs within the range.
OUTPUTS = (tg.control.Tip(), tg.control.Angle(), tg.learning.Volumes(), tg.control.Points([(6e-3, 0, 0)]))
INPUTS = np.array([[500.0, 3e-3], [200.0, -5e-3], [900.0, 8e-3]])
SIZES = np.array([*[1e-3] * 3, 0.1, 1e-6, *[1e-3] * 3])


def test_values_are_those_of_the_answer_for_any_shape_of_the_batch():
    made = tg.learning.function(pushed(), OUTPUTS)
    values, rates = made.with_rates(INPUTS.reshape(3, 1, 2))
    assert values.shape == (3, 1, 8) and rates.shape == (3, 1, 8, 2)
    assert made(INPUTS[1]) == pytest.approx(values[1, 0], rel=1e-14)
    answer = pushed().solve({"pressure": 500.0, "tip.vector.3": 3e-3})
    assert values[0, 0, :3] == pytest.approx(answer.tip, abs=1e-15)
    assert rates[0, 0, :3] == pytest.approx(answer.with_own_rates().tip_rates, rel=1e-12)
    assert values[0, 0, 4] == pytest.approx(answer.volumes["cavity"])
    assert rates[0, 0, 4] == pytest.approx(answer.volume_rates["cavity"])
    assert made.names[:5] == ("tip_x", "tip_y", "tip_z", "bending_angle", "volume_cavity")


def test_rates_are_the_derivatives():
    made = tg.learning.function(pushed(), (*OUTPUTS, tg.learning.Coordinates()))
    _, rates = made.with_rates(INPUTS)
    for place, step in enumerate((1.0, 1e-5)):
        change = step * np.eye(2)[place]
        difference = (made(INPUTS + change) - made(INPUTS - change)) / (2 * step)
        sizes = np.abs(difference).max(axis=0) + 1e-9 * np.abs(difference).max()
        q = slice(-pushed().equations.sizes[0], None)
        sizes[q] = sizes[
            q
        ].max()  # rates are those before a last update, which may be larger than the least coordinates
        assert np.abs((rates[..., place] - difference) / sizes).max() < 1e-4


def test_modes_give_the_displacement_of_every_node():
    reduced = pushed()
    q = tg.learning.function(reduced, [tg.learning.Coordinates()])(INPUTS[0])
    answer = reduced.at(INPUTS[0])
    assert (reduced.modes @ q).reshape(-1, 3) * reduced.scales[0] == pytest.approx(answer.displacement)


def test_inputs_that_do_not_fit_are_refused():
    made = tg.learning.function(pushed())
    with refused("(3,)", 2, "loads.pressure"):
        made([1.0, 2.0, 3.0])
    with refused("()", 2):
        made(1.0)
    with refused("loads.pressure", "1 kPa"):
        made([2000.0, 0.0])
    with refused("nan"):
        made([np.nan, 0.0])
    with refused("Tip()"):
        tg.learning.function(pushed(), ())


def test_gradients_of_jax():
    jax = pytest.importorskip("jax")
    from jax.test_util import check_grads

    with jax.enable_x64(True):
        high, sizes = jax.numpy.asarray(pushed().inputs.high), jax.numpy.asarray(SIZES)
        of_reduced = tg.learning.to_jax(pushed(), OUTPUTS)

        def scaled(shares):
            return of_reduced(shares * high) / sizes

        shares = jax.numpy.asarray(INPUTS / pushed().inputs.high)
        check_grads(scaled, (shares,), order=1, modes=("fwd", "rev"), eps=1e-5, atol=1e-6, rtol=1e-6)
        expected = tg.learning.function(pushed(), OUTPUTS).with_rates(INPUTS)
        rates = jax.jit(jax.vmap(jax.jacrev(of_reduced)))(jax.numpy.asarray(INPUTS))
        assert np.asarray(rates) == pytest.approx(expected[1], rel=1e-12)
        with refused("JVP", error=ValueError):  # of jax: no second derivatives
            jax.hessian(scaled)(shares[0])
    assert of_reduced(jax.numpy.asarray(INPUTS, dtype="float32")) == pytest.approx(expected[0], rel=1e-4, abs=1e-9)


def test_gradients_of_torch():
    torch = pytest.importorskip("torch")
    high, sizes = torch.as_tensor(pushed().inputs.high), torch.as_tensor(SIZES)
    of_reduced = tg.learning.to_torch(pushed(), OUTPUTS)

    def scaled(shares):
        return of_reduced(shares * high) / sizes

    shares = torch.tensor(INPUTS / pushed().inputs.high, requires_grad=True)
    assert torch.autograd.gradcheck(scaled, shares, eps=1e-5, atol=1e-6, rtol=1e-6, check_forward_ad=True)
    expected = tg.learning.function(pushed(), OUTPUTS).with_rates(INPUTS)
    rates = torch.func.vmap(torch.func.jacrev(of_reduced))(torch.tensor(INPUTS))
    assert rates.numpy() == pytest.approx(expected[1], rel=1e-12)
    assert of_reduced(torch.tensor(INPUTS, dtype=torch.float32)).dtype is torch.float32
    (once,) = torch.autograd.grad(scaled(shares).square().sum(), shares, create_graph=True)
    with refused("once_differentiable", error=RuntimeError):  # of torch: no second derivatives
        once.sum().backward()
