"""Resonances of single harmonics, narrower than the steps of a curve."""

from dataclasses import replace

import numpy as np
import pytest

from hbm.forces.fourier import to_complex
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from hbm.structure.superharmonics import FAINT, Superharmonics
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip.studies.curve import curve_options
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from small_problems import cubic_oscillator

TURN = 2.0 * np.pi


def curve(problem: Problem, options: CurveOptions) -> list[PeriodicResponse]:
    return list(frequency_response(problem, static_equilibrium(problem), options))


def smallest(responses: list[PeriodicResponse], rows: Array) -> tuple[float, float]:
    """Return where the first harmonic of a probe is smallest [Hz], and how small."""
    sizes = [
        (float(abs(to_complex(each.coefficients)[1] @ rows)), each.frequency / TURN)
        for each in responses
    ]
    size, place = min(sizes)
    return place, size


def test_a_superharmonic_resonance_narrower_than_a_step_is_seen() -> None:
    damping, cubic, drive = 0.002, 1e-3, 0.5
    problem = cubic_oscillator(damping=damping, cubic=cubic, drive=drive)
    options = CurveOptions(0.28, 0.4, error=1e-3, stability=False)

    third = [
        (each.frequency, abs(to_complex(each.coefficients)[3, 0]))
        for each in curve(problem, options)
    ]

    # To first order in the cubic spring it is driven by the cube of the first harmonic,
    # which makes the spring stiffer too (Nayfeh and Mook 1979, section 4.1.3).
    forced = drive / (1.0 - 1.0 / 9.0)
    natural = 1.0 + 0.75 * cubic * forced**2
    largest = cubic * forced**3 / 4.0 / (damping * natural)
    place, height = max(third, key=lambda each: each[1])
    assert height == pytest.approx(largest, rel=0.1)
    assert place == pytest.approx(natural / 3.0, rel=1e-3)


@pytest.mark.long
def test_a_dip_of_a_beam_that_rubs_is_that_of_a_curve_with_short_steps() -> None:
    scene = load_scene("friction-beam")
    problem = problem_of(scene)
    rows = problem.probes.rows[0]
    options = replace(curve_options(scene.curve), stability=False)
    narrow = replace(
        options, start=TURN * 117.0, end=TURN * 118.2, error=1e-4, largest_step=0.05
    )

    around = [
        each
        for each in curve(problem, options)
        if narrow.start < each.frequency < narrow.end
    ]

    place, size = smallest(around, rows)
    true_place, true_size = smallest(curve(problem, narrow), rows)
    assert place == pytest.approx(true_place, rel=1e-3)
    assert size == pytest.approx(true_size, rel=5e-3)


def seen(third: complex, phase: float = 0.0) -> ComplexArray:
    """Return harmonics of one coordinate that begins at a phase of its fundamental."""
    turn = np.exp(1j * phase)
    return np.array([[turn], [0.3 * turn**2], [third * turn**3]])


@pytest.mark.parametrize("phases", [(0.0, 0.0, 0.0), (0.0, 0.7, 1.9)])
@pytest.mark.parametrize(
    ("thirds", "passes"),
    [
        ((1.0, 2.0, -2.0), True),
        ((1.0, 2.0, 2.0j), False),
        ((4.0, 1.2, -1.2), False),
        ((1.0, 2.0, -0.9), False),
        ((0.4, 0.9, -2.0), False),
    ],
)
def test_a_harmonic_passes_its_resonance_if_it_turns_about_and_is_not_faint(
    thirds: tuple[complex, ...], phases: tuple[float, ...], passes: bool
) -> None:
    watched = Superharmonics()
    *before, after = (
        seen(FAINT * third, phase) for third, phase in zip(thirds, phases, strict=True)
    )
    for each in before:
        assert not watched.passed(each, 0.1)
        watched.keep()

    assert watched.passed(after, 0.1) == passes


def test_a_step_is_not_refused_again_for_a_harmonic_that_is_smaller_then() -> None:
    watched = Superharmonics()
    for third in (1.0, 2.0):
        watched.passed(seen(FAINT * third), 0.1)
        watched.keep()

    told = [
        watched.passed(seen(FAINT * third), step)
        for third, step in ((-4.0, 0.1), (-6.0, 0.05), (-3.0, 0.025))
    ]

    assert told == [True, True, False]


def test_a_curve_that_begins_anew_promises_nothing() -> None:
    watched = Superharmonics()
    for third in (1.0, 2.0):
        watched.passed(seen(FAINT * third), 0.1)
        watched.keep()
    watched.keep()

    assert not watched.passed(seen(-2.0 * FAINT), 0.1)
