"""The largest one-harmonic amplitude, where it hardly changes with the frequency."""

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

from hbm.one_harmonic import one_harmonic_response
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.static import static_equilibrium

TURN = 2.0 * np.pi
MASS, STIFFNESS, DAMPING, SLIDER, DRIVE = 1.0, 1e4, 1.0, 5e3, 0.5
"""of the scene ``jenkins``"""


def jenkins(amplitude: float, limit: float, slider: float = SLIDER) -> complex:
    """Return the describing function of Jenkins' element [N/m]."""
    if amplitude <= limit / slider:
        return slider
    angle = np.arccos(1.0 - 2.0 * limit / slider / amplitude)
    elastic = angle - 0.5 * np.sin(2.0 * angle)
    return complex(slider / np.pi * (elastic + 1j * np.sin(angle) ** 2))


def exact(frequency: float, limit: float, slider: float = SLIDER) -> float:
    """Return the one-harmonic amplitude [m] at a frequency [rad/s]."""
    linear = STIFFNESS - MASS * frequency**2 + 1j * frequency * DAMPING
    return float(
        brentq(
            lambda size: size * abs(linear + jenkins(size, limit, slider)) - DRIVE,
            1e-9,
            1.0,
            xtol=1e-16,
        )
    )


@pytest.mark.parametrize("limit", [0.5, 1.0])
def test_the_peak_is_where_the_describing_function_has_it(limit: float) -> None:
    problem = problem_of(load_scene("jenkins", [f"element.slider.limit={limit}"]))
    best = minimize_scalar(
        lambda frequency: -1e3 * exact(frequency, limit),
        bounds=(15.5 * TURN, 21.0 * TURN),
        method="bounded",
        options={"xatol": 1e-9},
    )

    found = one_harmonic_response(
        problem, static_equilibrium(problem), (14.0 * TURN, 22.0 * TURN)
    )

    assert found.event == "peak"
    assert found.frequency == pytest.approx(best.x, rel=3e-6)
    (size,) = found.amplitudes(problem.probes.rows)
    assert size == pytest.approx(exact(best.x, limit), rel=3e-6)


@pytest.mark.parametrize("limit", [0.44, 0.46])
def test_the_peak_of_a_stiff_slider_is_where_a_broad_top_has_it(limit: float) -> None:
    stiff = 8e4
    slider = [f"element.slider.limit={limit}", f"element.slider.stiffness={stiff}"]
    problem = problem_of(load_scene("jenkins", slider))
    best = minimize_scalar(
        lambda frequency: -1e3 * exact(frequency, limit, stiff),
        bounds=(19.0 * TURN, 22.0 * TURN),
        method="bounded",
        options={"xatol": 1e-9},
    )

    found = one_harmonic_response(
        problem, static_equilibrium(problem), (14.0 * TURN, 50.0 * TURN)
    )

    assert found.frequency == pytest.approx(best.x, rel=2e-5)
