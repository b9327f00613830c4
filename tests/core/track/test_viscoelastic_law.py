"""The damping fit against its target, its optimum and causality; its recursions against the integral."""

import numpy as np
import pytest
from scipy.integrate import quad

from trackig_core.track.viscoelastic_law import FIT_FREQUENCIES, fit_loss_factor, relaxation

LOSS_FACTORS = [0.05, 0.1, 0.15, 0.2, 0.3, 0.5]


@pytest.mark.parametrize("loss_factor", ["0.1", "0.15", "0.2", "0.3"])
def test_terms_are_the_golden_ones(golden, loss_factor):
    law = fit_loss_factor(float(loss_factor))
    expected = golden["relaxation_fit"][loss_factor]
    assert law.strengths == pytest.approx(expected["D_relative"], rel=1e-3)
    assert law.times == pytest.approx(expected["tau_s"], rel=1e-3)


@pytest.mark.parametrize("loss_factor", LOSS_FACTORS)
def test_stiffness_at_50_hz_is_as_stated_and_the_loss_factor_within_5_percent(loss_factor):
    law = relaxation(28e6, loss_factor)
    assert law.dynamic_stiffness(50.0).real == pytest.approx(28e6, rel=1e-12)
    errors = law.loss_factor(np.geomspace(5, 500, 777)) / loss_factor - 1
    assert np.abs(errors).max() < 0.051
    assert law.worst_error == pytest.approx(np.abs(errors).max(), rel=0.02)


@pytest.mark.parametrize("loss_factor", LOSS_FACTORS)
def test_no_small_change_of_a_term_fits_better(loss_factor):
    law = fit_loss_factor(loss_factor)

    def misfit(values):
        terms = sum(d / (1 + 2j * np.pi * FIT_FREQUENCIES * t) for d, t in zip(*values, strict=True))
        fixed = 1 + sum(d / (1 + (100 * np.pi * t) ** 2) for d, t in zip(*values, strict=True))
        return np.sum(((fixed - terms).imag / (fixed - terms).real / loss_factor - 1) ** 2)

    best = np.array([law.strengths, law.times])
    for index in np.ndindex(2, 3):
        for factor in (0.99, 1.01):
            changed = best.copy()
            changed[index] *= factor
            assert misfit(changed) > misfit(best)


def test_a_causal_damper_stiffens_with_frequency():
    law = relaxation(1.0, 0.2)
    assert law.dynamic_stiffness([5.0, 500.0]).real == pytest.approx([0.73, 1.38], abs=0.005)
    assert law.instantaneous == pytest.approx(law.dynamic_stiffness(1e7).real, rel=1e-6)
    assert law.stiffness(5.0) == pytest.approx(law.dynamic_stiffness(5.0).real, rel=1e-12)


def test_without_loss_there_is_no_memory():
    law = relaxation(28e6, 0.0)
    assert law.strengths == law.times == ()
    assert law.dynamic_stiffness([5.0, 500.0]) == pytest.approx([28e6, 28e6])
    assert law.recursion(1e-5, 1)[0] == 28e6


def _stepped(law, strain, time_step, order):
    """Force by the recursion, as the kernel does it."""
    stiffness, decay, gain = law.recursion(time_step, order)
    memory, force = np.zeros(decay.size), []
    for value in strain:
        force.append(stiffness * value - memory.sum())
        memory = decay * memory + gain * value
    return np.array(force)


def test_first_order_recursion_is_the_papers():
    law, time_step = relaxation(2.0, 0.3), 1e-3
    strain = np.random.default_rng(0).normal(size=50)
    memory, expected = np.zeros(3), []
    for value in strain:
        memory = memory * np.exp(-time_step / np.array(law.times)) + value * time_step
        expected.append(law.instantaneous * value - np.sum(np.array(law.strengths) * memory / law.times))
    assert _stepped(law, strain, time_step, order=1) == pytest.approx(np.array(expected), rel=1e-12)


def test_second_order_recursion_is_exact_for_a_ramp():
    law, time_step = relaxation(2.0, 0.3), 1e-3
    time = np.arange(40) * time_step
    force = _stepped(law, time, time_step, order=2)

    def memory(end):
        return sum(
            k / t * quad(lambda s, t=t: (end - s) * np.exp(-s / t), 0, end, epsabs=1e-14)[0]
            for k, t in zip(law.strengths, law.times, strict=True)
        )

    assert force == pytest.approx([law.instantaneous * t - memory(t) for t in time], rel=1e-9, abs=1e-14)


@pytest.mark.parametrize(("order", "expected"), [(1, 1.0), (2, 2.0)])
def test_recursions_converge_with_their_order(order, expected):
    law = relaxation(2.0, 0.3)
    angular = 2 * np.pi * 40.0
    errors = []
    for steps in (100, 200, 400):
        time = np.arange(20 * steps + 1) / 40.0 / steps
        force = _stepped(law, np.sin(angular * time), time[1], order)
        exact = np.imag(law.dynamic_stiffness(40.0) * np.exp(1j * angular * time))
        errors.append(np.abs(force - exact)[-steps:].max())
    slopes = np.log2(np.array(errors[:-1]) / errors[1:])
    assert slopes == pytest.approx([expected, expected], abs=0.1)


def test_the_law_is_causal():
    """Its response to a step of strain, by Fourier inversion of K(f), is real, and zero before the step.

    The singular part, k_inf H(t), is causal by itself; what is left is smooth enough to transform.
    """
    law = relaxation(1.0, 0.3)
    interval, count = 2e-6, 2**20
    frequency = np.fft.fftfreq(count, interval)
    angular = 2j * np.pi * frequency
    with np.errstate(divide="ignore", invalid="ignore"):
        spectrum = (law.dynamic_stiffness(frequency) - law.instantaneous) / angular
    # a step that lasts for half of the window, so that its mean is finite
    half = count // 2
    box = angular * 0 + half * interval
    box[1:] = (1 - np.exp(-angular[1:] * half * interval)) / angular[1:]
    response = np.fft.ifft((law.dynamic_stiffness(frequency) - law.instantaneous) * box) / interval
    assert spectrum.size == count
    assert np.abs(response.imag).max() < 1e-6
    # before the step: the end of the window, after the box has been forgotten
    assert np.abs(response.real[-1000:-10]).max() < 1e-4
    time = np.arange(count) * interval
    relaxed = -sum(k * -np.expm1(-time / t) for k, t in zip(law.strengths, law.times, strict=True))
    inside = slice(1000, half - 1000)
    assert response.real[inside] == pytest.approx(relaxed[inside], abs=1e-4)


def test_stiffness_and_loss_obey_kramers_and_kronig():
    """Re K follows from Im K alone: Re K(w) = k_inf - (2/pi) P int w' Im K(w') / (w'^2 - w^2) dw'."""
    law = relaxation(1.0, 0.3)
    at = 40.0
    # over the logarithm of frequency, the principal value by subtracting what stands at the pole
    grid = np.geomspace(1e-6, 1e10, 400_001)
    centred = grid * at / grid[np.argmin(np.abs(grid - at))] * (1 + 1e-9)
    loss = law.dynamic_stiffness(centred).imag
    pole = law.dynamic_stiffness(at).imag
    integrand = (centred * loss - at * pole) / (centred**2 - at**2)
    found = law.instantaneous - 2 / np.pi * np.trapezoid(integrand * centred, np.log(centred))
    assert found == pytest.approx(law.dynamic_stiffness(at).real, rel=1e-4)
