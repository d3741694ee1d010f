"""How far the one-harmonic peak is from the peak with all harmonics."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from hbm.curves.periodic_response import periodic_response
from hbm.one_harmonic import one_harmonic_error, one_harmonic_response
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium

TURN = 2.0 * np.pi
SAMPLES = 32768
"""with which the place of a flat top is known to 3e-6"""


def size(problem: Problem, response: PeriodicResponse) -> float:
    """Return the largest amplitude of a probe [m]."""
    return float(response.amplitudes(problem.probes.rows).max())


@pytest.mark.parametrize("limit", [0.3, 0.5, 1.0])
def test_at_a_flat_top_it_is_that_of_the_densely_sampled_peak(limit: float) -> None:
    problem = problem_of(load_scene("jenkins", [f"element.slider.limit={limit}"]))
    rest, limits = static_equilibrium(problem), (14.0 * TURN, 22.0 * TURN)
    found = one_harmonic_response(problem, rest, limits)
    around = found.frequency * np.array([0.997, 1.003])
    options = CurveOptions(*limits, harmonics=31, stability=False, errors=False)
    curve = list(frequency_response(problem, rest, options))

    def below(frequency: float) -> float:
        near = min(curve, key=lambda each: abs(each.frequency - frequency))
        guess = replace(near, frequency=frequency)
        made = periodic_response(problem, rest, guess, harmonics=31, samples=SAMPLES)
        return -1e3 * size(problem, made)

    best = minimize_scalar(
        below, bounds=tuple(around), method="bounded", options={"xatol": 1e-6}
    )

    error = one_harmonic_error(problem, rest, found, limits, 1e-3, free=True)

    shift = abs(found.frequency / best.x - 1.0)
    assert error.frequency == pytest.approx(shift, abs=5e-6)
    amplitude = abs(size(problem, found) / (-1e-3 * best.fun) - 1.0)
    assert error.amplitude == pytest.approx(amplitude, rel=0.02)


@pytest.mark.parametrize(
    ("scene", "precise", "within"),
    [("duffing", 1e-5, 0.01), ("gap", 1e-5, 0.01), ("friction-beam", 3e-4, 0.1)],
)
def test_it_is_that_of_the_peak_of_the_whole_curve(
    scene: str, precise: float, within: float
) -> None:
    loaded = load_scene(scene, [])
    problem = problem_of(loaded)
    rest = static_equilibrium(problem)
    limits = TURN * loaded.curve.lowest, TURN * loaded.curve.highest
    options = CurveOptions(*limits, error=precise, stability=False)
    curve = frequency_response(problem, rest, options)
    peak = max(curve, key=lambda each: size(problem, each))

    found = one_harmonic_response(problem, rest, limits)
    error = one_harmonic_error(problem, rest, found, limits, 1e-3, free=True)

    assert peak.event == "peak"
    shift = abs(found.frequency / peak.frequency - 1.0)
    assert error.frequency == pytest.approx(shift, rel=within)
