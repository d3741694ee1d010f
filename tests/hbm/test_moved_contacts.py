"""Parameters that move contact points or end without drive; dashpots to modes."""

from dataclasses import replace

import numpy as np
import pytest

from contact_tables import contact_points
from hbm.curves.parameter_curves import parameter_response
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.structures.structure import Structure
from small_problems import cubic_oscillator

PLAIN = {"stability": False, "errors": False, "events": False}


def plate(width: float) -> Problem:
    """Return a plate that heaves and tilts on four points across its width."""
    points = contact_points(4, friction=0, stiffness=100.0, exponent=1.5, damping=0.0)
    places = np.zeros((12, 2))
    places[::3, 0] = 1.0
    places[::3, 1] = 0.1 + width * np.array([-1.0, -0.3, 0.3, 1.0])
    return Problem(
        Structure(
            np.diag([1.0, 0.1]), np.diag([1.0, 0.1]), np.diag([50.0, 10.0]), ("z", "t")
        ),
        Interface(points, places, tuple("abcd")),
        np.array([20.0, 0.0]),
        np.array([3.0, 2.0]),
        Probes(("z", "t"), np.eye(2)),
    )


def test_contact_points_that_a_parameter_moves_see_their_own_motion() -> None:
    frequency = 8.0
    options = CurveOptions(0.5, 1.0, harmonics=5, samples=64, **PLAIN)

    *_, last = parameter_response(plate, frequency, options)

    problem = plate(1.0)
    around = CurveOptions(frequency, 9.0, harmonics=5, samples=64, **PLAIN)
    direct = next(frequency_response(problem, static_equilibrium(problem), around))
    assert last.parameter == 1.0
    for found, expected in (
        (last.coefficients[:3], direct.coefficients[:3]),
        (last.normal_largest, direct.normal_largest),
    ):
        np.testing.assert_allclose(found, expected, atol=1e-6 * np.abs(expected).max())


@pytest.mark.parametrize("ends", [(3.0, 0.0), (0.0, 3.0)])
def test_few_points_of_a_curve_lie_where_the_drive_vanishes(
    ends: tuple[float, float],
) -> None:
    frequency, damping = 0.6, 0.2

    found = list(
        parameter_response(
            lambda drive: cubic_oscillator(damping=damping, drive=drive),
            frequency,
            CurveOptions(*ends, harmonics=1, samples=64),
        )
    )

    faint = [each for each in found if each.parameter < 0.3]
    assert (found[0].parameter, found[-1].parameter) == ends
    assert 4 <= len(faint) <= 12
    for each in faint:
        size = float(np.hypot(*each.coefficients[1:3, 0]))
        # one harmonic has three quarters of the cubic force
        stiffness = 1.0 + 0.75 * size**2 - frequency**2 + 1j * damping * frequency
        assert size * abs(stiffness) == pytest.approx(each.parameter, abs=1e-6)


def test_a_curve_that_ends_without_drive_keeps_its_tolerance() -> None:
    unit = 1e-8
    made = cubic_oscillator(damping=0.2, drive=6.0)
    structure, points = made.structure, made.interface.points
    small = replace(
        made,
        structure=Structure(
            unit * structure.mass,
            unit * structure.damping,
            unit * structure.stiffness,
            structure.names,
        ),
        interface=replace(
            made.interface, points=points._replace(stiffness=unit * points.stiffness)
        ),
    )

    def driven(force: float) -> Problem:
        return replace(small, drive=np.array([force]))

    options = CurveOptions(6.0 * unit, 0.0, harmonics=3, **PLAIN)
    *found, _ = parameter_response(driven, 1.3, options)

    assert max(each.residual for each in found) < 1e-7 * 6.0 * unit


@pytest.mark.parametrize("dashpot", [0.1, 5.0, 50.0])
def test_a_mode_on_a_dashpot_alone_has_its_multipliers(dashpot: float) -> None:
    mass = np.eye(3)
    stiffness = np.array([[200.0, -100.0, 0.0], [-100.0, 200.0, 0.0], [0.0, 0.0, 4.0]])
    damping = np.array(
        [[dashpot, 0.0, -dashpot], [0.0, 0.5, 0.0], [-dashpot, 0.0, dashpot]]
    )
    points = contact_points(
        1, normal=1, friction=0, stiffness=10.0, exponent=1.0, damping=0.0
    )
    first = np.zeros((3, 3))
    first[0, 0] = 1.0
    problem = Problem(
        Structure(mass, damping, stiffness, ("1", "2", "3")),
        Interface(points, first, ("spring",)),
        np.zeros(3),
        np.array([1.0, 0.0, 0.0]),
        Probes(("1",), first[:1]),
    )
    frequency = 10.0

    options = CurveOptions(frequency, 11.0, harmonics=1, events=False)
    found = next(frequency_response(problem, static_equilibrium(problem), options))

    whole = stiffness + np.diag([10.0, 0.0, 0.0])
    state = np.block([[np.zeros((3, 3)), mass], [-whole, -damping]])
    exact = np.exp(np.linalg.eigvals(state) * 2.0 * np.pi / frequency)
    assert np.abs(found.multipliers[0]) == pytest.approx(np.abs(exact).max(), rel=1e-4)
